// SPDX-License-Identifier: Apache-2.0
// The layers of points that follow the walls of a section.
#pragma once

#include "geometry/quadtree.h"
#include "geometry/section.h"

#include <cstdint>
#include <vector>

namespace brisance {

/// Where a point lies between two walls, counted in layers instead of mm.
struct LayerDepth {
    double layers = 0;  ///< below the nearest wall; negative outside
    int across = 0;     ///< layers that fill the section from wall to wall; 0 where it is thick
};

/// Counts layers along the straight line through p from the nearest wall to the opposite one, N = integral ds / spacing.
/// Thin means round(N) <= 2 wall_layers + 3: there is no room for a relaxed cloud between the layers of both walls, so the
/// whole thickness is cut into round(N) equal layers. Elsewhere a layer is as thick as the spacing.
LayerDepth layer_depth(const Section& section, Vec2 p, int wall_layers);

struct WallPoint {
    enum class Place : unsigned char {
        along_wall,  ///< may slide along its layer
        corner,      ///< where two walls meet
        middle,      ///< in the middle layer of a thin part
        inside       ///< in a layer beyond `wall_layers` that ends where a thin part becomes thick
    };
    Vec2 p;
    int layer = 0;
    Place place = Place::along_wall;
};

/// The points of all layers: layer l runs at the depth of l + 1/2 layers.
std::vector<WallPoint> wall_layers(const Section& section, const std::vector<Leaf>& leaves, int layers, std::uint64_t seed);

}  // namespace brisance
