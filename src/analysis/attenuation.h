// SPDX-License-Identifier: Apache-2.0
// How peaks (of pressure, of radial stress) fall with distance: bins of all particles, and a power law p = a r^-n.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace brisance::analysis {

/// Peaks by distance. One entry for each bin that holds particles.
struct PeakBins {
    std::vector<double> r;                 ///< mm, mean distance of the bin's particles
    std::vector<double> median, p10, p90;  ///< GPa
    std::vector<int> particles;
};

/// r, peak: one per particle, mm and GPa. edges: ascending, mm; a bin holds edges[k] <= r < edges[k + 1].
/// Throws std::invalid_argument on columns of different length, or fewer than two ascending edges.
PeakBins bin_peaks(std::span<const double> r, std::span<const double> peak, std::span<const double> edges);

/// n + 1 edges from r_min to r_max, mm, equally spaced in log r: bins that suit a power law.
std::vector<double> logarithmic_edges(double r_min, double r_max, int bins);

/// NaN where nothing was fitted.
struct PowerLaw {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    double coefficient = unknown;             ///< a, GPa at r = 1 mm
    double exponent = unknown;                ///< n
    double exponent_error = unknown;          ///< standard error of n; needs three points
    double r_min = unknown, r_max = unknown;  ///< mm, the range that was fitted
    int points = 0;
};

/// Least squares of ln p = ln a - n ln r over the points with r_min <= r <= r_max, r > 0 and p > 0. All NaN with fewer than two distances.
/// The error is that of the regression: it holds for independent points (bins), not for the scatter of neighbouring particles.
PowerLaw fit_power_law(std::span<const double> r, std::span<const double> p, double r_min, double r_max);

}  // namespace brisance::analysis
