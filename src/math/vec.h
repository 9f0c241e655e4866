// SPDX-License-Identifier: Apache-2.0
// Small vectors and matrices, templated on the scalar: float, double, or a SIMD pack of either (math/pack.h).
#pragma once

#include "base/hd.h"
#include "math/pack.h"

#include <cmath>

namespace brisance {

struct Vec2 {
    double x = 0, y = 0;
};
inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }

template <class R>
struct Vec3 {
    R x{}, y{}, z{};
};
template <class R> BRISANCE_INLINE Vec3<R> operator+(Vec3<R> a, Vec3<R> b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class R> BRISANCE_INLINE Vec3<R> operator-(Vec3<R> a, Vec3<R> b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class R> BRISANCE_INLINE Vec3<R> operator*(R s, Vec3<R> a) { return {s * a.x, s * a.y, s * a.z}; }
template <class R> BRISANCE_INLINE R dot(Vec3<R> a, Vec3<R> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class R> BRISANCE_INLINE Vec3<R> cross(Vec3<R> a, Vec3<R> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R> BRISANCE_INLINE R norm(Vec3<R> a) { return std::sqrt(dot(a, a)); }

/// Symmetric tensor; components in the order xx, yy, zz, xy, xz, yz.
template <class R>
struct Sym3 {
    R xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};
/// Component k in that order.
template <class R> BRISANCE_INLINE R& component(Sym3<R>& a, std::size_t k) { return (&a.xx)[k]; }
template <class R> BRISANCE_INLINE const R& component(const Sym3<R>& a, std::size_t k) { return (&a.xx)[k]; }
template <class R> BRISANCE_INLINE Vec3<R> operator*(const Sym3<R>& s, const Vec3<R>& v) {
    return {s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z, s.xz * v.x + s.yz * v.y + s.zz * v.z};
}
template <class R> BRISANCE_INLINE R trace(const Sym3<R>& a) { return a.xx + a.yy + a.zz; }
template <class R> BRISANCE_INLINE R ddot(const Sym3<R>& a, const Sym3<R>& b) {
    const R off = a.xy * b.xy + a.xz * b.xz + a.yz * b.yz;
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + (off + off);
}

/// General tensor, row-major names: xy is row x, column y.
template <class R>
struct Mat3 {
    R xx{}, xy{}, xz{}, yx{}, yy{}, yz{}, zx{}, zy{}, zz{};
};
template <class R> BRISANCE_INLINE Mat3<R> operator+(const Mat3<R>& a, const Mat3<R>& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
            a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}
template <class R> BRISANCE_INLINE Mat3<R> operator-(const Mat3<R>& a, const Mat3<R>& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yx - b.yx, a.yy - b.yy,
            a.yz - b.yz, a.zx - b.zx, a.zy - b.zy, a.zz - b.zz};
}
template <class R> BRISANCE_INLINE Mat3<R> operator*(R s, const Mat3<R>& a) {
    return {s * a.xx, s * a.xy, s * a.xz, s * a.yx, s * a.yy, s * a.yz, s * a.zx, s * a.zy, s * a.zz};
}
template <class R> BRISANCE_INLINE Mat3<R> operator*(const Mat3<R>& a, const Mat3<R>& b) {
    return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy, a.xx * b.xz + a.xy * b.yz + a.xz * b.zz,
            a.yx * b.xx + a.yy * b.yx + a.yz * b.zx, a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
            a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy, a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}
template <class R> BRISANCE_INLINE Mat3<R> operator*(const Mat3<R>& a, const Sym3<R>& s) {
    return {a.xx * s.xx + a.xy * s.xy + a.xz * s.xz, a.xx * s.xy + a.xy * s.yy + a.xz * s.yz, a.xx * s.xz + a.xy * s.yz + a.xz * s.zz,
            a.yx * s.xx + a.yy * s.xy + a.yz * s.xz, a.yx * s.xy + a.yy * s.yy + a.yz * s.yz, a.yx * s.xz + a.yy * s.yz + a.yz * s.zz,
            a.zx * s.xx + a.zy * s.xy + a.zz * s.xz, a.zx * s.xy + a.zy * s.yy + a.zz * s.yz, a.zx * s.xz + a.zy * s.yz + a.zz * s.zz};
}
template <class R> BRISANCE_INLINE Mat3<R> operator*(const Sym3<R>& s, const Mat3<R>& a) {
    return {s.xx * a.xx + s.xy * a.yx + s.xz * a.zx, s.xx * a.xy + s.xy * a.yy + s.xz * a.zy, s.xx * a.xz + s.xy * a.yz + s.xz * a.zz,
            s.xy * a.xx + s.yy * a.yx + s.yz * a.zx, s.xy * a.xy + s.yy * a.yy + s.yz * a.zy, s.xy * a.xz + s.yy * a.yz + s.yz * a.zz,
            s.xz * a.xx + s.yz * a.yx + s.zz * a.zx, s.xz * a.xy + s.yz * a.yy + s.zz * a.zy, s.xz * a.xz + s.yz * a.yz + s.zz * a.zz};
}
template <class R> BRISANCE_INLINE Vec3<R> operator*(const Mat3<R>& a, const Vec3<R>& v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.yx * v.x + a.yy * v.y + a.yz * v.z, a.zx * v.x + a.zy * v.y + a.zz * v.z};
}
template <class R> BRISANCE_INLINE Mat3<R> transpose(const Mat3<R>& a) {
    return {a.xx, a.yx, a.zx, a.xy, a.yy, a.zy, a.xz, a.yz, a.zz};
}
template <class R> BRISANCE_INLINE R det(const Mat3<R>& a) {
    return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) + a.xz * (a.yx * a.zy - a.yy * a.zx);
}
template <class R> BRISANCE_INLINE R det(const Sym3<R>& a) {
    return a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) + a.xz * (a.xy * a.yz - a.yy * a.xz);
}
/// a b^T where it is known to be symmetric, as for q s q^T = (q s) q^T and a a^T.
template <class R> BRISANCE_INLINE Sym3<R> symmetric_product(const Mat3<R>& a, const Mat3<R>& b) {
    return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.yx * b.yx + a.yy * b.yy + a.yz * b.yz, a.zx * b.zx + a.zy * b.zy + a.zz * b.zz,
            a.xx * b.yx + a.xy * b.yy + a.xz * b.yz, a.xx * b.zx + a.xy * b.zy + a.xz * b.zz, a.yx * b.zx + a.yy * b.zy + a.yz * b.zz};
}
/// Cofactor matrix: det(a) a^-T.
template <class R> BRISANCE_INLINE Mat3<R> cofactor(const Mat3<R>& a) {
    return {a.yy * a.zz - a.yz * a.zy, a.yz * a.zx - a.yx * a.zz, a.yx * a.zy - a.yy * a.zx,
            a.xz * a.zy - a.xy * a.zz, a.xx * a.zz - a.xz * a.zx, a.xy * a.zx - a.xx * a.zy,
            a.xy * a.yz - a.xz * a.yy, a.xz * a.yx - a.xx * a.yz, a.xx * a.yy - a.xy * a.yx};
}
/// a : b, the sum of products of components.
template <class R> BRISANCE_INLINE R ddot(const Mat3<R>& a, const Mat3<R>& b) {
    return a.xx * b.xx + a.xy * b.xy + a.xz * b.xz + a.yx * b.yx + a.yy * b.yy + a.yz * b.yz + a.zx * b.zx + a.zy * b.zy + a.zz * b.zz;
}
/// Inverse of a symmetric matrix. The caller guarantees that it is regular.
template <class R> BRISANCE_INLINE Sym3<R> inverse(const Sym3<R>& a) {
    const R c_xx = a.yy * a.zz - a.yz * a.yz;
    const R c_xy = a.xz * a.yz - a.xy * a.zz;
    const R c_xz = a.xy * a.yz - a.xz * a.yy;
    const R d = ScalarOf<R>(1) / (a.xx * c_xx + a.xy * c_xy + a.xz * c_xz);
    return {c_xx * d, (a.xx * a.zz - a.xz * a.xz) * d, (a.xx * a.yy - a.xy * a.xy) * d,
            c_xy * d, c_xz * d, (a.xy * a.xz - a.xx * a.yz) * d};
}

}  // namespace brisance
