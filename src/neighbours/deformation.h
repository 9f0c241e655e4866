// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/vec.h"
#include "neighbours/column_pairs.h"
#include "particles/solid_body.h"

namespace brisance {

/// F of one particle, from the sums of the last stress pass and the K of a whole neighbourhood of its column.
template <class R>
BRISANCE_HD inline Mat3<double> deformation_gradient(const SolidView<R>& b, const PairsView<R>& pairs, std::int64_t column, std::int64_t slot) {
    const double* k = pairs.k_inverse + 6 * column;
    const auto r = [&](int n) { return static_cast<double>(b.R_sum[n][slot]); };
    Mat3<double> f = Mat3<double>{r(0), r(1), r(2), r(3), r(4), r(5), r(6), r(7), r(8)} * Sym3<double>{k[0], k[1], k[2], k[3], k[4], k[5]};
    f.xx += 1;
    f.yy += 1;
    f.zz += 1;
    return f;
}

}  // namespace brisance
