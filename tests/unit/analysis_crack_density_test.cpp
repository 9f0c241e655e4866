// SPDX-License-Identifier: Apache-2.0
// Calibration of the crack density on cracks of known length.
#include "analysis/crack_density.h"
#include "analysis/distance_map.h"
#include "analysis/synthetic_section.h"
#include "analysis/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace brisance;
using namespace brisance::analysis;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<CrackLine> lines_of(const SectionPoints& points) {
    const DamageRaster raster = rasterise(points);
    return crack_lines(points, raster, raster.damaged);
}

double crack_length(const SectionPoints& points) {
    double sum = 0;
    for (const CrackLine& line : lines_of(points)) sum += line.length();
    return sum;
}

SectionPoints straight(SectionPoints points, double length, double width, double degrees) {
    const double a = degrees * pi / 180, x = length / 2 * std::cos(a), y = length / 2 * std::sin(a), off_x = 0.13, off_y = 0.21;
    if (width > 1) synthetic::draw_line(points, off_x - x, off_y - y, off_x + x, off_y + y, width);
    else synthetic::draw_thin_line(points, off_x - x, off_y - y, off_x + x, off_y + y);
    return points;
}

/// Rows of particles that follow the line, with nothing around them.
SectionPoints rows(int length, int width, double degrees) {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    SectionPoints points;
    for (int i = 0; i < length; ++i)
        for (int k = 0; k < width; ++k) {
            const double u = i + 0.5 - length / 2.0, v = k + 0.5 - width / 2.0;
            synthetic::add_particle(points, u * c - v * s, u * s + v * c, 1);
        }
    synthetic::damage_where(points, [](std::size_t) { return true; });
    return points;
}

}  // namespace

TEST(CrackDensity, ZoneAreasAreExact) {
    const std::vector<double> edges{0, 24, 48, 72};
    const auto area = zone_areas(edges);
    EXPECT_DOUBLE_EQ(area[0], 576 * pi);
    EXPECT_DOUBLE_EQ(area[1], 1728 * pi);
    EXPECT_DOUBLE_EQ(area[2], 2880 * pi);
    EXPECT_EQ(zone_of(0, edges), 0);
    EXPECT_EQ(zone_of(23.999, edges), 0);
    EXPECT_EQ(zone_of(24, edges), 1);
    EXPECT_EQ(zone_of(72, edges), -1);
    EXPECT_EQ(zone_of(1, std::vector<double>{2, 3}), -1);
    EXPECT_THROW(zone_areas(std::vector<double>{0, 24, 24}), std::invalid_argument);
    EXPECT_THROW(zone_areas(std::vector<double>{-1, 24}), std::invalid_argument);
}

TEST(CrackDensity, AsPrintedIsLengthOverAreaForOneRowOfParticles) {
    // A row along x from 0 to 72 mm: 24 mm in each zone, whatever the spacing.
    const std::vector<double> edges{0, 24, 48, 72};
    for (double spacing : {0.15, 0.5, 1.0}) {
        SectionPoints points;
        for (int i = 0; (i + 0.5) * spacing < 72; ++i) synthetic::add_particle(points, (i + 0.5) * spacing, 0, spacing);
        synthetic::damage_where(points, [](std::size_t) { return true; });
        const auto gamma = density_as_printed(points, edges, 0.8);
        for (std::size_t z = 0; z < 3; ++z) EXPECT_NEAR(gamma[z], 24 / zone_areas(edges)[z], 1e-12);
        EXPECT_EQ(damaged_per_zone(points, edges, 0.8), std::vector<int>(3, static_cast<int>(std::lround(24 / spacing))));
        // D_i weighs; D = threshold and below does not count.
        std::fill(points.damage.begin(), points.damage.end(), 0.9);
        EXPECT_NEAR(density_as_printed(points, edges, 0.8)[0], 0.9 * 24 / zone_areas(edges)[0], 1e-12);
        std::fill(points.damage.begin(), points.damage.end(), 0.8);
        EXPECT_EQ(density_as_printed(points, edges, 0.8)[0], 0);
    }
}

