// SPDX-License-Identifier: Apache-2.0
#include "base/memory.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <sys/mman.h>
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

void prefer_large_pages(void* block, std::size_t bytes) {
    constexpr std::uintptr_t page = 2 << 20;
    const std::uintptr_t at = reinterpret_cast<std::uintptr_t>(block), first = (at + page - 1) / page * page, end = (at + bytes) / page * page;
    if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

}  // namespace brisance
