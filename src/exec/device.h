// SPDX-License-Identifier: Apache-2.0
// Kernels for a device. A kernel is a plain struct with `void operator()(std::int64_t i) const`, marked BRISANCE_HD; the processor runs
// the same source on packs.
#pragma once

#include "base/hd.h"

#include <cstdint>

namespace brisance::exec {

#ifdef __CUDACC__
template <class Kernel>
__global__ void run_on_device(std::int64_t n, Kernel kernel) {
    const std::int64_t i = static_cast<std::int64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < n) kernel(i);
}
/// Has the device code of a kernel compiled into the program.
template <class Kernel>
void compile_for_device() {
    [[maybe_unused]] static void (*const volatile address)(std::int64_t, Kernel) = run_on_device<Kernel>;
}
#else
template <class Kernel> void compile_for_device() {}
#endif

}  // namespace brisance::exec
