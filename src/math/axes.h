// SPDX-License-Identifier: Apache-2.0
// Principal values with their directions, by Jacobi rotations: for the few points where directions are wanted (values alone: math/eigen.h).
#pragma once

#include "math/vec.h"

#include <utility>

namespace brisance {

struct PrincipalAxes {
    double value[3];         ///< descending
    Vec3<double> axis[3];    ///< unit vectors
};

BRISANCE_HD inline PrincipalAxes principal_axes(const Sym3<double>& s) {
    double a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}, v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (int sweep = 0; sweep < 12; ++sweep)
        for (const auto& [p, q] : pairs) {
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1)), c = 1 / std::sqrt(t * t + 1), w = t * c;
            for (int k = 0; k < 3; ++k) {
                const double kp = a[k][p], kq = a[k][q];
                a[k][p] = c * kp - w * kq;
                a[k][q] = w * kp + c * kq;
            }
            for (int k = 0; k < 3; ++k) {
                const double pk = a[p][k], qk = a[q][k], vp = v[k][p], vq = v[k][q];
                a[p][k] = c * pk - w * qk;
                a[q][k] = w * pk + c * qk;
                v[k][p] = c * vp - w * vq;
                v[k][q] = w * vp + c * vq;
            }
            a[p][q] = a[q][p] = 0;
        }
    PrincipalAxes out{};
    int order[3] = {0, 1, 2};
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 1}})
        if (a[order[i]][order[i]] < a[order[j]][order[j]]) std::swap(order[i], order[j]);
    for (int k = 0; k < 3; ++k) {
        out.value[k] = a[order[k]][order[k]];
        out.axis[k] = {v[0][order[k]], v[1][order[k]], v[2][order[k]]};
    }
    return out;
}

}  // namespace brisance
