// SPDX-License-Identifier: Apache-2.0
// Moves the points of a cloud until they lie evenly, first by repulsion, then by the corrected gradient itself.
#pragma once

#include "geometry/pairs.h"
#include "geometry/section.h"
#include "geometry/voronoi.h"

#include <vector>

namespace brisance {

/// Points on their way into a cloud.
struct Relaxing {
    enum class Motion : unsigned char { fixed, along_wall, free };

    std::vector<Vec2> points;
    std::vector<double> spacing;
    std::vector<Motion> motion;
    std::vector<WallView> walls;      ///< of the points in layers; of free points a depth they are known to have, at least
    double least_depth = 0;           ///< spacings below the wall that free points keep
};

/// Repulsion: x_i += 0.25 D sum_j (1 - r / 2D)^2 (x_i - x_j) / r over r < 2D, D the spacing of the pair. Only free points move.
void repel(Relaxing& cloud, const Section& section, int steps);

/// The zeroth-order error of the corrected gradient, per point, 1/mm:
///   E_i = sum_j V_j (K_i^-1 + K_j^-1) g_ij,   g = -W'(R) / R xi,   K_i = sum_j V_j g_ij xi_ij^T,   xi_ij = x_j - x_i
/// with W the cubic spline in the plane, h of a pair = smoothing * its spacing. A uniform stress would push each point by E.
std::vector<Vec2> zeroth_order_error(const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                     const std::vector<double>& area, const Pairs& pairs, double smoothing);

/// Lowers that error: x_i -= beta D^2 E_i, with V the areas of the Voronoi cells.
void polish(Relaxing& cloud, const Section& section, int steps, double smoothing);

void centre(Relaxing& cloud, const Section& section, int steps);

/// Renews `walls` for all points.
void view_walls(Relaxing& cloud, const Section& section);

}  // namespace brisance