TEST(CrackDensity, AStraightCrackHasItsLengthAtAnyAngleAndWidth) {
    constexpr double length = 40, tolerance = 0.07;
    for (int degrees = 0; degrees <= 90; degrees += 5)
        for (int width = 1; width <= 3; ++width) {
            SCOPED_TRACE(std::to_string(degrees) + " degrees, width " + std::to_string(width));
            const auto seed = static_cast<std::uint64_t>(degrees + 1);
            EXPECT_NEAR(crack_length(rows(40, width, degrees)) / length, 1, 0.03);
            EXPECT_NEAR(crack_length(straight(synthetic::lattice(0, 27, 1), length, width, degrees)) / length, 1, tolerance);
            EXPECT_NEAR(crack_length(straight(synthetic::lattice(0, 27, 1, 0.3, 0.25, seed), length, width, degrees)) / length, 1, tolerance);
        }
}

TEST(CrackDensity, TheLengthHasAUnit) {
    auto small = straight(synthetic::lattice(0, 27, 1, 0.3, 0.25), 40, 2, 33);
    const double length = crack_length(small);
    for (auto* column : {&small.x, &small.y, &small.size})
        for (double& v : *column) v *= 0.15;
    EXPECT_NEAR(crack_length(small), 0.15 * length, 0.15 * 0.2);
}

TEST(CrackDensity, CrossRingDiscAndSpeck) {
    for (double width : {1.0, 2.0, 3.0}) {
        SCOPED_TRACE(width);
        auto cross = synthetic::lattice(0, 30, 1, 0.2, 0.2);
        for (double a : {0.2, 1.8})
            if (width > 1) synthetic::draw_line(cross, -20 * std::cos(a), -20 * std::sin(a), 20 * std::cos(a), 20 * std::sin(a), width);
            else synthetic::draw_thin_line(cross, -20 * std::cos(a), -20 * std::sin(a), 20 * std::cos(a), 20 * std::sin(a));
        EXPECT_NEAR(crack_length(cross) / 80, 1, 0.07);

        auto ring = synthetic::lattice(0, 30, 1, 0.2, 0.2);
        synthetic::damage_where(ring, [&](std::size_t i) { return std::abs(ring.radius(i) - 20) < width / 2; });
        EXPECT_NEAR(crack_length(ring) / (40 * pi), 1, 0.05);

        const double radius = 5 * width;
        auto disc = synthetic::lattice(0, 30, 1, 0.2, 0.2);
        synthetic::damage_where(disc, [&](std::size_t i) { return disc.radius(i) < radius; });
        EXPECT_NEAR(crack_length(disc) / (2 * radius), 1, 0.15);  // its diameter
    }
    auto crushed = synthetic::lattice(5, 30, 1, 0.2, 0.2);
    synthetic::damage_where(crushed, [&](std::size_t i) { return crushed.radius(i) < 10; });
    EXPECT_NEAR(crack_length(crushed) / (15 * pi), 1, 0.07);  // a crushed zone around a hole: its mean circumference

    auto speck = synthetic::lattice(0, 10, 1, 0.2, 0.2);
    synthetic::draw_thin_line(speck, 0, 0, 1e-3, 0);
    EXPECT_NEAR(crack_length(speck), 1.2, 0.3);  // one particle: about its size
    EXPECT_EQ(crack_length(synthetic::lattice(0, 10, 1)), 0);
    EXPECT_EQ(crack_length(SectionPoints{}), 0);
}

TEST(CrackDensity, ACrackThroughAGradedCloudHasNoGaps) {
    auto points = synthetic::graded_rings(3.2, 72, 0.15, 0.85);
    synthetic::draw_thin_line(points, 3.2, 0, 60, 20);
    const auto lines = lines_of(points);
    EXPECT_EQ(lines.size(), 1u);
    EXPECT_NEAR(crack_length(points) / std::hypot(56.8, 20), 1, 0.05);
}

