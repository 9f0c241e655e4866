// SPDX-License-Identifier: Apache-2.0
// The neighbours of a total-Lagrangian body: pairs of columns with a few offsets along z and constant weights.
//   xi = (dx, dy, z),  g = w xi,  w = V_j sigma/h^5 (-w'(q)/q),  q^2 = (dx^2 + dy^2)/h_xy^2 + z^2/h_z^2,  h = (h_xy^2 h_z)^(1/3)
// The kernel is an ellipsoid in the reference configuration, so that the spacing in the section may differ from that along z; the
// correction matrix K = sum w xi (x) xi restores first-order consistency. V_i w_ij is symmetric: momentum is conserved pairwise.
#pragma once

#include "particles/columns.h"

namespace brisance {

/// The bonds between all particles of column a and those of column b: slot i of a has neighbours i + shift + o, o = 0 ... count-1, at z_first + o dz
/// with the dz of the body.
template <class R>
struct ColumnPair {
    std::int64_t shift;
    R dx, dy;        ///< mm
    R z_first;       ///< z of offset 0, mm
    R h;             ///< smoothing length of the pair for viscosity: the smaller of section and z, mm
    std::int32_t count;
    std::int32_t weights;  ///< first weight in ColumnPairs::w
};

template <class R>
struct ColumnPairs {
    Array<std::int64_t> begin;  ///< pairs of column c: begin[c] ... begin[c+1]-1
    Array<ColumnPair<R>> pairs;
    Array<R> w;                       ///< 1/mm2 (volume folded in)
    // of a column whose neighbours are all there:
    Array<double> k_inverse;    ///< 6 per column: xx yy zz xy xz yz
    Array<double> g_sum;        ///< 3 per column: sum of w xi, 1/mm
    double bonds_per_particle = 0;
};

/// The pairs as bare pointers, for kernels.
template <class R>
struct PairsView {
    const std::int64_t* begin;
    const ColumnPair<R>* pairs;
    const R* w;
    const double* k_inverse;
    const double* g_sum;
};
template <class R>
PairsView<R> view(const ColumnPairs<R>& p) {
    return {p.begin.data(), p.pairs.data(), p.w.data(), p.k_inverse.data(), p.g_sum.data()};
}

/// Finds the pairs (cell grid over the section), their weights and the columns' sums; sets `masked` on tiles with missing neighbours.
/// `smoothing` is h/spacing in the section and along z. Sets columns.pad beforehand through `largest_offset`.
template <class R> ColumnPairs<R> find_column_pairs(Columns& columns, double smoothing);

/// Largest offset along z that a bond can have: that of columns shifted against each other by a layer.
int largest_offset(double smoothing);

}  // namespace brisance
