// SPDX-License-Identifier: Apache-2.0
#include "app/ceilings.h"

#include "exec/exec.h"
#include "exec/memory.h"
#include "math/pack.h"

#include <algorithm>
#include <chrono>

namespace brisance {

namespace {

/// The shortest of some runs of f, s.
template <class F>
double best_time(int runs, F&& f) {
    double best = 1e300;
    for (int k = 0; k < runs; ++k) {
        const auto start = std::chrono::steady_clock::now();
        f();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

}  // namespace

double measure_bandwidth() {
    constexpr std::int64_t n = std::int64_t{1} << 24, block = std::int64_t{1} << 14;  // 128 MiB an array
    Array<double> a(n), b(n), c(n);
    const auto sweep = [&](auto&& f) { exec::for_each(n / block, [&](std::int64_t k) { for (std::int64_t i = k * block; i < (k + 1) * block; ++i) f(static_cast<std::size_t>(i)); }, 1); };
    sweep([&](std::size_t i) { a[i] = 0, b[i] = 1, c[i] = static_cast<double>(i % 7); });
    const double seconds = best_time(7, [&] { sweep([&](std::size_t i) { a[i] = b[i] + 3.0 * c[i]; }); });
    return 24.0 * static_cast<double>(n) / seconds;
}

template <class R>
double measure_arithmetic() {
    using V = Pack<R>;
    constexpr int chains = 12, rounds = 2000000;  // enough chains to hide the latency of one
    Array<R> sink(64 * static_cast<std::size_t>(exec::threads()));
    const double seconds = best_time(5, [&] {
        exec::for_each(exec::threads(), [&](std::int64_t t) {
            V x[chains];
            for (int k = 0; k < chains; ++k) x[k] = broadcast<V>(R(1 + k));
            V a = broadcast<V>(R(0.999999)), b = broadcast<V>(R(1e-6));
            for (int r = 0; r < rounds; ++r) {
#if defined(__GNUC__)
                asm volatile("" : "+x"(a), "+x"(b));  // what the loop multiplies by is not known beforehand
#endif
                for (int k = 0; k < chains; ++k) x[k] = x[k] * a + b;
            }
            V s{};
            for (int k = 0; k < chains; ++k) s += x[k];
            sink[64 * static_cast<std::size_t>(t)] = hsum(s);
        }, 1);
    });
    return 2.0 * chains * rounds * lanes<R> * exec::threads() / seconds;
}

template double measure_arithmetic<double>();
template double measure_arithmetic<float>();

}  // namespace brisance
