// SPDX-License-Identifier: Apache-2.0
#include "base/memory.h"

#include <fstream>
#include <string>

namespace brisance {

double available_memory() {
    std::ifstream info("/proc/meminfo");
    for (std::string key; info >> key;) {
        double value = 0;
        if (key == "MemAvailable:" && info >> value) return 1024 * value;
    }
    return 1e18;
}

}  // namespace brisance
