// SPDX-License-Identifier: Apache-2.0
#include "exec/device.h"

namespace brisance::exec {

#if !defined(BRISANCE_CUDA) && !defined(BRISANCE_SPLIT)
DeviceInfo device_info() { return {false, false, "this build knows no device: cmake --preset cuda", 0, 0}; }
#endif

}  // namespace brisance::exec
