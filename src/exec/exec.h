// SPDX-License-Identifier: Apache-2.0
// The only folder that knows OpenMP (and, under nvcc, CUDA). Here: threads, and loops of the processor over independent items.
#pragma once

#include <cstdint>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace brisance {

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

/// f(i) for i in [0, n), in any order, in runs of `grain` items. Items must not depend on each other. A single run wakes no other thread.
template <class F>
void for_each(std::int64_t n, F&& f, int grain = 64) {
#ifdef _OPENMP
    constexpr omp_sched_t kinds[] = {omp_sched_dynamic, omp_sched_static, omp_sched_guided};
    omp_set_schedule(kinds[static_cast<int>(schedule)], grain);
#endif
#pragma omp parallel for schedule(runtime) if (n > grain)
    for (std::int64_t i = 0; i < n; ++i) f(i);
}

}  // namespace exec
}  // namespace brisance