TEST(CrackDensity, CellsThatMeetInACornerAreOneCrack) {
    for (double angle : {0.0, pi / 4, 0.1}) {
        auto points = synthetic::lattice(0, 15, 1, angle);
        for (std::size_t i = 0; i < points.count(); ++i) {
            const double u = points.x[i] * std::cos(angle) + points.y[i] * std::sin(angle);
            const double v = -points.x[i] * std::sin(angle) + points.y[i] * std::cos(angle);
            if (std::abs(u - v) < 0.1 && std::abs(u) < 8.1) synthetic::damage_one(points, i);
        }
        const auto lines = lines_of(points);
        EXPECT_EQ(lines.size(), 1u);
        EXPECT_NEAR(crack_length(points) / (17 * std::sqrt(2.0)), 1, 0.05);  // 17 diamonds tip to tip
    }
}

TEST(CrackDensity, RoughnessIsNotCracks) {
    auto points = synthetic::lattice(0, 27, 1, 0.3, 0.2);
    synthetic::draw_line(points, -20, 0, 20, 0, 2);
    const double bare = crack_length(points);
    for (double x = -16; x < 20; x += 8) synthetic::draw_thin_line(points, x, 0, x, 1.3);  // one particle that sticks out
    EXPECT_NEAR(crack_length(points) / bare, 1, 0.03);
    synthetic::draw_line(points, 0, 0, 0, 15, 2);  // a branch
    EXPECT_NEAR(crack_length(points), bare + 15, 2);
}

TEST(CrackDensity, SingleIntactParticlesMakeNoLoops) {
    auto points = synthetic::lattice(5, 30, 1, 0.2, 0.2);
    synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 10 && i % 13 != 0; });
    EXPECT_NEAR(crack_length(points) / (15 * pi), 1, 0.15);
}

TEST(CrackDensity, LinesAreSharedOutToZones) {
    const std::vector<double> edges{0, 24, 48, 72};
    for (double width : {2.0, 3.0}) {
        auto points = synthetic::lattice(0, 72, 1, 0.3, 0.2);
        synthetic::draw_line(points, 2, 1, 70, 5, width);
        const auto gamma = density_of_lines(lines_of(points), edges);
        const auto area = zone_areas(edges);
        EXPECT_NEAR(gamma[0] * area[0], 22, 1.5);
        EXPECT_NEAR(gamma[1] * area[1], 24, 1.0);
        EXPECT_NEAR(gamma[2] * area[2], 22, 1.5);
        // Eq. 12 counts the same crack `width` times.
        EXPECT_NEAR(density_as_printed(points, edges, 0.8)[1] * area[1], 24 * width, 3 * width);
    }
}

TEST(Thinning, KeepsConnectionsAndLeavesLinesOnePixelWide) {
    auto points = synthetic::lattice(0, 30, 1, 0.2, 0.25);
    std::uint64_t state = 9;
    synthetic::damage_where(points, [&](std::size_t) { return synthetic::noise(state) > 0.1; });
    const DamageRaster raster = rasterise(points, {.smallest_hole = 0});
    const Mask skeleton = thin(raster, raster.damaged, distance_to_unset(raster, raster.damaged));
    std::vector<std::int32_t> labels;
    EXPECT_EQ(label_components(raster, skeleton, labels), label_components(raster, raster.damaged, labels));
    // Holes: 4-connected components of the background, by flood fill here.
    const auto holes = [&](const Mask& mask) {
        Mask seen(mask);
        int n = 0;
        for (std::size_t start = 0; start < mask.size(); ++start) {
            if (seen[start]) continue;
            ++n;
            std::vector<std::size_t> stack{start};
            seen[start] = 1;
            while (!stack.empty()) {
                const std::size_t p = stack.back(), x = p % raster.nx, y = p / raster.nx;
                stack.pop_back();
                const auto visit = [&](std::size_t q) {
                    if (!seen[q]) seen[q] = 1, stack.push_back(q);
                };
                if (x > 0) visit(p - 1);
                if (x + 1 < raster.nx) visit(p + 1);
                if (y > 0) visit(p - raster.nx);
                if (y + 1 < raster.ny) visit(p + raster.nx);
            }
        }
        return n;
    };
    EXPECT_GT(holes(raster.damaged), 10);
    EXPECT_EQ(holes(skeleton), holes(raster.damaged));
    for (std::size_t p = 0; p < skeleton.size(); ++p) {
        if (!skeleton[p]) continue;
        EXPECT_TRUE(raster.damaged[p]);
        EXPECT_FALSE(skeleton[p + 1] && skeleton[p + raster.nx] && skeleton[p + raster.nx + 1]);  // no full square of four
    }
}

