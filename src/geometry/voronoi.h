// SPDX-License-Identifier: Apache-2.0
// The area that belongs to each point of a cloud.
#pragma once

#include "geometry/pairs.h"
#include "geometry/section.h"

#include <vector>

namespace brisance {

/// How a point sees the nearest wall.
struct WallView {
    double depth = 0;  ///< mm below the wall
    Vec2 normal;       ///< towards it
};

struct Cell {
    double area = 0;  ///< mm2
    Vec2 centroid;    ///< from the point, mm
};

/// The Voronoi cells, cut off at the walls. `pairs` must reach 2.6 spacings.
/// A wall near a cell is taken as the tangent at its nearest point, plus a tangent where a corner of the cell still sticks out;
/// the area between tangent and wall is added to second order in spacing * curvature.
std::vector<Cell> voronoi_cells(const Section& section, const std::vector<Vec2>& points, const std::vector<double>& spacing,
                                const Pairs& pairs, const std::vector<WallView>& walls);

}  // namespace brisance
