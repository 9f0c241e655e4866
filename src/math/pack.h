// SPDX-License-Identifier: Apache-2.0
// SIMD packs: V is either a scalar R or a pack of R, 64 bytes with AVX-512, else 32. Kernels and laws are written once, on V, without branches:
// (x > y) ? a : b works for both. In a build for CUDA a pack is one number everywhere, since there a thread is a lane.
#pragma once

#include "base/hd.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#if defined(__AVX2__) && !defined(BRISANCE_CUDA)
#include <immintrin.h>
#endif

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
// As wide as the registers: wider vectors are taken apart, and their comparisons lane by lane.
#ifdef __AVX512F__
inline constexpr int pack_bytes = 64;
#else
inline constexpr int pack_bytes = 32;
#endif
typedef double PackD __attribute__((vector_size(pack_bytes)));
typedef float PackF __attribute__((vector_size(pack_bytes)));
typedef std::int64_t PackD_bits __attribute__((vector_size(pack_bytes)));
typedef std::int32_t PackF_bits __attribute__((vector_size(pack_bytes)));
template <> struct PackOf<double> { using type = PackD; };
template <> struct PackOf<float> { using type = PackF; };
template <> struct ScalarOf<PackD> { using type = double; };
template <> struct ScalarOf<PackF> { using type = float; };
template <> struct BitsOf<PackD> { using type = PackD_bits; };
template <> struct BitsOf<PackF> { using type = PackF_bits; };
#endif
}  // namespace detail

template <class R> using Pack = typename detail::PackOf<R>::type;
template <class V> using ScalarOf = typename detail::ScalarOf<V>::type;
/// Number of lanes in V, and in the pack of R: 8 doubles or 16 floats with AVX-512, half as many without (1 under nvcc).
template <class V> inline constexpr int lanes_of = static_cast<int>(sizeof(V) / sizeof(ScalarOf<V>));
template <class R> inline constexpr int lanes = lanes_of<Pack<R>>;

template <class V> BRISANCE_INLINE V load(const ScalarOf<V>* p) {
    V v;
    std::memcpy(&v, p, sizeof(V));
    return v;
}
template <class V> BRISANCE_INLINE void store(ScalarOf<V>* p, V v) { std::memcpy(p, &v, sizeof(V)); }
/// Every lane the same number.
template <class V> BRISANCE_INLINE V broadcast(ScalarOf<V> r) { return V{} + r; }
template <class V> BRISANCE_INLINE ScalarOf<V> lane(const V& v, int l) {
    ScalarOf<V> r;
    std::memcpy(&r, reinterpret_cast<const char*>(&v) + static_cast<std::size_t>(l) * sizeof(r), sizeof(r));
    return r;
}

template <class V> BRISANCE_INLINE V vmax(V a, V b) { return (a > b) ? a : b; }
template <class V> BRISANCE_INLINE V vmin(V a, V b) { return (a < b) ? a : b; }
template <class V> BRISANCE_INLINE V vabs(V a) { return (a < V{}) ? -a : a; }
template <class V> BRISANCE_INLINE V clamp(V x, V lo, V hi) { return vmin(vmax(x, lo), hi); }
/// Square of x.
template <class V> BRISANCE_INLINE V sq(V x) { return x * x; }

