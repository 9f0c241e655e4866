// SPDX-License-Identifier: Apache-2.0
#include "analysis/orientation.h"

#include "analysis/point_grid.h"

#include <algorithm>
#include <cmath>

namespace brisance::analysis {

std::vector<Orientation> damage_orientation(const SectionPoints& points, double threshold, double reach) {
    std::vector<Orientation> result(points.count());
    if (points.count() == 0) return result;
    const PointGrid grid(points.x, points.y, 2 * *std::min_element(points.size.begin(), points.size.end()));
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, threshold)) continue;
        double m = 0, mx = 0, my = 0, mxx = 0, mxy = 0, myy = 0;
        grid.near(points.x[i], points.y[i], reach * points.size[i], [&](std::size_t j) {
            if (!points.cracked(j, threshold)) return;
            const double a = points.area(j), dx = points.x[j] - points.x[i], dy = points.y[j] - points.y[i];
            m += a;
            mx += a * dx;
            my += a * dy;
            mxx += a * dx * dx;
            mxy += a * dx * dy;
            myy += a * dy * dy;
        });
        const double c_xx = mxx / m - mx * mx / (m * m), c_yy = myy / m - my * my / (m * m), c_xy = mxy / m - mx * my / (m * m);
        const double trace = c_xx + c_yy, difference = std::hypot(c_xx - c_yy, 2 * c_xy);  // lambda_1 +- lambda_2
        if (!(difference > 1e-12 * points.area(i))) continue;
        const double two_theta = 2 * points.azimuth(i);
        result[i].along = ((c_xx - c_yy) * std::cos(two_theta) + 2 * c_xy * std::sin(two_theta)) / difference;
        result[i].strength = difference / trace;
    }
    return result;
}

}  // namespace brisance::analysis
