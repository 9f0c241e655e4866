// SPDX-License-Identifier: Apache-2.0
// Principal values of symmetric tensors without trigonometry: Newton on the characteristic cubic from a bound, branch-free.
#pragma once

#include "math/vec.h"

namespace brisance {

template <class V> struct Principal { V one, two, three; };
/// Principal values, one >= two >= three.
/// With the deviator divided by sqrt(J2/3) its characteristic polynomial is t^3 - 3t - c, |c| <= 2. The root of the sign of c lies apart
/// from the other two, |t| in [sqrt 3, 2]: Newton's method from the chord of t(c) gets it to round-off in 4 steps. The other two follow
/// from the quadratic that is left. Error over the von Mises stress: round-off, but its square root (1e-8 in double, 1e-3 in float) in
/// two values that nearly coincide, as in every method that goes through the polynomial.
template <class V> BRISANCE_HD inline Principal<V> principal(const Sym3<V>& a) {
    using R = ScalarOf<V>;
    const V zero{};
    // Quotients, roots and maxima feed the sums below, no products: which of those are contracted would depend on the caller.
    const V mean = trace(a) / R(3);
    const Sym3<V> d{a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
    const V size = vsqrt(R(1.0 / 6.0) * ddot(d, d));  // sqrt(J2/3)
    const V f = R(1) / vmax(size, V{} + R(1e-30));
    const Sym3<V> s{d.xx * f, d.yy * f, d.zz * f, d.xy * f, d.xz * f, d.yz * f};
    const V c = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - s.yy * s.xz);
    const V size_of_c = vmin(vabs(c), V{} + R(2));
    V t = R(1.7320508075688773) + R(0.13397459621556135) * size_of_c;  // from sqrt 3 at c = 0 to 2 at c = 2
    for (int i = 0; i < 4; ++i) t = t - (t * (t * t - R(3)) - size_of_c) / (R(3) * (t * t - R(1)));
    const V apart = vsqrt(R(0.75) * sq(size) * vmax((R(2) - t) * (R(2) + t), zero));
    const auto positive = c >= zero;
    const V sign = positive ? V{} + R(1) : V{} - R(1);
    const V far = vmax(size * t, zero);
    const V lone = mean + sign * far, centre = mean - sign * (R(0.5) * far);
    const V high = centre + apart, low = centre - apart;
    return {positive ? lone : high, positive ? high : low, positive ? low : lone};
}

}  // namespace brisance
