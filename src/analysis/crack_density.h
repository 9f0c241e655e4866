// SPDX-License-Identifier: Apache-2.0
// Crack density, mm of crack per mm2, in annular zones around the borehole: as printed (Eq. 12), and by crack lines.
#pragma once

#include "analysis/crack_lines.h"
#include "analysis/section_points.h"

#include <span>
#include <vector>

namespace brisance::analysis {

/// Zones are given by their edges: n + 1 ascending radii, mm, from the axis; zone k holds edges[k] <= r < edges[k + 1].
/// The paper's are 0, 24, 48, 72 mm. Each function throws std::invalid_argument where they do not ascend from >= 0.

/// Areas, mm2, pi (r_outer^2 - r_inner^2): the borehole, where it lies in the zone, is counted, as in the images of the experiment.
std::vector<double> zone_areas(std::span<const double> edges);

/// The zone of a radius, or -1 outside.
int zone_of(double radius, std::span<const double> edges);

/// Number of particles with D > threshold in each zone.
std::vector<int> damaged_per_zone(const SectionPoints& points, std::span<const double> edges, double threshold);

/// (Eq. 12) Gamma_z = sum over D_i > threshold of D_i L_i, over A_z. A band k particles wide counts k times, so that Gamma grows as
/// 1/L for a damaged area of given size; compare runs of equal L only.
std::vector<double> density_as_printed(const SectionPoints& points, std::span<const double> edges, double threshold);

/// Length of the crack lines in each zone over its area. Does not depend on the width of the damaged band.
std::vector<double> density_of_lines(std::span<const CrackLine> lines, std::span<const double> edges);

}  // namespace brisance::analysis
