// SPDX-License-Identifier: Apache-2.0
// The device that this build can use, and the one at hand.
#pragma once

#include <cstdint>
#include <string>

namespace brisance::exec {

struct DeviceInfo {
    bool built = false;      ///< this build can use one
    bool found = false;      ///< and there is one
    std::string name;        ///< of the card; of what is missing, where none is found
    double memory = 0;       ///< bytes
    double memory_free = 0;  ///< bytes
};
DeviceInfo device_info();

}  // namespace brisance::exec
