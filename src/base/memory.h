// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brisance {

inline constexpr double gibibyte = 1073741824;

/// What the kernel says can be had without swapping (MemAvailable), bytes; a large number where it says nothing.
double available_memory();
/// What this process holds at present (resident set), bytes; 0 where the kernel does not say.
double resident_memory();

}  // namespace brisance
