// SPDX-License-Identifier: Apache-2.0
#include "analysis/cracks.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace brisance::analysis;

namespace {
constexpr double pi = std::numbers::pi;
constexpr Specimen specimen{3.225, 72};

SectionPoints intact() { return synthetic::lattice(3.225, 72, 0.6, 0.2, 0.2); }

void draw_arm(SectionPoints& points, double azimuth, double from, double to, double width = 1.2) {
    const double c = std::cos(azimuth), s = std::sin(azimuth);
    synthetic::draw_line(points, from * c, from * s, to * c, to * s, width);
}

RadialCracks count(const SectionPoints& points) { return radial_cracks(points, rasterise(points), 0.8, specimen); }
}  // namespace

TEST(Cracks, ArmsAreCountedByTheCirclesTheyCross) {
    for (int n : {1, 4, 7, 13}) {
        auto points = intact();
        for (int k = 0; k < n; ++k) draw_arm(points, 0.3 + 2 * pi * k / n, 3, 60);
        const auto cracks = count(points);
        EXPECT_EQ(cracks.sustained_arms, n);
        EXPECT_EQ(cracks.median_arms, n);
        EXPECT_EQ(cracks.long_components, n);
        EXPECT_NEAR(cracks.longest, 60 - 3.225, 1);
    }
    const auto none = count(intact());
    EXPECT_EQ(none.sustained_arms, 0);
    EXPECT_EQ(none.longest, 0);
    EXPECT_THROW(radial_cracks(intact(), DamageRaster{}, 0.8, {20, 72}), std::invalid_argument);
}

TEST(Cracks, CountsAtEachRadiusFollowTheArms) {
    auto points = intact();
    const double ends[5] = {20, 28, 36, 44, 52};
    for (int k = 0; k < 5; ++k) draw_arm(points, 0.3 + 2 * pi * k / 5, 3, ends[k]);
    const auto cracks = count(points);
    for (std::size_t c = 0; c < cracks.circles.size(); ++c) {
        int expected = 0;
        bool near_an_end = false;
        for (double end : ends) {
            expected += end > cracks.circles[c];
            near_an_end = near_an_end || std::abs(end - cracks.circles[c]) < 1.0;
        }
        if (near_an_end) continue;
        EXPECT_EQ(cracks.arms[c], expected) << cracks.circles[c];
    }
    EXPECT_EQ(cracks.long_components, 4);  // the shortest has 10 of the 18 mm asked for
    EXPECT_EQ(cracks.sustained_arms, 4);
}

TEST(Cracks, ARingThatJoinsTheArmsChangesNoCountOfArms) {
    auto points = intact();
    for (int k = 0; k < 6; ++k) draw_arm(points, 0.3 + 2 * pi * k / 6, 3, 60);
    synthetic::damage_where(points, [&](std::size_t i) { return std::abs(points.radius(i) - 40) < 0.7; });
    std::uint64_t state = 2;
    synthetic::damage_where(points, [&](std::size_t) { return synthetic::noise(state) > 0.992; });  // specks
    const auto cracks = count(points);
    EXPECT_EQ(cracks.sustained_arms, 6);
    EXPECT_EQ(cracks.median_arms, 6);
    EXPECT_EQ(cracks.long_components, 1);
}

TEST(Cracks, ArcsOnACircle) {
    auto points = synthetic::lattice(0, 30, 0.5);
    synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 25; });
    auto raster = rasterise(points);
    EXPECT_EQ(arcs_on_circle(raster, raster.damaged, 10, 0.5), 0);  // a ring
    EXPECT_EQ(arcs_on_circle(raster, raster.damaged, 29, 0.5), 0);  // nothing
    points = synthetic::lattice(0, 30, 0.5);
    synthetic::damage_where(points, [&](std::size_t i) { return points.x[i] > 0 && std::abs(points.y[i]) > 0.6; });
    raster = rasterise(points);
    EXPECT_EQ(arcs_on_circle(raster, raster.damaged, 20, 0.5), 2);
    EXPECT_EQ(arcs_on_circle(raster, raster.damaged, 20, 3), 1);  // the cut between them is narrower than that
}

TEST(Cracks, ComponentsAndTheirExtent) {
    auto points = intact();
    draw_arm(points, 0.5, 10, 50);
    const auto arm = [&] {
        int n = 0;
        for (double d : points.damage) n += d > 0.8;
        return n;
    }();
    synthetic::draw_line(points, -30, -5, -30, 5, 1.2);
    const auto components = crack_components(points, rasterise(points), 0.8);
    ASSERT_EQ(components.size(), 2u);
    EXPECT_NEAR(components[0].r_min, 10, 0.7);
    EXPECT_NEAR(components[0].r_max, 50, 0.7);
    EXPECT_EQ(components[0].particles, arm);
    EXPECT_NEAR(components[0].area / (arm * 0.36), 1, 0.15);
    EXPECT_NEAR(components[1].extent(), std::hypot(30.6, 5) - 29.4, 1);
}

TEST(Cracks, CrushedRadiusHasItsClosedForm) {
    for (double hole : {0.0, 3.225}) {
        auto points = synthetic::lattice(hole, 72, 0.4, 0.2, 0.2);
        synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 10; });
        EXPECT_NEAR(crushed_radius(points, 0.8), std::sqrt(hole * hole + (100 - hole * hole) / 0.8), 0.15);
        EXPECT_NEAR(crushed_radius(points, 0.8, 1.0), 10, 0.4);
    }
    // Area counts, not the number of particles: a graded cloud gives the same.
    auto graded = synthetic::graded_rings(3.225, 72, 0.15, 0.85);
    synthetic::damage_where(graded, [&](std::size_t i) { return graded.radius(i) < 10; });
    EXPECT_NEAR(crushed_radius(graded, 0.8), std::sqrt(3.225 * 3.225 + (100 - 3.225 * 3.225) / 0.8), 0.3);
    EXPECT_EQ(crushed_radius(intact(), 0.8), 0);
    EXPECT_EQ(crushed_radius(SectionPoints{}, 0.8), 0);
}

TEST(Cracks, SpallBandAmongRadialCracks) {
    auto points = intact();
    for (int k = 0; k < 5; ++k) draw_arm(points, 0.1 + 2 * pi * k / 5, 3, 72);  // arms that reach the rim
    synthetic::damage_where(points, [&](std::size_t i) {
        return std::abs(points.radius(i) - 66) < 0.9 && points.azimuth(i) > -1 && points.azimuth(i) < 2;
    });
    const Spall spall = find_spall(points, 0.8, specimen);
    EXPECT_NEAR(spall.radius, 66, 0.2);
    EXPECT_NEAR(spall.width, 1.8, 0.7);
    EXPECT_NEAR(spall.coverage, 3 / (2 * pi), 0.03);

    auto full = intact();
    synthetic::damage_where(full, [&](std::size_t i) { return std::abs(full.radius(i) - 60) < 0.6; });
    EXPECT_NEAR(find_spall(full, 0.8, specimen).coverage, 1, 0.01);

    auto arms = intact();
    for (int k = 0; k < 5; ++k) draw_arm(arms, 0.1 + 2 * pi * k / 5, 3, 72);
    EXPECT_LT(find_spall(arms, 0.8, specimen).coverage, 0.05);

    const Spall none = find_spall(intact(), 0.8, specimen);
    EXPECT_TRUE(std::isnan(none.radius) && std::isnan(none.width));
    EXPECT_EQ(none.coverage, 0);
}
