// SPDX-License-Identifier: Apache-2.0
#include "analysis/crack_density.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace brisance::analysis {

namespace {
/// Adds contributions by radius, then divides by the zones' areas.
class ZoneSum {
public:
    explicit ZoneSum(std::span<const double> edges) : edges_(edges), area_(zone_areas(edges)), sum_(area_.size(), 0.0) {}
    void add(double radius, double length) {
        if (const int zone = zone_of(radius, edges_); zone >= 0) sum_[static_cast<std::size_t>(zone)] += length;
    }
    std::vector<double> over_area() {
        for (std::size_t z = 0; z < sum_.size(); ++z) sum_[z] /= area_[z];
        return sum_;
    }

private:
    std::span<const double> edges_;
    std::vector<double> area_, sum_;
};
}  // namespace

std::vector<double> zone_areas(std::span<const double> edges) {
    if (edges.size() < 2 || edges[0] < 0) throw std::invalid_argument("zones: two or more radii, from 0 up");
    std::vector<double> area;
    for (std::size_t z = 0; z + 1 < edges.size(); ++z) {
        if (!(edges[z + 1] > edges[z])) throw std::invalid_argument("zones: radii must ascend");
        area.push_back(std::numbers::pi * (edges[z + 1] - edges[z]) * (edges[z + 1] + edges[z]));
    }
    return area;
}

int zone_of(double radius, std::span<const double> edges) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), radius);
    return above == edges.end() ? -1 : static_cast<int>(above - edges.begin()) - 1;
}

std::vector<int> damaged_per_zone(const SectionPoints& points, std::span<const double> edges, double threshold) {
    std::vector<int> damaged(zone_areas(edges).size(), 0);
    for (std::size_t i = 0; i < points.count(); ++i)
        if (const int zone = zone_of(points.radius(i), edges); zone >= 0 && points.cracked(i, threshold))
            ++damaged[static_cast<std::size_t>(zone)];
    return damaged;
}

std::vector<double> density_as_printed(const SectionPoints& points, std::span<const double> edges, double threshold) {
    ZoneSum sum(edges);
    for (std::size_t i = 0; i < points.count(); ++i)
        if (points.cracked(i, threshold)) sum.add(points.radius(i), points.damage[i] * points.size[i]);  // (Eq. 12)
    return sum.over_area();
}

std::vector<double> density_of_lines(std::span<const CrackLine> lines, std::span<const double> edges) {
    ZoneSum sum(edges);
    for (const CrackLine& line : lines) {
        sum.add(norm(line.points.front()), line.tip_first);
        sum.add(norm(line.points.back()), line.tip_last);
        for (std::size_t i = 1; i < line.points.size(); ++i)
            sum.add(norm(0.5 * (line.points[i] + line.points[i - 1])), norm(line.points[i] - line.points[i - 1]));
    }
    return sum.over_area();
}

}  // namespace brisance::analysis
