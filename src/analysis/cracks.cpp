// SPDX-License-Identifier: Apache-2.0
#include "analysis/cracks.h"

#include "analysis/orientation.h"
#include "analysis/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace brisance::analysis {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int test_circles = 64;

/// Components of a mask: their pixels' area and range of r, without particles. Entry n - 1 belongs to label n.
std::vector<CrackComponent> measure(const DamageRaster& raster, const std::vector<std::int32_t>& labels, int n) {
    std::vector<CrackComponent> components(static_cast<std::size_t>(n));
    for (CrackComponent& c : components) c.r_min = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < labels.size(); ++p) {
        if (!labels[p]) continue;
        CrackComponent& c = components[static_cast<std::size_t>(labels[p] - 1)];
        const double r = raster.radius(p);
        c.area += raster.pixel * raster.pixel;
        c.r_min = std::min(c.r_min, r);
        c.r_max = std::max(c.r_max, r);
    }
    return components;
}

double mean_damaged_size(const SectionPoints& points, double threshold) {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (points.cracked(i, threshold)) {
            sum += points.size[i];
            n += 1;
        }
    return n > 0 ? sum / n : 0;
}

void check(const Specimen& s) {
    if (!(s.hole_radius >= 0 && 3 * s.hole_radius < 0.8 * s.outer_radius))
        throw std::invalid_argument("radial cracks: the specimen's outer radius must exceed 3.75 hole radii");
}

/// Length of the union of intervals of angle (from, to), rad, to - from < 2 pi, on the circle.
double covered_angle(std::vector<std::pair<double, double>> intervals) {
    std::vector<std::pair<double, double>> pieces;
    for (auto [from, to] : intervals) {
        const double shift = two_pi * std::floor(from / two_pi);
        from -= shift;
        to -= shift;
        pieces.emplace_back(from, std::min(to, two_pi));
        if (to > two_pi) pieces.emplace_back(0.0, to - two_pi);
    }
    std::sort(pieces.begin(), pieces.end());
    double covered = 0, end = 0;
    for (auto [from, to] : pieces) {
        covered += std::max(0.0, to - std::max(from, end));
        end = std::max(end, to);
    }
    return covered;
}

}  // namespace

std::vector<CrackComponent> crack_components(const SectionPoints& points, const DamageRaster& raster, double threshold) {
    std::vector<std::int32_t> labels;
    auto components = measure(raster, labels, label_components(raster, raster.damaged, labels));
    // A particle's own centre is always a set pixel: no other particle is nearer.
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.cracked(i, threshold)) continue;
        const auto ix = static_cast<std::size_t>(std::lround((points.x[i] - raster.x_0) / raster.pixel));
        const auto iy = static_cast<std::size_t>(std::lround((points.y[i] - raster.y_0) / raster.pixel));
        if (const auto label = labels[iy * raster.nx + ix]) ++components[static_cast<std::size_t>(label - 1)].particles;
    }
    std::stable_sort(components.begin(), components.end(), [](const auto& a, const auto& b) { return a.extent() > b.extent(); });
    return components;
}

int arcs_on_circle(const DamageRaster& raster, const Mask& mask, double radius, double gap) {
    if (raster.count() == 0 || !(radius > 0)) return 0;
    const auto samples = static_cast<std::size_t>(std::ceil(2 * two_pi * radius / raster.pixel));
    const double step = two_pi * radius / static_cast<double>(samples);
    std::vector<std::uint8_t> set(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        const double azimuth = two_pi * static_cast<double>(k) / static_cast<double>(samples);
        set[k] = raster.at(mask, radius * std::cos(azimuth), radius * std::sin(azimuth));
    }
    const auto first = std::find(set.begin(), set.end(), std::uint8_t{1});
    if (first == set.end()) return 0;
    // Once round from the first set sample: each run of unset samples that is longer than the gap ends an arc.
    const auto start = static_cast<std::size_t>(first - set.begin());
    int arcs = 0;
    std::size_t unset = 0;
    for (std::size_t k = 1; k <= samples; ++k) {
        if (!set[(start + k) % samples]) {
            ++unset;
            continue;
        }
        if (unset > 0 && static_cast<double>(unset) * step >= gap) ++arcs;
        unset = 0;
    }
    return arcs;
}

