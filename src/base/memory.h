// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brisance {

/// What the kernel says can be had without swapping (MemAvailable), KiB; a large number where it says nothing.
double available_memory_kib();

}  // namespace brisance
