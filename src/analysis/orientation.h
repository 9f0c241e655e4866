// SPDX-License-Identifier: Apache-2.0
// Which way the damage runs at a particle: the long axis of the damaged particles around it.
#pragma once

#include "analysis/section_points.h"

#include <vector>

namespace brisance::analysis {

/// Direction of the damage at one particle against the radius through it.
struct Orientation {
    double along = 0;     ///< cos 2(phi - theta), phi the long axis, theta the azimuth: 1 radial, -1 circumferential
    double strength = 0;  ///< anisotropy of the neighbourhood, 0 (round, or nobody there) ... 1 (all on one line)
};

/// One entry per particle; particles with D <= threshold keep zeros. The axis is that of the second moments, weighted by area, of the
/// damaged particles within `reach` sizes about their own centre; strength = (lambda_1 - lambda_2) / (lambda_1 + lambda_2).
std::vector<Orientation> damage_orientation(const SectionPoints& points, double threshold, double reach = 4);

}  // namespace brisance::analysis