TEST(DamageRaster, EachPixelBelongsToItsNearestParticle) {
    auto points = synthetic::graded_rings(2, 12, 0.4, 1.2);
    std::uint64_t state = 3;
    synthetic::damage_where(points, [&](std::size_t) { return synthetic::noise(state) > 0; });
    const DamageRaster raster = rasterise(points, {.bridge = 0, .smallest_hole = 0});
    for (std::size_t p = 0; p < raster.count(); ++p) {
        double nearest = 1e9;
        std::size_t who = 0;
        for (std::size_t i = 0; i < points.count(); ++i)
            if (const double d = std::hypot(points.x[i] - raster.x(p), points.y[i] - raster.y(p)); d < nearest) nearest = d, who = i;
        const bool expected = points.cracked(who, 0.8) && nearest <= 0.75 * points.size[who];
        EXPECT_EQ(raster.damaged[p] != 0, expected);
        EXPECT_EQ(raster.owner[p], expected ? static_cast<std::int32_t>(who) : -1);
    }
    points.cause.pop_back();
    EXPECT_THROW(rasterise(points), std::invalid_argument);
}

TEST(DistanceMap, IsThatOfBruteForce) {
    DamageRaster raster;
    raster.nx = 37;
    raster.ny = 23;
    Mask mask(raster.count());
    for (double share : {0.5, 0.95, 0.995}) {
        std::uint64_t state = 8;
        for (auto& m : mask) m = synthetic::noise(state) < 2 * share - 1;
        const auto d = distance_to_unset(raster, mask);
        for (std::size_t p = 0; p < mask.size(); ++p) {
            double nearest = 1e9;
            for (std::size_t q = 0; q < mask.size(); ++q)
                if (!mask[q]) nearest = std::min(nearest, std::hypot(double(p % 37) - double(q % 37), double(p / 37) - double(q / 37)));
            EXPECT_NEAR(d[p], nearest, 1e-5);
        }
    }
    std::fill(mask.begin(), mask.end(), 1);
    EXPECT_TRUE(std::isinf(distance_to_unset(raster, mask)[5]));
}

TEST(CrackDensity, ACrushedZoneGrowsNoCracks) {
    // Sixty particles thick, with a rough edge: still its mean circumference, and eight cracks from there.
    auto points = synthetic::lattice(3.225, 30, 0.15, 0.2, 0.25);
    synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 12 + 0.08 * std::sin(40 * points.azimuth(i)); });
    EXPECT_NEAR(crack_length(points) / (2 * pi * 7.6), 1, 0.07);
    for (double width : {0.3, 1.2}) {
        for (int k = 0; k < 8; ++k) {
            const double a = 0.1 + k * pi / 4;
            synthetic::draw_line(points, 10 * std::cos(a), 10 * std::sin(a), 25 * std::cos(a), 25 * std::sin(a), width);
        }
        EXPECT_NEAR(crack_length(points) / (2 * pi * 7.6 + 8 * (25 - 7.6)), 1, 0.07);
    }
}
