// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brisance {

inline constexpr double gibibyte = 1073741824;

/// What the kernel says can be had without swapping (MemAvailable), bytes; a large number where it says nothing.
double available_memory();

}  // namespace brisance
