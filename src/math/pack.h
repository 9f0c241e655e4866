// SPDX-License-Identifier: Apache-2.0
// SIMD packs: V is either a scalar R or a 64-byte pack of R. Kernels and laws are written once, on V, without branches:
// (x > y) ? a : b works for both. In a build for CUDA a pack is one number everywhere, since there a thread is a lane.
#pragma once

#include "base/hd.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace brisance {

namespace detail {
template <class R> struct PackOf;
template <class V> struct ScalarOf { using type = V; };
template <class V> struct BitsOf;
template <> struct BitsOf<double> { using type = std::int64_t; };
template <> struct BitsOf<float> { using type = std::int32_t; };
#ifdef BRISANCE_CUDA
template <> struct PackOf<double> { using type = double; };
template <> struct PackOf<float> { using type = float; };
#else
typedef double Pack8d __attribute__((vector_size(64)));
typedef float Pack16f __attribute__((vector_size(64)));
typedef std::int64_t Pack8i __attribute__((vector_size(64)));
typedef std::int32_t Pack16i __attribute__((vector_size(64)));
template <> struct PackOf<double> { using type = Pack8d; };
template <> struct PackOf<float> { using type = Pack16f; };
template <> struct ScalarOf<Pack8d> { using type = double; };
template <> struct ScalarOf<Pack16f> { using type = float; };
template <> struct BitsOf<Pack8d> { using type = Pack8i; };
template <> struct BitsOf<Pack16f> { using type = Pack16i; };
#endif
}  // namespace detail

template <class R> using Pack = typename detail::PackOf<R>::type;
template <class V> using ScalarOf = typename detail::ScalarOf<V>::type;
/// Number of lanes in V, and in the pack of R: 8 doubles or 16 floats (1 under nvcc).
template <class V> inline constexpr int lanes_of = static_cast<int>(sizeof(V) / sizeof(ScalarOf<V>));
template <class R> inline constexpr int lanes = lanes_of<Pack<R>>;

template <class V> BRISANCE_HD inline V load(const ScalarOf<V>* p) {
    V v;
    std::memcpy(&v, p, sizeof(V));
    return v;
}
template <class V> BRISANCE_HD inline void store(ScalarOf<V>* p, V v) { std::memcpy(p, &v, sizeof(V)); }
/// Every lane the same number.
template <class V> BRISANCE_HD inline V broadcast(ScalarOf<V> r) { return V{} + r; }
template <class V> BRISANCE_HD inline ScalarOf<V> lane(const V& v, int l) {
    ScalarOf<V> r;
    std::memcpy(&r, reinterpret_cast<const char*>(&v) + static_cast<std::size_t>(l) * sizeof(r), sizeof(r));
    return r;
}

template <class V> BRISANCE_HD inline V vmax(V a, V b) { return (a > b) ? a : b; }
template <class V> BRISANCE_HD inline V vmin(V a, V b) { return (a < b) ? a : b; }
template <class V> BRISANCE_HD inline V vabs(V a) { return (a < V{}) ? -a : a; }
template <class V> BRISANCE_HD inline V clamp(V x, V lo, V hi) { return vmin(vmax(x, lo), hi); }
/// Square of x.
template <class V> BRISANCE_HD inline V sq(V x) { return x * x; }

template <class V> BRISANCE_HD inline V vsqrt(V x) {
    if constexpr (lanes_of<V> == 1) {
        return std::sqrt(x);
    } else {
        V r{};
        for (int l = 0; l < lanes_of<V>; ++l) r[l] = std::sqrt(x[l]);
        return r;
    }
}
/// Lanes to and from float, for columns that are stored in single precision whatever V is.
template <class V> BRISANCE_HD inline V load_float(const float* p) {
    V v{};
    if constexpr (lanes_of<V> == 1) v = static_cast<ScalarOf<V>>(*p);
    else
        for (int l = 0; l < lanes_of<V>; ++l) v[l] = static_cast<ScalarOf<V>>(p[l]);
    return v;
}
template <class V> BRISANCE_HD inline void store_float(float* p, V v) {
    for (int l = 0; l < lanes_of<V>; ++l) p[l] = static_cast<float>(lane(v, l));
}
/// Largest lane.
template <class V> BRISANCE_HD inline ScalarOf<V> hmax(V x) {
    ScalarOf<V> m = lane(x, 0);
    for (int l = 1; l < lanes_of<V>; ++l) m = lane(x, l) > m ? lane(x, l) : m;
    return m;
}
/// Sum of the lanes, in their order.
template <class V> BRISANCE_HD inline ScalarOf<V> hsum(V x) {
    ScalarOf<V> s = lane(x, 0);
    for (int l = 1; l < lanes_of<V>; ++l) s += lane(x, l);
    return s;
}

}  // namespace brisance
