// SPDX-License-Identifier: Apache-2.0
// Cracks as lines: the thinned damage of a section without its spurs, with the length that a ruler on the cut face would find.
#pragma once

#include "analysis/damage_raster.h"
#include "math/vec.h"

#include <vector>

namespace brisance::analysis {

/// One line between two ends or branching points, or a closed loop.
struct CrackLine {
    std::vector<Vec2> points;       ///< mm, smoothed over the size of a particle, about one per pixel; a loop repeats its first point
    double tip_first = 0, tip_last = 0;  ///< mm, how far the crack reaches beyond the first and last point: see crack_lines

    double length() const;          ///< mm, tips included
};

struct LineOptions {
    double spur = 2;       ///< particle sizes; side branches that stand out less from their crack are roughness, not cracks
    double smoothing = 1;  ///< particle sizes; half width of the moving average along a line
};

/// The lines of a mask (pixels of raster.damaged, or a part of them).
///
/// 1. The mask is thinned (thinning.h).
/// 2. Spurs are removed: a branch with a free end at a distance d from its junction counts as a spur where
///    d + w_end - w_junction < spur * size, with w the distance to the edge of the damage: that is how far it stands out from the
///    largest disc of damage around the junction. So does one that stands out as little from a disc around another line without
///    a free end: in broad damage, thinning leaves lines that lead from its middle to each dent of its edge. Where all
///    branches of a junction are spurs the two longest stay. Repeated until none is left.
/// 3. Lines are traced and smoothed by a moving average. Steps of 1 and sqrt(2) pixels alone would measure a straight line up to 8 %
///    too long, and cells that follow a line in stairs would add as much again; the average removes both.
/// 4. Thinning shortens a line of width 2 w by w at each end. A free end gets its w back as a tip.
///
/// What it gives: a straight crack its length, whatever its width; a ring its mean circumference; a filled disc its diameter, as
/// the thinned disc is near one point with two tips; a single particle 1 to 1.4 times its size. A crushed zone therefore counts as
/// next to nothing (around a borehole: its mean circumference, from which the cracks that leave it are measured): its measure is
/// crushed_radius (cracks.h), or the density as printed.
std::vector<CrackLine> crack_lines(const SectionPoints& points, const DamageRaster& raster, const Mask& mask,
                                   const LineOptions& options = {});

}  // namespace brisance::analysis
