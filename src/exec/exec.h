// SPDX-License-Identifier: Apache-2.0
// The only folder that knows OpenMP (and, under nvcc, CUDA). Loops over independent items; sums in fixed chunks, so that they
// give the same bits with any number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace brisance {

/// Memory on 64-byte boundaries, so that a pack never straddles a cache line. One array after the other begins one line further into its
/// page: equal slots of arrays of one size would else lie in the same set of the cache and drive each other out.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    static constexpr std::size_t line = 64, lines_of_a_page = 64;
    AlignedAllocator() = default;
    template <class U> AlignedAllocator(const AlignedAllocator<U>&) {}
    T* allocate(std::size_t n) {
        if (n > (std::size_t{1} << 48)) throw std::bad_array_new_length();
        static std::atomic<std::size_t> next{0};
        const std::size_t ahead = line * (1 + next++ % lines_of_a_page);
        char* const block = static_cast<char*>(::operator new(n * sizeof(T) + line * lines_of_a_page, std::align_val_t(line)));
        std::memcpy(block + ahead - sizeof block, &block, sizeof block);  // where it began, for deallocate
        return reinterpret_cast<T*>(block + ahead);
    }
    void deallocate(T* p, std::size_t) {
        char* block;
        std::memcpy(&block, reinterpret_cast<char*>(p) - sizeof block, sizeof block);
        ::operator delete(block, std::align_val_t(line));
    }
    template <class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
};
template <class T> using Array = std::vector<T, AlignedAllocator<T>>;

namespace exec {

/// Numbers too small for a full mantissa count as zero, in this thread and those it will start. Ahead of a wave the velocities fade through
/// that range, in single precision within a few spacings, and a processor takes a hundred cycles for each.
inline void flush_denormals() {
#ifdef __SSE__
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | flush_to_zero | denormals_are_zero);
#endif
}

inline int threads() {
#ifdef _OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}
inline void set_threads(int n) {
#ifdef _OPENMP
    omp_set_num_threads(n);
#else
    (void)n;
#endif
}

/// How loops are handed out to the threads. Results do not depend on it: tests/unit/determinism_test.cpp tries them all.
enum class Schedule { dynamic, fixed, guided };
inline Schedule schedule = Schedule::dynamic;

/// f(i) for i in [0, n), in any order, in runs of `grain` items. Items must not depend on each other.
template <class F>
void for_each(std::int64_t n, F&& f, int grain = 64) {
#ifdef _OPENMP
    constexpr omp_sched_t kinds[] = {omp_sched_dynamic, omp_sched_static, omp_sched_guided};
    omp_set_schedule(kinds[static_cast<int>(schedule)], grain);
#endif
#pragma omp parallel for schedule(runtime)
    for (std::int64_t i = 0; i < n; ++i) f(i);
}

inline constexpr std::int64_t chunk = 256;

/// Sum of f(i) over [0, n): each chunk in its order, then the chunks in theirs.
template <class T, class F>
T sum(std::int64_t n, T zero, F&& f) {
    const std::int64_t chunks = (n + chunk - 1) / chunk;
    std::vector<T> partial(static_cast<std::size_t>(chunks), zero);
    for_each(chunks, [&](std::int64_t c) {
        T s = zero;
        const std::int64_t end = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        for (std::int64_t i = c * chunk; i < end; ++i) s += f(i);
        partial[static_cast<std::size_t>(c)] = s;
    }, 1);
    T total = zero;
    for (const T& s : partial) total += s;
    return total;
}
template <class F> double sum(std::int64_t n, F&& f) { return sum(n, 0.0, static_cast<F&&>(f)); }

/// Largest f(i); order-free. `least` for an empty range.
template <class F>
double max(std::int64_t n, double least, F&& f) {
    double m = least;
#pragma omp parallel for reduction(max : m) schedule(static)
    for (std::int64_t i = 0; i < n; ++i) {
        const double x = f(i);
        if (x > m) m = x;
    }
    return m;
}

}  // namespace exec
}  // namespace brisance
