// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace brisance {

inline constexpr double gibibyte = 1073741824;

/// What the kernel says can be had without swapping (MemAvailable), bytes; a large number where it says nothing.
double available_memory();
/// What this process holds at present (resident set), bytes; 0 where the kernel does not say.
double resident_memory();
/// Asks for pages of 2 MiB where whole ones fit into a block that has not been touched: a loop over many arrays at once needs one page of each,
/// and the processor finds few small ones quickly. A wish, which the system may refuse.
void prefer_large_pages(void* block, std::size_t bytes);

}  // namespace brisance