RadialCracks radial_cracks(const SectionPoints& points, const DamageRaster& raster, double threshold, const Specimen& specimen) {
    check(specimen);
    const double core = 3 * specimen.hole_radius, rim = 0.8 * specimen.outer_radius, quarter = specimen.outer_radius / 4;
    const double size = mean_damaged_size(points, threshold);
    RadialCracks result;

    Mask arms(raster.damaged);
    for (std::size_t p = 0; p < arms.size(); ++p)
        if (arms[p] && raster.radius(p) < core) arms[p] = 0;
    std::vector<std::int32_t> labels;
    const auto pieces = measure(raster, labels, label_components(raster, arms, labels));
    for (const CrackComponent& piece : pieces) result.long_components += piece.extent() >= quarter;
    for (std::size_t p = 0; p < arms.size(); ++p)
        if (arms[p] && pieces[static_cast<std::size_t>(labels[p] - 1)].extent() < 3 * size) arms[p] = 0;

    for (int k = 0; k < test_circles; ++k) {
        result.circles.push_back(core + (rim - core) * (k + 0.5) / test_circles);
        result.arms.push_back(arcs_on_circle(raster, arms, result.circles.back(), size));
    }
    result.median_arms = quantile(std::vector<double>(result.arms.begin(), result.arms.end()), 0.5);
    auto sorted = result.arms;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    const double enough = std::ceil(quarter / (rim - core) * test_circles);
    if (enough <= test_circles) result.sustained_arms = sorted[static_cast<std::size_t>(enough) - 1];

    for (const CrackComponent& c : crack_components(points, raster, threshold)) result.longest = std::max(result.longest, c.extent());
    return result;
}

double crushed_radius(const SectionPoints& points, double threshold, double share) {
    std::vector<std::size_t> order(points.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<double> radius;
    for (std::size_t i = 0; i < points.count(); ++i) radius.push_back(points.radius(i));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radius[a] < radius[b]; });
    double all = 0, damaged = 0, crushed = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t i = order[k];
        all += points.area(i);
        if (points.cracked(i, threshold)) damaged += points.area(i);
        const bool last_of_ring = k + 1 == order.size() || radius[order[k + 1]] > radius[i];
        if (last_of_ring && damaged > 0 && damaged >= share * all) crushed = radius[i];
    }
    return crushed;
}

Spall find_spall(const SectionPoints& points, double threshold, const Specimen& specimen) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    const double inner = 0.75 * specimen.outer_radius;
    const auto orientation = damage_orientation(points, threshold);
    std::vector<std::size_t> ring;
    double bin = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (points.cracked(i, threshold) && points.radius(i) >= inner && orientation[i].along <= 0) {
            ring.push_back(i);
            bin += points.size[i];
        }
    if (ring.empty()) return {nothing, nothing, 0};
    bin /= static_cast<double>(ring.size());

    std::vector<double> histogram;  // share of the circumference times width, per bin
    const auto bin_of = [&](std::size_t i) { return static_cast<std::size_t>((points.radius(i) - inner) / bin); };
    for (std::size_t i : ring) {
        if (bin_of(i) >= histogram.size()) histogram.resize(bin_of(i) + 1, 0.0);
        histogram[bin_of(i)] += points.area(i) / points.radius(i);
    }
    const auto peak = std::max_element(histogram.begin(), histogram.end());
    auto from = static_cast<std::size_t>(peak - histogram.begin()), to = from + 1;
    while (from > 0 && histogram[from - 1] >= *peak / 2) --from;
    while (to < histogram.size() && histogram[to] >= *peak / 2) ++to;

    double area = 0, moment = 0;
    std::vector<std::pair<double, double>> angles;
    for (std::size_t i : ring) {
        if (bin_of(i) < from || bin_of(i) >= to) continue;
        const double half = 0.75 * points.size[i] / points.radius(i);
        angles.emplace_back(points.azimuth(i) - half, points.azimuth(i) + half);
        area += points.area(i);
        moment += points.area(i) * points.radius(i);
    }
    return {moment / area, static_cast<double>(to - from) * bin, covered_angle(std::move(angles)) / two_pi};
}

}  // namespace brisance::analysis
