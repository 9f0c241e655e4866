// SPDX-License-Identifier: Apache-2.0
// Whether two runs crack in the same places: correlation of their damage patterns, one of them turned (the rotated-lattice test).
#pragma once

#include "analysis/section_points.h"

#include <cstddef>
#include <vector>

namespace brisance::analysis {

struct PatternOptions {
    double threshold = 0.8;
    double r_min = 14, r_max = 42;  ///< mm, damaged particles with r_min < r < r_max count
    int sectors = 180;              ///< 2 degrees each
    int smoothing = 3;              ///< moving average over +- this many sectors, around the circle
    int rings = 8;                  ///< of polar_histogram, equally wide
};

/// Damaged area, mm2, by azimuth: `sectors` values, the first beginning at +x, anticlockwise, smoothed.
std::vector<double> angular_histogram(const SectionPoints& points, const PatternOptions& options = {});

/// Damaged share of each polar cell: rings * sectors values, ring by ring from the inside, smoothed along each ring.
struct PolarHistogram {
    std::size_t rings = 0, sectors = 0;
    std::vector<double> values;
};
PolarHistogram polar_histogram(const SectionPoints& points, const PatternOptions& options = {});

/// A histogram turned by an angle, rad, anticlockwise: result(theta) = values(theta - angle), linear between sectors.
std::vector<double> rotated(const std::vector<double>& values, double angle);

/// Pearson's correlation of a with b, b turned by an angle, rad, first. To ask whether a pattern follows the lattice when the lattice is
/// turned by alpha: the lab frame is angle 0, the lattice frame angle -alpha for the run with the turned lattice.
/// NaN where one of them is constant; throws std::invalid_argument where they differ in shape.
double pattern_correlation(const std::vector<double>& a, const std::vector<double>& b, double angle = 0);
double pattern_correlation(const PolarHistogram& a, const PolarHistogram& b, double angle = 0);

}  // namespace brisance::analysis
