// SPDX-License-Identifier: Apache-2.0
// Marks a function that runs on the processor and on a device. The one word of CUDA outside exec/.
#pragma once

#ifdef __CUDACC__
#define BRISANCE_HD __host__ __device__
#else
#define BRISANCE_HD
#endif
