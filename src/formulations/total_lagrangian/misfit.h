// SPDX-License-Identifier: Apache-2.0
// What the deformation gradient does not see, e_ij = x_ij - F_i xi_ij, as the product of two instants a drift apart:
//   sum w e'.e = sum w du'.du - R' : (R K^-1),   R = sum w du (x) xi,   du' = du - dt dv
// (F is the least-squares fit: sum w e (x) xi = 0, at both instants).
#pragma once

#include "formulations/total_lagrangian/total_lagrangian.h"
#include "math/pack.h"

namespace brisance {

/// sum w e_n.e_n-1 of the particles of a tile, mm2; `dt` is the drift that led to u_n.
template <class V, class R>
BRISANCE_HD V misfit(const SolidView<R>& b, const PairsView<R>& pairs, const Tile& tile, R dt, const Sym3<V>& k_inverse) {
    const std::int64_t i = tile.base, c = tile.column;
    const R layer = static_cast<R>(b.dz);
    const R *ux = b.u[0] + i, *uy = b.u[1] + i, *uz = b.u[2] + i, *vx = b.v[0] + i, *vy = b.v[1] + i, *vz = b.v[2] + i;
    const V xi = load<V>(ux), yi = load<V>(uy), zi = load<V>(uz), vxi = load<V>(vx), vyi = load<V>(vy), vzi = load<V>(vz);
    Mat3<V> now{}, before{};  // R of the two instants
    V product{};
    const auto add = [](Mat3<V>& m, const Vec3<V>& a, const V& x, const V& y, const V& z) {
        m.xx += a.x * x;
        m.xy += a.x * y;
        m.xz += a.x * z;
        m.yx += a.y * x;
        m.yy += a.y * y;
        m.yz += a.y * z;
        m.zx += a.z * x;
        m.zy += a.z * y;
        m.zz += a.z * z;
    };
    for (std::int64_t p = pairs.begin[c]; p < pairs.begin[c + 1]; ++p) {
        const ColumnPair<R>& pair = pairs.pairs[p];
        const V x = broadcast<V>(pair.dx), y = broadcast<V>(pair.dy);
        R z = pair.z_first;
        for (int o = 0; o < pair.count; ++o, z += layer) {
            const std::int64_t j = pair.shift + o;
            V weight = broadcast<V>(pairs.w[pair.weights + o]);
            if (tile.masked) weight = weight * load_float<V>(b.live + i + j);
            const Vec3<V> du{load<V>(ux + j) - xi, load<V>(uy + j) - yi, load<V>(uz + j) - zi};
            const Vec3<V> earlier{du.x - dt * (load<V>(vx + j) - vxi), du.y - dt * (load<V>(vy + j) - vyi), du.z - dt * (load<V>(vz + j) - vzi)};
            product += weight * dot(du, earlier);
            add(now, weight * du, x, y, broadcast<V>(z));
            add(before, weight * earlier, x, y, broadcast<V>(z));
        }
    }
    return product - ddot(now * k_inverse, before);
}

}  // namespace brisance
