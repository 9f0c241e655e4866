// SPDX-License-Identifier: Apache-2.0
#include "analysis/pattern_correlation.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

using namespace brisance::analysis;

namespace {
constexpr double pi = std::numbers::pi;

/// Six arms in directions that a seed chooses, on a lattice turned by `lattice_angle`, the whole pattern turned by `turn`.
SectionPoints pattern(std::uint64_t seed, double lattice_angle, double turn) {
    auto points = synthetic::lattice(3.225, 72, 0.6, lattice_angle);
    for (int k = 0; k < 6; ++k) {
        const double a = pi * synthetic::noise(seed) + turn, end = 35 + 15 * synthetic::noise(seed);
        synthetic::draw_line(points, 3 * std::cos(a), 3 * std::sin(a), end * std::cos(a), end * std::sin(a), 1.2);
    }
    return points;
}
}  // namespace

TEST(PatternCorrelation, HistogramHoldsTheDamagedAreaOfTheRange) {
    const auto points = pattern(1, 0, 0);
    double area = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (points.damage[i] > 0.8 && points.radius(i) > 14 && points.radius(i) < 42) area += 0.36;
    const auto histogram = angular_histogram(points);
    EXPECT_EQ(histogram.size(), 180u);
    EXPECT_NEAR(std::accumulate(histogram.begin(), histogram.end(), 0.0), area, 1e-9);
    EXPECT_THROW(angular_histogram(points, {.r_min = 5, .r_max = 5}), std::invalid_argument);
}

TEST(PatternCorrelation, SmoothingSpreadsOneParticleOverSevenSectors) {
    SectionPoints points;
    synthetic::add_particle(points, 20 * std::cos(0.001), 20 * std::sin(0.001), 0.7);
    points.damage[0] = 1;
    const auto histogram = angular_histogram(points);
    for (std::size_t k = 0; k < 180; ++k) EXPECT_NEAR(histogram[k], k <= 3 || k >= 177 ? 0.07 : 0, 1e-15);
}

TEST(PatternCorrelation, TurningBackAPatternRestoresIt) {
    const auto a = angular_histogram(pattern(1, 0.1, 0));
    for (double turn : {22.5 * pi / 180, 0.7, -2.0}) {
        const auto b = angular_histogram(pattern(1, 0.1 + turn, turn));  // pattern and lattice turned: the same body
        EXPECT_GT(pattern_correlation(a, b, -turn), 0.97);
        EXPECT_LT(pattern_correlation(a, b), 0.6);
    }
    EXPECT_NEAR(pattern_correlation(a, a), 1, 1e-12);
    EXPECT_NEAR(pattern_correlation(a, a, 2 * pi), 1, 1e-12);
}

TEST(PatternCorrelation, LabFrameAgainstLatticeFrame) {
    // Cracks fixed in the lab, lattice turned by 22.5 degrees: rho_lab is high, rho_lat low, and the reverse where they follow the lattice.
    const double turn = 22.5 * pi / 180;
    double lab = 0, lattice = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto a = angular_histogram(pattern(seed, 0, 0)), b = angular_histogram(pattern(seed, turn, 0));
        lab += pattern_correlation(a, b) / 4;
        lattice += pattern_correlation(a, b, -turn) / 4;
        const auto p = polar_histogram(pattern(seed, 0, 0)), q = polar_histogram(pattern(seed, turn, 0));
        EXPECT_GT(pattern_correlation(p, q), 0.8);
        EXPECT_LT(pattern_correlation(p, q, -turn), 0.5);
    }
    EXPECT_GT(lab, 0.9);
    EXPECT_LT(lattice, 0.3);
}

TEST(PatternCorrelation, RotationMovesSectorsAndInterpolates) {
    const std::vector<double> v{0, 1, 4, 9};
    const double quarter = pi / 2;
    const auto moved = rotated(v, quarter), back = rotated(v, -quarter), half = rotated(v, quarter / 2);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(moved[k], v[(k + 3) % 4], 1e-12);
        EXPECT_NEAR(back[k], v[(k + 1) % 4], 1e-12);
        EXPECT_NEAR(half[k], (v[k] + v[(k + 3) % 4]) / 2, 1e-12);
    }
}

TEST(PatternCorrelation, PolarCellsTellTheBrokenShareAndThePlace) {
    auto all = synthetic::lattice(0, 72, 0.25);
    synthetic::damage_where(all, [](std::size_t) { return true; });
    for (double v : polar_histogram(all, {.sectors = 36}).values) EXPECT_NEAR(v, 1, 0.15);
    // Two arms on the same azimuth, at different radii: the angular histogram sees one pattern, the polar one two.
    auto inner = synthetic::lattice(3, 72, 0.6), outer = inner;
    synthetic::draw_line(inner, 15, 0.1, 25, 0.1, 1.2);
    synthetic::draw_line(outer, 30, 0.1, 40, 0.1, 1.2);
    EXPECT_GT(pattern_correlation(angular_histogram(inner), angular_histogram(outer)), 0.8);
    EXPECT_LT(pattern_correlation(polar_histogram(inner), polar_histogram(outer)), 0.1);
    EXPECT_THROW(pattern_correlation(polar_histogram(inner, {.rings = 4}), polar_histogram(outer)), std::invalid_argument);
}
