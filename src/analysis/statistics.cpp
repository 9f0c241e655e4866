// SPDX-License-Identifier: Apache-2.0
#include "analysis/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace brisance::analysis {

namespace {
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double precision = 1e-15;
constexpr int most_terms = 10000;

/// P(a, x) by its power series; converges for all x, fast for x < a + 1.
double lower_gamma(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < most_terms && term > precision * sum; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Q(a, x) by its continued fraction (modified Lentz); for x > a + 1.
double upper_gamma(double a, double x) {
    constexpr double tiny = 1e-300;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, fraction = d;
    for (int n = 1; n < most_terms; ++n) {
        const double factor = -n * (n - a);
        b += 2;
        d = 1 / (factor * d + b);
        c = b + factor / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < precision) break;
    }
    return fraction * std::exp(a * std::log(x) - x - std::lgamma(a));
}
}  // namespace

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return not_a_number;
    std::sort(values.begin(), values.end());
    const double rank = std::clamp(q, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

double pearson(std::span<const double> a, std::span<const double> b) {
    if (a.size() != b.size()) throw std::invalid_argument("pearson: series of different length");
    const auto n = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : not_a_number;
}

double chi_square_survival(double value, double freedom) {
    if (!(freedom > 0) || std::isnan(value)) return not_a_number;
    if (value <= 0) return 1;
    const double a = freedom / 2, x = value / 2;
    return x < a + 1 ? 1 - lower_gamma(a, x) : upper_gamma(a, x);
}

}  // namespace brisance::analysis
