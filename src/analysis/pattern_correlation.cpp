// SPDX-License-Identifier: Apache-2.0
#include "analysis/pattern_correlation.h"

#include "analysis/statistics.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace brisance::analysis {

namespace {
std::vector<double> averaged_round(const std::vector<double>& values, int reach) {
    const auto n = static_cast<int>(values.size());
    std::vector<double> result;
    for (int k = 0; k < n; ++k) {
        double sum = 0;
        for (int d = -reach; d <= reach; ++d) sum += values[static_cast<std::size_t>(((k + d) % n + n) % n)];
        result.push_back(sum / (2 * reach + 1));
    }
    return result;
}

void check(const PatternOptions& o) {
    if (o.sectors < 1 || o.rings < 1 || o.smoothing < 0 || !(o.r_max > o.r_min) || o.r_min < 0)
        throw std::invalid_argument("pattern: sectors and rings >= 1, smoothing >= 0, 0 <= r_min < r_max");
}
}  // namespace

std::vector<double> angular_histogram(const SectionPoints& points, const PatternOptions& options) {
    check(options);
    std::vector<double> area(static_cast<std::size_t>(options.sectors), 0.0);
    for (std::size_t i = 0; i < points.count(); ++i) {
        const double r = points.radius(i);
        if (points.cracked(i, options.threshold) && r > options.r_min && r < options.r_max)
            area[static_cast<std::size_t>(sector_of(points.azimuth(i), options.sectors))] += points.area(i);
    }
    return averaged_round(area, options.smoothing);
}

PolarHistogram polar_histogram(const SectionPoints& points, const PatternOptions& options) {
    check(options);
    PolarHistogram histogram{static_cast<std::size_t>(options.rings), static_cast<std::size_t>(options.sectors), {}};
    const double width = (options.r_max - options.r_min) / options.rings;
    for (int k = 0; k < options.rings; ++k) {
        PatternOptions ring = options;
        ring.r_min = options.r_min + k * width;
        ring.r_max = ring.r_min + width;
        const double cell = std::numbers::pi * (ring.r_max + ring.r_min) * width / options.sectors;
        for (double area : angular_histogram(points, ring)) histogram.values.push_back(area / cell);
    }
    return histogram;
}

std::vector<double> rotated(const std::vector<double>& values, double angle) {
    const auto n = static_cast<double>(values.size());
    std::vector<double> result;
    for (std::size_t k = 0; k < values.size(); ++k) {
        double from = std::fmod(static_cast<double>(k) - angle / (2 * std::numbers::pi) * n, n);
        if (from < 0) from += n;
        const double whole = std::floor(from), part = from - whole;
        const std::size_t below = static_cast<std::size_t>(whole) % values.size(), above = (below + 1) % values.size();
        result.push_back((1 - part) * values[below] + part * values[above]);
    }
    return result;
}

double pattern_correlation(const std::vector<double>& a, const std::vector<double>& b, double angle) {
    return pearson(a, rotated(b, angle));
}

double pattern_correlation(const PolarHistogram& a, const PolarHistogram& b, double angle) {
    if (a.rings != b.rings || a.sectors != b.sectors) throw std::invalid_argument("pattern: histograms of different shape");
    std::vector<double> turned;
    for (std::size_t k = 0; k < b.rings; ++k) {
        const auto from = b.values.begin() + static_cast<std::ptrdiff_t>(k * b.sectors);
        const auto ring = rotated(std::vector<double>(from, from + static_cast<std::ptrdiff_t>(b.sectors)), angle);
        turned.insert(turned.end(), ring.begin(), ring.end());
    }
    return pearson(a.values, turned);
}

}  // namespace brisance::analysis