template <class V> BRISANCE_INLINE V vsqrt(V x) {
    if constexpr (lanes_of<V> == 1) {
        return std::sqrt(x);
    } else {
        V r{};
        for (int l = 0; l < lanes_of<V>; ++l) r[l] = std::sqrt(x[l]);
        return r;
    }
}
/// Lanes to and from float, for columns that are stored in single precision whatever V is.
template <class V> BRISANCE_INLINE V load_float(const float* p) {
    if constexpr (lanes_of<V> == 1) {
        return static_cast<V>(*p);
    }
#ifndef BRISANCE_CUDA
    else {
        typedef float Floats __attribute__((vector_size(lanes_of<V> * sizeof(float))));
        Floats f;
        std::memcpy(&f, p, sizeof(f));
        return __builtin_convertvector(f, V);
    }
#endif
}
template <class V> BRISANCE_INLINE void store_float(float* p, V v) {
    for (int l = 0; l < lanes_of<V>; ++l) p[l] = static_cast<float>(lane(v, l));
}
namespace detail {
#ifndef BRISANCE_CUDA
/// Lane l of the result is lane l ^ step of x.
template <int step, class V, int... l> BRISANCE_INLINE V exchanged(V x, std::integer_sequence<int, l...>) { return __builtin_shufflevector(x, x, (l ^ step)...); }
template <int step, class V> BRISANCE_INLINE V exchanged(V x) { return exchanged<step>(x, std::make_integer_sequence<int, lanes_of<V>>{}); }
/// Lanes of a and b such that, done for all rows r and r + step of a square of lanes, blocks of `step` change sides.
template <int step, class V, int... l> BRISANCE_INLINE void swap_blocks(V& a, V& b, std::integer_sequence<int, l...>) {
    const V low = __builtin_shufflevector(a, b, ((l & step) ? l - step + static_cast<int>(sizeof...(l)) : l)...);
    b = __builtin_shufflevector(a, b, ((l & step) ? l + static_cast<int>(sizeof...(l)) : l + step)...);
    a = low;
}
template <int step, class V> BRISANCE_INLINE void transpose(V* rows) {
    constexpr int n = lanes_of<V>;
    for (int r = 0; r < n; ++r)
        if (!(r & step)) swap_blocks<step>(rows[r], rows[r + step], std::make_integer_sequence<int, n>{});
    if constexpr (2 * step < n) transpose<2 * step>(rows);
}
#endif
template <int step, class V, class F> BRISANCE_INLINE V folded(V x, [[maybe_unused]] F&& f) {
    if constexpr (step == 0) return x;
#ifndef BRISANCE_CUDA
    else return folded<step / 2>(f(x, exchanged<step>(x)), f);
#endif
}
}  // namespace detail

/// Largest lane.
template <class V> BRISANCE_INLINE ScalarOf<V> hmax(V x) {
    return lane(detail::folded<lanes_of<V> / 2>(x, [](V a, V b) { return vmax(a, b); }), 0);
}
/// Sum of the lanes: halves, then quarters, ...
template <class V> BRISANCE_INLINE ScalarOf<V> hsum(V x) {
    return lane(detail::folded<lanes_of<V> / 2>(x, [](V a, V b) { return a + b; }), 0);
}

namespace detail {
#ifndef BRISANCE_CUDA
/// Lanes of a and b are blocks of 2 step; folds each to `step`, those of a first.
template <int step, class V, int... l> BRISANCE_INLINE V fold_two(V a, V b, std::integer_sequence<int, l...>) {
    constexpr int n = sizeof...(l);
    return __builtin_shufflevector(a, b, (l / (n / 2) * n + l % (n / 2) / step * 2 * step + l % step)...) +
           __builtin_shufflevector(a, b, (l / (n / 2) * n + l % (n / 2) / step * 2 * step + l % step + step)...);
}
/// n/step packs folded to one.
template <int step, class V> BRISANCE_INLINE V fold_all(const V* x) {
    constexpr int n = lanes_of<V>;
    if constexpr (2 * step == n) return fold_two<step>(x[0], x[1], std::make_integer_sequence<int, n>{});
    else return fold_two<step>(fold_all<2 * step>(x), fold_all<2 * step>(x + n / (2 * step)), std::make_integer_sequence<int, n>{});
}
#endif
}  // namespace detail
/// sum[k] = hsum(x[k]), in the same order, for much less.
template <class V, int m> BRISANCE_INLINE void hsums(const V (&x)[m], ScalarOf<V> (&sum)[m]) {
    constexpr int n = lanes_of<V>;
    if constexpr (n == 1) {
        for (int k = 0; k < m; ++k) sum[k] = x[k];
    }
#ifndef BRISANCE_CUDA
    else {
        constexpr int whole = (m + n - 1) / n * n;
        V padded[whole]{};
        ScalarOf<V> folded[whole];
        for (int k = 0; k < m; ++k) padded[k] = x[k];
        for (int k = 0; k < whole; k += n) store(folded + k, detail::fold_all<1>(padded + k));
        for (int k = 0; k < m; ++k) sum[k] = folded[k];
    }
#endif
}

