// SPDX-License-Identifier: Apache-2.0
// From one deformation gradient to the next: the strain increment sym(dF F_half^-1) and the rotation of the step, both exact for rigid
// rotations (Hughes & Winget 1980).
#pragma once

#include "math/vec.h"

namespace brisance {

template <class V>
struct Increment {
    Sym3<V> d;
    Mat3<V> rotation;
};

template <class V> BRISANCE_INLINE Increment<V> increment(const Mat3<V>& f_old, const Mat3<V>& f_new) {
    using R = ScalarOf<V>;
    const Mat3<V> half = broadcast<V>(R(0.5)) * (f_old + f_new);
    const Mat3<V> cof = cofactor(half);
    const V dh = half.xx * cof.xx + half.xy * cof.xy + half.xz * cof.xz;
    const V inverse_det = R(1) / ((vabs(dh) > R(1e-6)) ? dh : V{} + R(1e-6));
    // L = dF half^-1, half^-1 = cof^T/det
    const Mat3<V> l = inverse_det * ((f_new - f_old) * transpose(cof));
    Increment<V> out;
    out.d = {l.xx, l.yy, l.zz, R(0.5) * (l.xy + l.yx), R(0.5) * (l.xz + l.zx), R(0.5) * (l.yz + l.zy)};
    // Cayley: (I - W/2)^-1 (I + W/2) with the axial vector a of W/2
    const V ax = R(0.25) * (l.zy - l.yz), ay = R(0.25) * (l.xz - l.zx), az = R(0.25) * (l.yx - l.xy);
    const V f = R(2) / (R(1) + ax * ax + ay * ay + az * az);
    out.rotation = {R(1) - f * (ay * ay + az * az), f * (ax * ay - az), f * (ax * az + ay),
                    f * (ax * ay + az), R(1) - f * (ax * ax + az * az), f * (ay * az - ax),
                    f * (ax * az - ay), f * (ay * az + ax), R(1) - f * (ax * ax + ay * ay)};
    return out;
}

/// q s q^T
template <class V> BRISANCE_INLINE Sym3<V> rotated(const Mat3<V>& q, const Sym3<V>& s) { return symmetric_product(q * s, q); }

}  // namespace brisance
