// SPDX-License-Identifier: Apache-2.0
// Marks a function that runs on the processor and on a device. The one word of CUDA outside exec/.
#pragma once

#ifdef __CUDACC__
#define BRISANCE_HD __host__ __device__
/// A few operations on packs, which a call would send through memory: always part of the caller.
#define BRISANCE_INLINE __host__ __device__ inline
#else
#define BRISANCE_HD
#define BRISANCE_INLINE __attribute__((always_inline)) inline
#endif