/// 0, 1, 2, ...
template <class V> BRISANCE_INLINE V lane_numbers() {
    alignas(64) constexpr ScalarOf<V> number[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return load<V>(number);
}
/// A comparison of packs: the lanes of the one at `first` that lie before `last`.
template <class V> BRISANCE_INLINE auto lanes_before(std::int64_t first, std::int64_t last) { return lane_numbers<V>() < static_cast<ScalarOf<V>>(last - first); }
/// The same: all lanes but the one at `one`.
template <class V> BRISANCE_INLINE auto other_lanes(std::int64_t first, std::int64_t one) { return lane_numbers<V>() != static_cast<ScalarOf<V>>(one - first); }

/// Bit l: whether a comparison of two packs holds in lane l.
template <class Mask> BRISANCE_INLINE unsigned lane_bits(Mask on) {
    if constexpr (sizeof(Mask) <= sizeof(std::int64_t)) {
        return on != 0;
    } else {
        [[maybe_unused]] constexpr bool doubles = sizeof(on[0]) == sizeof(double);
#if defined(__AVX512VL__) && !defined(BRISANCE_CUDA)
        if constexpr (doubles) return _mm512_test_epi64_mask((__m512i)on, (__m512i)on);
        else return _mm512_test_epi32_mask((__m512i)on, (__m512i)on);
#elif defined(__AVX2__) && !defined(BRISANCE_CUDA)
        if constexpr (doubles) return static_cast<unsigned>(_mm256_movemask_pd((__m256d)on));
        else return static_cast<unsigned>(_mm256_movemask_ps((__m256)on));
#else
        unsigned bits = 0;
        for (std::size_t l = 0; l < sizeof(on) / sizeof(on[0]); ++l) bits |= static_cast<unsigned>(on[l] != 0) << l;
        return bits;
#endif
    }
}
/// Whether it holds in any lane.
template <class Mask> BRISANCE_INLINE bool any_lane(Mask on) { return lane_bits(on) != 0; }

/// f(l) for each bit l that is set.
template <class F> BRISANCE_INLINE void each_lane(unsigned bits, F&& f) {
#ifdef BRISANCE_CUDA
    if (bits != 0) f(0);  // a pack is one number
#else
    for (; bits != 0; bits &= bits - 1) f(__builtin_ctz(bits));
#endif
}

/// Records of eight numbers, one cache line each.
inline constexpr int record_length = 8;
/// out[c] gets component c of the records that begin at records[first[l]], one per lane.
template <class V> BRISANCE_INLINE void load_records(const ScalarOf<V>* records, const std::int32_t* first, V out[8]) {
    constexpr int n = lanes_of<V>;
#ifndef BRISANCE_CUDA
    if constexpr (n == 8 || n == 4) {
        for (int part = 0; part < 8; part += n) {
            for (int l = 0; l < n; ++l) out[part + l] = load<V>(records + first[l] + part);
            detail::transpose<1>(out + part);
        }
        return;
    }
#endif
    for (int c = 0; c < 8; ++c) {
        ScalarOf<V> lanes_now[n];
        for (int l = 0; l < n; ++l) lanes_now[l] = records[first[l] + c];
        out[c] = load<V>(lanes_now);
    }
}

namespace detail {
/// Row m: where the records of the bits that are set in m begin, one after the other.
struct BitsSet {
    std::uint8_t of[256][8];
};
consteval BitsSet bits_set() {
    BitsSet table{};
    for (int m = 0; m < 256; ++m)
        for (int bit = 0, n = 0; bit < 8; ++bit)
            if (m >> bit & 1) table.of[m][n++] = static_cast<std::uint8_t>(record_length * bit);
    return table;
}
}  // namespace detail
/// Writes where record first + l begins for each lane l where `on` holds (a comparison of two packs of floats), one after the other; returns
/// how many. May overwrite as many places as a pack has lanes.
template <class V, class Mask> BRISANCE_INLINE int list_lanes(std::int32_t* out, std::int32_t first, Mask on) {
    static_assert(sizeof(ScalarOf<V>) == sizeof(std::int32_t));
    const unsigned bits = lane_bits(on);
    if constexpr (lanes_of<V> == 1) {
        *out = record_length * first;
        return static_cast<int>(bits);
    } else {
#if defined(__AVX512VL__) && !defined(BRISANCE_CUDA)
        const __m512i place = _mm512_add_epi32(_mm512_set1_epi32(record_length * first), _mm512_setr_epi32(0, 8, 16, 24, 32, 40, 48, 56, 64, 72, 80, 88, 96, 104, 112, 120));
        _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), place));
#elif defined(__AVX2__) && !defined(BRISANCE_CUDA)
        static constexpr detail::BitsSet table = detail::bits_set();
        const __m128i row = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(table.of[bits]));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_add_epi32(_mm256_set1_epi32(record_length * first), _mm256_cvtepu8_epi32(row)));
#else
        for (int l = 0, n = 0; l < lanes_of<V>; ++l) {
            out[n] = record_length * (first + l);
            n += static_cast<int>(bits >> l & 1);
        }
#endif
        return __builtin_popcount(bits);
    }
}

}  // namespace brisance
