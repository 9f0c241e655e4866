// SPDX-License-Identifier: Apache-2.0
// What a machine can do at most, measured: the two ceilings of a roofline. All threads take part.
#pragma once

namespace brisance {

/// Memory bandwidth of a[i] = b[i] + s c[i] over arrays far larger than the caches, bytes/s; 24 bytes an element are counted, as STREAM does.
double measure_bandwidth();
/// Multiply-adds on packs that stay in registers, floating-point operations per second (two for each).
template <class R> double measure_arithmetic();

}  // namespace brisance
