// SPDX-License-Identifier: Apache-2.0
#include "analysis/attenuation.h"

#include "analysis/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace brisance::analysis {

PeakBins bin_peaks(std::span<const double> r, std::span<const double> peak, std::span<const double> edges) {
    if (r.size() != peak.size()) throw std::invalid_argument("peaks: columns of different length");
    if (edges.size() < 2 || !std::is_sorted(edges.begin(), edges.end(), std::less_equal<>()))
        throw std::invalid_argument("peaks: two or more ascending edges");
    std::vector<std::vector<double>> distance(edges.size() - 1), values(edges.size() - 1);
    for (std::size_t i = 0; i < r.size(); ++i) {
        const auto above = std::upper_bound(edges.begin(), edges.end(), r[i]);
        if (above == edges.begin() || above == edges.end()) continue;
        const auto bin = static_cast<std::size_t>(above - edges.begin()) - 1;
        distance[bin].push_back(r[i]);
        values[bin].push_back(peak[i]);
    }
    PeakBins bins;
    for (std::size_t b = 0; b < values.size(); ++b) {
        if (values[b].empty()) continue;
        bins.r.push_back(std::accumulate(distance[b].begin(), distance[b].end(), 0.0) / static_cast<double>(distance[b].size()));
        bins.median.push_back(quantile(values[b], 0.5));
        bins.p10.push_back(quantile(values[b], 0.1));
        bins.p90.push_back(quantile(values[b], 0.9));
        bins.particles.push_back(static_cast<int>(values[b].size()));
    }
    return bins;
}

std::vector<double> logarithmic_edges(double r_min, double r_max, int bins) {
    if (!(r_min > 0 && r_max > r_min) || bins < 1) throw std::invalid_argument("peaks: 0 < r_min < r_max and one bin or more");
    std::vector<double> edges;
    for (int k = 0; k <= bins; ++k) edges.push_back(r_min * std::pow(r_max / r_min, static_cast<double>(k) / bins));
    return edges;
}

PowerLaw fit_power_law(std::span<const double> r, std::span<const double> p, double r_min, double r_max) {
    if (r.size() != p.size()) throw std::invalid_argument("power law: columns of different length");
    std::vector<double> x, y;
    for (std::size_t i = 0; i < r.size(); ++i)
        if (r[i] > 0 && p[i] > 0 && r[i] >= r_min && r[i] <= r_max) {
            x.push_back(std::log(r[i]));
            y.push_back(std::log(p[i]));
        }
    PowerLaw law;
    law.r_min = r_min;
    law.r_max = r_max;
    law.points = static_cast<int>(x.size());
    const auto n = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n, mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    if (!(xx > 0)) return law;
    const double slope = xy / xx;
    law.exponent = -slope;
    law.coefficient = std::exp(mean_y - slope * mean_x);
    if (x.size() < 3) return law;
    double residual = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double e = y[i] - mean_y - slope * (x[i] - mean_x);
        residual += e * e;
    }
    law.exponent_error = std::sqrt(residual / (n - 2) / xx);
    return law;
}

}  // namespace brisance::analysis
