// SPDX-License-Identifier: Apache-2.0
// log2, exp2 and x^y as plain arithmetic: they vectorise, and give the same bits on every machine, which libm does not promise.
// Relative error of x^y: about 2 + |y log2 x| / 2 units in the last place (measured in tests/unit/power_test.cpp).
#pragma once

#include "math/pack.h"

namespace brisance {

namespace detail {
template <class To, class From> BRISANCE_HD inline To bits(From x) {
    static_assert(sizeof(To) == sizeof(From));
    To y;
    std::memcpy(&y, &x, sizeof(y));
    return y;
}
template <class R> struct FloatLayout;
template <> struct FloatLayout<double> {
    static constexpr int mantissa = 52;
    static constexpr std::int64_t one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd;
    static constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer in the low bits
    static constexpr double tiny = 1e-300, limit = 1000;
    static constexpr int log_terms = 11, exp_terms = 13;
};
template <> struct FloatLayout<float> {
    static constexpr int mantissa = 23;
    static constexpr std::int32_t one = 0x3f800000, sqrt_half = 0x3f3504f3;
    static constexpr float magic = 12582912.0f;  // 1.5 * 2^23
    static constexpr float tiny = 1e-37f, limit = 120;
    static constexpr int log_terms = 5, exp_terms = 6;
};
}  // namespace detail

/// log2(x) for x > 0; numbers at or below the smallest normal are taken as that.
template <class V> BRISANCE_HD inline V log2_positive(V x) {
    using R = ScalarOf<V>;
    using I = typename detail::BitsOf<V>::type;
    using L = detail::FloatLayout<R>;
    x = vmax(x, broadcast<V>(L::tiny));
    // x = 2^k m with m in [sqrt(1/2), sqrt(2))
    const I shifted = detail::bits<I>(x) - L::sqrt_half;
    const I k = shifted >> L::mantissa;
    const V m = detail::bits<V>(detail::bits<I>(x) - (k << L::mantissa));
    const V kf = detail::bits<V>(k + detail::bits<I>(broadcast<V>(L::magic))) - L::magic;
    const V f = (m - R(1)) / (m + R(1));
    const V f2 = f * f;
    V series = broadcast<V>(R(1) / R(2 * L::log_terms - 1));
    for (int n = L::log_terms - 2; n >= 0; --n) series = series * f2 + R(1) / R(2 * n + 1);
    return kf + R(2.8853900817779268147) * f * series;  // 2 / ln 2
}

/// 2^x, with x clamped to the range of the type.
template <class V> BRISANCE_HD inline V exp2_clamped(V x) {
    using R = ScalarOf<V>;
    using I = typename detail::BitsOf<V>::type;
    using L = detail::FloatLayout<R>;
    x = clamp(x, broadcast<V>(-L::limit), broadcast<V>(L::limit));
    const V shifted = x + L::magic;
    const I n = detail::bits<I>(shifted) - detail::bits<I>(broadcast<V>(L::magic));
    const V y = (x - (shifted - L::magic)) * R(0.69314718055994530942);
    R inverse_factorial[L::exp_terms + 1];
    inverse_factorial[0] = 1;
    for (int i = 1; i <= L::exp_terms; ++i) inverse_factorial[i] = inverse_factorial[i - 1] / R(i);
    V series = broadcast<V>(inverse_factorial[L::exp_terms]);
    for (int i = L::exp_terms - 1; i >= 0; --i) series = series * y + inverse_factorial[i];
    return detail::bits<V>(detail::bits<I>(series) + (n << L::mantissa));
}

/// x^y for x > 0; 0 for x <= 0 (laws guard the exponent 0 themselves).
template <class V> BRISANCE_HD inline V power(V x, ScalarOf<V> y) {
    const V p = exp2_clamped(log2_positive(x) * y);
    return (x > V{}) ? p : V{};
}
template <class V> BRISANCE_HD inline V natural_log(V x) { return log2_positive(x) * ScalarOf<V>(0.69314718055994530942); }
template <class V> BRISANCE_HD inline V exponential(V x) { return exp2_clamped(x * ScalarOf<V>(1.4426950408889634074)); }

}  // namespace brisance
