// SPDX-License-Identifier: Apache-2.0
// The few statistics that the analysis needs.
#pragma once

#include <span>
#include <vector>

namespace brisance::analysis {

/// Quantile q (0 ... 1) of values in any order, linear between order statistics (rank q (n - 1)). NaN of nothing.
double quantile(std::vector<double> values, double q);

/// Pearson's correlation of two series of equal length; NaN where one of them is constant. Throws std::invalid_argument on unequal length.
double pearson(std::span<const double> a, std::span<const double> b);

/// Probability that chi-square with this many degrees of freedom is at least `value`: Q(freedom / 2, value / 2), the
/// regularised upper incomplete gamma function, by its series below freedom / 2 + 1 and Lentz's continued fraction above.
double chi_square_survival(double value, double freedom);

}  // namespace brisance::analysis
