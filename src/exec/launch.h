// SPDX-License-Identifier: Apache-2.0
// Kernels: loops over what a step touches, run where the run's memory is. A kernel is a copyable object with `operator()(std::int64_t i) const`
// marked BRISANCE_HD that holds numbers and bare pointers into Arrays; lambdas that capture by value will do. Sums and searches have a fixed
// order, so two runs of one build give the same bits; there are no floating-point atomics.
#pragma once

#include "base/hd.h"
#include "exec/exec.h"
#include "exec/memory.h"

#if defined(BRISANCE_CUDA) && defined(__CUDACC__)
#include "exec/launch_cuda.h"
#endif

#include <memory>
#include <utility>
#include <vector>

/// A small kernel: what it captures, it copies.
#define BRISANCE_KERNEL [=] BRISANCE_HD

namespace brisance::exec {

/// Items per partial sum.
inline constexpr std::int64_t chunk = 256;
/// Fewer items than this are selected and sorted by one thread.
inline constexpr std::int64_t worth_sharing = 8192;

/// Sets a flag to 1 in a kernel of which other items may set it too.
BRISANCE_HD inline void mark(std::int64_t& flag) {
#ifdef __CUDA_ARCH__
    flag = 1;
#else
    __atomic_store_n(&flag, 1, __ATOMIC_RELAXED);
#endif
}

#if !defined(BRISANCE_CUDA) || defined(__CUDACC__)

namespace detail {
#ifdef BRISANCE_SPLIT
/// Opens the pretend device's memory for the kernel at hand, after a look at what it points to.
class Opened {
public:
    Opened();
    template <class Kernel>
    explicit Opened(const Kernel& kernel) : Opened() {
        Kernel copy = kernel;
        __builtin_clear_padding(&copy);
        look(&copy, sizeof copy);
    }
    ~Opened();
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

private:
    static void look(const void* kernel, std::size_t size);
};
#else
struct Opened {
    Opened() {}
    template <class Kernel> explicit Opened(const Kernel&) {}
};
#endif
}  // namespace detail

/// kernel(i) for i in [0, n), in any order, on the processor in runs of `grain` items.
template <class Kernel>
void launch(std::int64_t n, const Kernel& kernel, int grain = 64) {
    if (n <= 0) return;
#ifdef BRISANCE_CUDA
    if (on_device()) return cuda::run(n, kernel);
#endif
    const detail::Opened opened(kernel);
    for_each(n, kernel, grain);
}

/// Sum of kernel(i), a T with +=: chunk by chunk, on the processor each in its order and then the chunks in theirs, on a device as trees.
template <class T, class Kernel>
T launch_sum(std::int64_t n, T zero, const Kernel& kernel) {
    if (n <= 0) return zero;
#ifdef BRISANCE_CUDA
    if (on_device()) return cuda::sum(n, zero, kernel);
#endif
    const detail::Opened opened(kernel);
    const std::int64_t chunks = (n + chunk - 1) / chunk;
    std::vector<T> partial(static_cast<std::size_t>(chunks), zero);
    for_each(chunks, [&](std::int64_t c) {
        T s = zero;
        const std::int64_t end = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        for (std::int64_t i = c * chunk; i < end; ++i) s += kernel(i);
        partial[static_cast<std::size_t>(c)] = s;
    }, 1);
    T total = zero;
    for (const T& s : partial) total += s;
    return total;
}
template <class Kernel> double launch_sum(std::int64_t n, const Kernel& kernel) { return launch_sum(n, 0.0, kernel); }

/// The largest of some numbers, as a sum.
struct Largest {
    double value;
    BRISANCE_HD Largest& operator+=(const Largest& o) {
        if (o.value > value) value = o.value;
        return *this;
    }
};
template <class Kernel>
struct LargestOf {
    Kernel kernel;
    BRISANCE_HD Largest operator()(std::int64_t i) const {
        Largest one;
        one.value = kernel(i);
        return one;
    }
};
/// Largest kernel(i); `least` for an empty range.
template <class Kernel> double launch_max(std::int64_t n, double least, const Kernel& kernel) {
    return launch_sum(n, Largest{least}, LargestOf<Kernel>{kernel}).value;
}

/// put(i, k) for every i in [0, n) with keep(i), k counting them in the order of i. Returns how many there are. On a device `put` runs as a
/// kernel of its own, so both must stand for themselves; `put` may be called with a k beyond the room there is only if it checks.
template <class Keep, class Put>
std::int64_t select(std::int64_t n, const Keep& keep, const Put& put) {
    if (n <= 0) return 0;
#ifdef BRISANCE_CUDA
    if (on_device()) return cuda::select(n, keep, put);
#endif
    const detail::Opened opened_keep(keep), opened_put(put);
    if (n < worth_sharing) {
        std::int64_t k = 0;
        for (std::int64_t i = 0; i < n; ++i)
            if (keep(i)) put(i, k++);
        return k;
    }
    constexpr std::int64_t run = 4096;
    const std::int64_t runs = (n + run - 1) / run;
    // what each run keeps, as offsets into it
    const std::unique_ptr<std::uint16_t[]> kept(new std::uint16_t[static_cast<std::size_t>(n)]);
    std::vector<std::int64_t> before(static_cast<std::size_t>(runs) + 1);
    for_each(runs, [&](std::int64_t r) {
        const std::int64_t first = r * run, last = first + run < n ? first + run : n;
        std::uint16_t* next = kept.get() + first;
        for (std::int64_t i = first; i < last; ++i)
            if (keep(i)) *next++ = static_cast<std::uint16_t>(i - first);
        before[static_cast<std::size_t>(r) + 1] = next - (kept.get() + first);
    }, 1);
    for (std::size_t r = 1; r < before.size(); ++r) before[r] += before[r - 1];
    for_each(runs, [&](std::int64_t r) {
        const std::int64_t first = before[static_cast<std::size_t>(r)], count = before[static_cast<std::size_t>(r) + 1] - first;
        for (std::int64_t m = 0; m < count; ++m) put(r * run + kept[static_cast<std::size_t>(r * run + m)], first + m);
    }, 1);
    return before.back();
}

/// Sorts the numbers 0 ... n-1 by bucket[i], equal ones in their order: `order` gets them, and begin[b] where bucket b starts (one more than there
/// are buckets).
inline void bucket_sort(const std::int32_t* bucket, std::int64_t n, std::int64_t buckets, std::int32_t* order, std::int64_t* begin) {
#ifdef BRISANCE_CUDA
    if (on_device()) return cuda::bucket_sort(bucket, n, buckets, order, begin);
#endif
    const detail::Opened opened;
    // Each thread looks through all and takes care of its own stretch of the buckets.
    const std::int64_t parts = n < worth_sharing || buckets < threads() ? 1 : threads();
    std::vector<std::int64_t> before(static_cast<std::size_t>(parts) + 1);
    const auto bucket_of_part = [&](std::int64_t p) { return buckets * p / parts; };
    for_each(parts, [&](std::int64_t p) {
        const std::int64_t first = bucket_of_part(p), last = bucket_of_part(p + 1);
        std::memset(begin + first, 0, static_cast<std::size_t>(last - first) * sizeof *begin);
        std::int64_t count = 0;
        for (std::int64_t i = 0; i < n; ++i)
            if (bucket[i] >= first && bucket[i] < last) {
                ++begin[bucket[i]];
                ++count;
            }
        before[static_cast<std::size_t>(p) + 1] = count;
    }, 1);
    for (std::size_t p = 1; p < before.size(); ++p) before[p] += before[p - 1];
    for_each(parts, [&](std::int64_t p) {
        const std::int64_t first = bucket_of_part(p), last = bucket_of_part(p + 1), start = before[static_cast<std::size_t>(p)];
        std::int64_t next = start;
        for (std::int64_t b = first; b < last; ++b) {
            const std::int64_t count = begin[b];
            begin[b] = next;
            next += count;
        }
        // each start moves on while its bucket fills, and ends where the next one began
        for (std::int64_t i = 0; i < n; ++i)
            if (bucket[i] >= first && bucket[i] < last) order[begin[bucket[i]]++] = static_cast<std::int32_t>(i);
        for (std::int64_t b = last - 1; b > first; --b) begin[b] = begin[b - 1];
        begin[first] = start;
    }, 1);
    begin[buckets] = n;
}

/// Turns the numbers into the sums of those before them. Returns the sum of all.
inline std::int64_t scan(std::int64_t* number, std::int64_t n) {
    if (n <= 0) return 0;
#ifdef BRISANCE_CUDA
    if (on_device()) return cuda::scan(number, n);
#endif
    const detail::Opened opened;
    const std::int64_t parts = n < worth_sharing ? 1 : threads();
    std::vector<std::int64_t> before(static_cast<std::size_t>(parts) + 1);
    if (parts > 1)
        for_each(parts, [&](std::int64_t p) {
            std::int64_t sum = 0;
            for (std::int64_t i = n * p / parts; i < n * (p + 1) / parts; ++i) sum += number[i];
            before[static_cast<std::size_t>(p) + 1] = sum;
        }, 1);
    for (std::size_t p = 1; p < before.size(); ++p) before[p] += before[p - 1];
    for_each(parts, [&](std::int64_t p) {
        std::int64_t sum = before[static_cast<std::size_t>(p)];
        for (std::int64_t i = n * p / parts; i < n * (p + 1) / parts; ++i) {
            const std::int64_t here = number[i];
            number[i] = sum;
            sum += here;
        }
        if (p == parts - 1) before.back() = sum;
    }, 1);
    return before.back();
}

#else  // in a build for CUDA only what goes through nvcc can launch (device_sources in CMakeLists.txt)

template <class Kernel> void launch(std::int64_t, const Kernel&, int = 64) = delete;
template <class T, class Kernel> T launch_sum(std::int64_t, T, const Kernel&) = delete;
template <class Kernel> double launch_sum(std::int64_t, const Kernel&) = delete;
template <class Kernel> double launch_max(std::int64_t, double, const Kernel&) = delete;
template <class Keep, class Put> std::int64_t select(std::int64_t, const Keep&, const Put&) = delete;

#endif

}  // namespace brisance::exec
