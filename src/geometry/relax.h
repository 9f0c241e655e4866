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
    std::vector<Vec2> corners;        ///< where walls meet
    double least_depth = 0;           ///< spacings below the wall that free points keep
};

/// Repulsion: x_i += 0.25 D sum_j (1 - r / 2D)^2 (x_i - x_j) / r over r < 2D, D the spacing of the pair. Only free points move.
void repel(Relaxing& cloud, const Section& section, int steps);

/// The zeroth-order error of the corrected gradient, per point, 1/mm:
///   E_i = sum_j V_j (K_i^-1 + K_j^-1) g_ij,   g = -W'(R) / R xi,   K_i = sum_j V_j g_ij xi_ij^T,   xi_ij = x_j - x_i
/// with W the cubic spline in the plane, h of a pair = smoothing * its spacing. A uniform stress would push each point by E.
std::vector<Vec2> zeroth_order_error(const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                     const std::vector<double>& area, const Pairs& pairs, double smoothing);

/// Lowers that error by descent on S = sum |E|^2 / 2, with V the areas of the Voronoi cells:
///   dx_i = -rate D^4 dS/dx_i,   dS/dx_i = sum_j 2 V_j (dg/dxi)_ij (E_j - E_i)   (V and K ~ I taken as constant)
/// Descent on S moves points no farther than it must. Steps along -E itself reach as low, but let pairs of points collapse,
/// since the force of the spline fades at small distances. What is left of that is held up by a push between close pairs.
/// Near a wall E has a part along the normal that is no error: it is how the surface passes on its traction. It is left out of S;
/// near a corner, where every direction has such a part, E is left out altogether. Points in layers slide along their layer.
void polish(Relaxing& cloud, const Section& section, int steps, double smoothing);

/// Renews `walls` for all points.
void view_walls(Relaxing& cloud, const Section& section);

}  // namespace brisance
