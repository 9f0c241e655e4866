// SPDX-License-Identifier: Apache-2.0
// The cubic spline of Monaghan & Lattanzio, support 2h:
//   W = w(q) / (pi h^3),  w = 1 - 1.5 q^2 + 0.75 q^3 (q < 1), (2 - q)^3 / 4 (q < 2)      q = r/h
#pragma once

#include "math/pack.h"

namespace brisance::kernel {

inline constexpr double sigma_3d = 0.31830988618379067;  ///< 1/pi
inline constexpr double sigma_2d = 0.45472840883398671;  ///< 10/(7 pi)

/// w(q)
template <class V> BRISANCE_HD inline V shape(V q) {
    using R = ScalarOf<V>;
    const V two = vmax(R(2) - q, V{});
    return (q < R(1)) ? R(1) - q * q * (R(1.5) - R(0.75) * q) : R(0.25) * two * two * two;
}
/// -w'(q)/q, finite at q = 0: the weight of a bond, g = weight * xi / h^(d+2).
template <class V> BRISANCE_HD inline V bond(V q, V inverse_q) {
    using R = ScalarOf<V>;
    const V two = vmax(R(2) - q, V{});
    return (q < R(1)) ? R(3) - R(2.25) * q : R(0.75) * two * two * inverse_q;
}
template <class V> BRISANCE_HD inline V bond(V q) { return bond(q, ScalarOf<V>(1) / vmax(q, V{} + ScalarOf<V>(1e-6))); }

}  // namespace brisance::kernel
