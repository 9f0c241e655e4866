// SPDX-License-Identifier: Apache-2.0
// The loops of exec/launch.h on a CUDA device. One stream, so kernels follow each other; what returns a number waits.
#pragma once

#include "exec/memory.h"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <cuda_runtime.h>

#include <cstdint>

namespace brisance::exec::cuda {

/// Throws ResourceError with the device's own words unless `code` is success.
void check(cudaError_t code, const char* what);
/// Outside of a DevicePhase the processor may read what it likes at once: waits.
void settle();
/// Scratch memory of the device, one block per `slot`, kept and grown; what was in it may be lost.
void* scratch(int slot, std::size_t bytes);

inline constexpr int threads_of_a_block = 128, sum_width = 256;

template <class Kernel>
__global__ void run_kernel(std::int64_t n, Kernel kernel) {
    const std::int64_t i = static_cast<std::int64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < n) kernel(i);
}

template <class Kernel>
void run(std::int64_t n, const Kernel& kernel) {
    const auto blocks = static_cast<unsigned>((n + threads_of_a_block - 1) / threads_of_a_block);
    run_kernel<<<blocks, threads_of_a_block>>>(n, kernel);
    check(cudaGetLastError(), "launch");
    settle();
}

/// One block sums `sum_width` items as a tree of fixed shape.
template <class T, class Kernel>
__global__ void sum_kernel(std::int64_t n, T zero, Kernel kernel, T* partial) {
    __shared__ alignas(alignof(T)) unsigned char memory[sum_width * sizeof(T)];
    T* const s = reinterpret_cast<T*>(memory);
    const std::int64_t i = static_cast<std::int64_t>(blockIdx.x) * sum_width + threadIdx.x;
    s[threadIdx.x] = i < n ? kernel(i) : zero;
    for (int half = sum_width / 2; half > 0; half /= 2) {
        __syncthreads();
        if (threadIdx.x < half) s[threadIdx.x] += s[threadIdx.x + half];
    }
    if (threadIdx.x == 0) partial[blockIdx.x] = s[0];
}

template <class T>
struct Entry {
    const T* a;
    BRISANCE_HD T operator()(std::int64_t i) const { return a[i]; }
};

template <class T, class Kernel>
T sum(std::int64_t n, T zero, const Kernel& kernel) {
    std::int64_t blocks = (n + sum_width - 1) / sum_width;
    int side = 0;
    T* partial = static_cast<T*>(scratch(side, static_cast<std::size_t>(blocks) * sizeof(T)));
    sum_kernel<<<static_cast<unsigned>(blocks), sum_width>>>(n, zero, kernel, partial);
    while (blocks > 1) {
        const std::int64_t items = blocks;
        const Entry<T> entries{partial};
        blocks = (items + sum_width - 1) / sum_width;
        side = 1 - side;
        partial = static_cast<T*>(scratch(side, static_cast<std::size_t>(blocks) * sizeof(T)));
        sum_kernel<<<static_cast<unsigned>(blocks), sum_width>>>(items, zero, entries, partial);
    }
    check(cudaGetLastError(), "sum");
    T total = zero;
    check(cudaMemcpy(&total, partial, sizeof(T), cudaMemcpyDeviceToHost), "sum");
    zero += total;  // counts where no block has a gap
    return zero;
}

template <class Keep>
struct FlagKernel {
    Keep keep;
    std::int64_t n;
    std::int32_t* flag;
    BRISANCE_HD void operator()(std::int64_t i) const { flag[i] = i < n && keep(i) ? 1 : 0; }
};
template <class Put>
struct PutKernel {
    Put put;
    const std::int32_t* place;
    BRISANCE_HD void operator()(std::int64_t i) const {
        if (place[i + 1] != place[i]) put(i, static_cast<std::int64_t>(place[i]));
    }
};

template <class Keep, class Put>
std::int64_t select(std::int64_t n, const Keep& keep, const Put& put) {
    const auto room = static_cast<std::size_t>(n + 1) * sizeof(std::int32_t);
    std::int32_t* const flag = static_cast<std::int32_t*>(scratch(2, room));
    std::int32_t* const place = static_cast<std::int32_t*>(scratch(3, room));
    run(n + 1, FlagKernel<Keep>{keep, n, flag});
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, flag, place, static_cast<int>(n + 1)), "scan");
    check(cub::DeviceScan::ExclusiveSum(scratch(4, bytes), bytes, flag, place, static_cast<int>(n + 1)), "scan");
    run(n, PutKernel<Put>{put, place});
    std::int32_t count = 0;
    check(cudaMemcpy(&count, place + n, sizeof count, cudaMemcpyDeviceToHost), "select");
    return count;
}

/// Bucket b begins at the first entry whose bucket is not below b.
struct BeginKernel {
    const std::int32_t* sorted;
    std::int64_t n, buckets;
    std::int64_t* begin;
    BRISANCE_HD void operator()(std::int64_t k) const {
        const std::int64_t before = k == 0 ? -1 : sorted[k - 1], here = k == n ? buckets : sorted[k];
        for (std::int64_t b = before + 1; b <= here; ++b) begin[b] = k;
    }
};
struct CountKernel {
    std::int32_t* number;
    BRISANCE_HD void operator()(std::int64_t i) const { number[i] = static_cast<std::int32_t>(i); }
};

inline void bucket_sort(const std::int32_t* bucket, std::int64_t n, std::int64_t buckets, std::int32_t* order, std::int64_t* begin) {
    const auto room = static_cast<std::size_t>(n + 1) * sizeof(std::int32_t);
    std::int32_t* const number = static_cast<std::int32_t*>(scratch(2, room));
    std::int32_t* const sorted = static_cast<std::int32_t*>(scratch(3, room));
    if (n > 0) {
        run(n, CountKernel{number});
        int bits = 1;
        while ((std::int64_t{1} << bits) < buckets) ++bits;
        std::size_t bytes = 0;
        check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, bucket, sorted, number, order, static_cast<int>(n), 0, bits), "sort");
        check(cub::DeviceRadixSort::SortPairs(scratch(4, bytes), bytes, bucket, sorted, number, order, static_cast<int>(n), 0, bits), "sort");
    }
    run(n + 1, BeginKernel{sorted, n, buckets, begin});
}

inline std::int64_t scan(std::int64_t* number, std::int64_t n) {
    std::int64_t last[2];  // the last number, and the sum of those before it
    check(cudaMemcpy(last, number + n - 1, sizeof *last, cudaMemcpyDeviceToHost), "scan");
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, number, number, static_cast<int>(n)), "scan");
    check(cub::DeviceScan::ExclusiveSum(scratch(4, bytes), bytes, number, number, static_cast<int>(n)), "scan");
    check(cudaMemcpy(last + 1, number + n - 1, sizeof *last, cudaMemcpyDeviceToHost), "scan");
    return last[0] + last[1];
}

}  // namespace brisance::exec::cuda
