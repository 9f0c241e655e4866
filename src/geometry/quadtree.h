// SPDX-License-Identifier: Apache-2.0
// A section cut into squares about as large as the spacing, in the order of Hilbert's curve.
#pragma once

#include "geometry/section.h"

#include <vector>

namespace brisance {

struct Leaf {
    Vec2 centre;
    double side = 0;
    double spacing = 0;  ///< at the centre
    double depth = 0;    ///< of the centre below the nearest wall; negative outside
};

/// Every square of side <= fineness * spacing that touches the region. Root: the square |x|, |y| <= reach, halved again and again.
/// Throws InputError where the spacing is not a positive number.
std::vector<Leaf> quadtree(const Section& section, double fineness);

}  // namespace brisance
