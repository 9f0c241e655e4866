// SPDX-License-Identifier: Apache-2.0
#include "base/memory.h"

#include <fstream>
#include <string>
#include <unistd.h>

namespace brisance {

double available_memory() {
    std::ifstream info("/proc/meminfo");
    for (std::string key; info >> key;) {
        double value = 0;
        if (key == "MemAvailable:" && info >> value) return 1024 * value;
    }
    return 1e18;
}

double resident_memory() {
    std::ifstream statm("/proc/self/statm");
    double size = 0, resident = 0;
    return statm >> size >> resident ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace brisance
