// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exec/launch.h"
#include "math/vec.h"

namespace brisance {

/// The box around some points, mm; without points min > max.
struct PointBox {
    double min[3] = {1e300, 1e300, 1e300}, max[3] = {-1e300, -1e300, -1e300};
    BRISANCE_HD PointBox& operator+=(const PointBox& o) {
        for (int a = 0; a < 3; ++a) {
            min[a] = o.min[a] < min[a] ? o.min[a] : min[a];
            max[a] = o.max[a] > max[a] ? o.max[a] : max[a];
        }
        return *this;
    }
    /// Whether (x, y) is no further than `margin` from the box's section.
    BRISANCE_HD bool beside(double x, double y, double margin) const {
        return x > min[0] - margin && x < max[0] + margin && y > min[1] - margin && y < max[1] + margin;
    }
    BRISANCE_HD Vec3<double> middle() const { return {0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1]), 0.5 * (min[2] + max[2])}; }
    /// From the middle to the corner where all are largest.
    BRISANCE_HD Vec3<double> half() const { return {0.5 * (max[0] - min[0]), 0.5 * (max[1] - min[1]), 0.5 * (max[2] - min[2])}; }
};
BRISANCE_HD inline PointBox box_of(double x, double y, double z) { return {{x, y, z}, {x, y, z}}; }
inline PointBox box_of(const double* x, const double* y, const double* z, std::int64_t n) {
    return exec::launch_sum(n, PointBox{}, BRISANCE_KERNEL(std::int64_t i) { return box_of(x[i], y[i], z[i]); });
}

}  // namespace brisance
