// SPDX-License-Identifier: Apache-2.0
// A region together with the spacing wanted in it, seen in the frame of the arrangement.
#pragma once

#include "math/vec.h"

#include <functional>

namespace brisance {

/// Everything that builds a cloud works in a frame that is turned about the origin, and only the finished points are turned
/// back. So `CloudOptions::angle` rotates grids, random numbers and sums alike, and a round region gives the same cloud, turned.
struct Section {
    std::function<double(Vec2)> distance;  ///< signed distance to the wall, mm, negative inside
    std::function<double(Vec2)> spacing;   ///< mm
    double reach = 0;                      ///< no point of the region is farther from the origin, mm

    double depth(Vec2 p) const { return -distance(p); }

    /// Unit vector towards the nearest wall: the gradient of the distance, by central differences.
    /// On a ridge, where several walls are nearest, some unit vector.
    Vec2 normal(Vec2 p) const {
        const double e = 1e-4 * spacing(p);
        const Vec2 g{distance({p.x + e, p.y}) - distance({p.x - e, p.y}), distance({p.x, p.y + e}) - distance({p.x, p.y - e})};
        const double length = norm(g);
        return length > 1e-3 * e ? 1 / length * g : Vec2{1, 0};
    }
};

}  // namespace brisance
