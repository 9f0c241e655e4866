// SPDX-License-Identifier: Apache-2.0
#include "analysis/crack_directions.h"
#include "analysis/statistics.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

using namespace brisance::analysis;

namespace {
constexpr double pi = std::numbers::pi;

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

/// Arms of single particles from r = 5 to 60 mm, one per millimetre, at the azimuths given.
SectionPoints arms(const std::vector<double>& azimuths) {
    SectionPoints points;
    for (double a : azimuths)
        for (int r = 5; r < 60; ++r) synthetic::add_particle(points, r * std::cos(a), r * std::sin(a), 1);
    synthetic::damage_where(points, [](std::size_t) { return true; });
    return points;
}
}  // namespace

TEST(CrackDirections, TheBinsOfEq13AverageToOne) {
    auto points = synthetic::lattice(3, 40, 0.7, 0.1, 0.2);
    std::uint64_t state = 4;
    for (double& d : points.damage) d = 0.5 + 0.5 * synthetic::noise(state);
    const auto pdf = direction_pdf(points, 0.8);
    EXPECT_EQ(pdf.size(), 72u);
    EXPECT_NEAR(sum(pdf) / 72, 1, 1e-13);

    double all = 0, sector = 0;  // the fourth sector, 15 to 20 degrees, by hand
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (points.damage[i] <= 0.8) continue;
        all += points.damage[i];
        const double degrees = std::atan2(points.y[i], points.x[i]) * 180 / pi;
        if (degrees >= 15 && degrees < 20) sector += points.damage[i];
    }
    EXPECT_NEAR(pdf[3], sector / all / (5.0 / 360), 1e-12);
    EXPECT_EQ(sum(direction_pdf(synthetic::lattice(3, 10, 1), 0.8)), 0);
    EXPECT_THROW(direction_pdf(points, 0.8, 0), std::invalid_argument);
}

TEST(CrackDirections, TheNormalisedFormIsTheBrokenShareOfTheSector) {
    // The rings that the paper's three numbers ask for, in a section from 3.225 to 72 mm, finely graded at the hole.
    const double quoted[3] = {0.000942, 0.001682, 0.003558}, ring[3] = {0.683, 1.146, 2.142};
    for (int k = 0; k < 3; ++k) {
        auto points = synthetic::graded_rings(3.225, 72, 0.05, 2.5);
        synthetic::damage_where(points, [&](std::size_t i) { return points.radius(i) < 3.225 + ring[k]; });
        const auto p = direction_pdf_normalised(points, 0.8);
        EXPECT_NEAR(sum(p) / 72 / quoted[k], 1, 0.06);  // to within a ring of particles
        for (double v : p) EXPECT_NEAR(v / quoted[k], 1, 0.4);
    }
    auto half = synthetic::lattice(0, 50, 0.5);
    synthetic::damage_where(half, [&](std::size_t i) { return half.y[i] > 0; });
    const auto p = direction_pdf_normalised(half, 0.8, 4);
    EXPECT_NEAR(p[0], 1, 0.02);
    EXPECT_NEAR(p[3], 0, 1e-12);
}

TEST(CrackDirections, SectorsBeginAtXAndRunAnticlockwise) {
    EXPECT_EQ(sector_of(0, 72), 0);
    EXPECT_EQ(sector_of(4.9 * pi / 180, 72), 0);
    EXPECT_EQ(sector_of(5.1 * pi / 180, 72), 1);
    EXPECT_EQ(sector_of(-0.1 * pi / 180, 72), 71);
    EXPECT_EQ(sector_of(-1e-18, 72), 0);
    EXPECT_EQ(sector_of(pi, 72), 36);
    EXPECT_EQ(sector_of(3 * pi, 72), 36);
}

TEST(CrackDirections, HarmonicsOfRegularArms) {
    const auto eight = direction_harmonics(arms({0.1, 0.1 + pi / 4, 0.1 + pi / 2, 0.1 + 3 * pi / 4, 0.1 + pi, 0.1 - pi / 4, 0.1 - pi / 2, 0.1 - 3 * pi / 4}), 0.8);
    ASSERT_EQ(eight.size(), 12u);
    for (std::size_t m = 1; m <= 12; ++m) EXPECT_NEAR(eight[m - 1], m == 8 ? 1 : 0, 1e-12);
    const auto four = direction_harmonics(arms({0.3, 0.3 + pi / 2, 0.3 + pi, 0.3 - pi / 2}), 0.8);
    for (std::size_t m = 1; m <= 12; ++m) EXPECT_NEAR(four[m - 1], m % 4 == 0 ? 1 : 0, 1e-12);
    // Two arms at +-a: |cos m a|.
    const auto two = direction_harmonics(arms({0.4, -0.4}), 0.8);
    for (std::size_t m = 1; m <= 12; ++m) EXPECT_NEAR(two[m - 1], std::abs(std::cos(0.4 * static_cast<double>(m))), 1e-12);
    for (double a : direction_harmonics(SectionPoints{}, 0.8)) EXPECT_EQ(a, 0);
}

TEST(CrackDirections, IsotropyIsAcceptedAtItsRateAndForRings) {
    // Independent particles in random directions: the p values are uniform.
    int below_tenth = 0, trials = 200;
    double mean = 0;
    std::uint64_t state = 12;
    for (int t = 0; t < trials; ++t) {
        SectionPoints points;
        for (int i = 0; i < 600; ++i) {
            const double a = pi * synthetic::noise(state), r = 20 + 10 * synthetic::noise(state);
            synthetic::add_particle(points, r * std::cos(a), r * std::sin(a), 0.05);
        }
        synthetic::damage_where(points, [](std::size_t) { return true; });
        const auto test = isotropy_test(points, 0.8, 36);
        EXPECT_LT(test.clump, 1.1);
        mean += test.p_value / trials;
        below_tenth += test.p_value < 0.1;
    }
    EXPECT_NEAR(mean, 0.5, 0.08);
    EXPECT_NEAR(below_tenth, 20, 14);

    auto ring = synthetic::lattice(3, 40, 0.5, 0.1);
    synthetic::damage_where(ring, [&](std::size_t i) { return ring.radius(i) < 12; });
    EXPECT_GT(isotropy_test(ring, 0.8).p_value, 0.99);
    EXPECT_EQ(isotropy_test(synthetic::lattice(3, 10, 1), 0.8).p_value, 1);
}

TEST(CrackDirections, ACrackCountsOnceWhateverItsNumberOfParticles) {
    // Forty straight cracks in random directions: isotropic, though plain chi-square is beyond all bounds.
    std::uint64_t state = 7;
    double mean = 0;
    const int trials = 40;
    for (int t = 0; t < trials; ++t) {
        std::vector<double> azimuths;
        for (int k = 0; k < 40; ++k) azimuths.push_back(pi * synthetic::noise(state));
        const auto points = arms(azimuths);
        const auto test = isotropy_test(points, 0.8, 12, 40);
        EXPECT_LT(chi_square_survival(test.chi_square, 11), 1e-6);
        mean += test.p_value / trials;
    }
    EXPECT_GT(mean, 0.35);

    std::vector<double> fan;  // all in one half
    for (int k = 0; k < 40; ++k) fan.push_back(0.5 * pi + 0.5 * pi * synthetic::noise(state));
    EXPECT_LT(isotropy_test(arms(fan), 0.8, 12, 40).p_value, 0.05);
}

TEST(CrackDirections, CoherenceTellsRadialFromRing) {
    auto radial = synthetic::lattice(3, 60, 0.7, 0.2, 0.2);
    for (double a : {0.1, 1.5, 2.6, 4.0, 5.2})
        synthetic::draw_line(radial, 5 * std::cos(a), 5 * std::sin(a), 55 * std::cos(a), 55 * std::sin(a), 1.4);
    EXPECT_GT(radial_coherence(radial, 0.8), 0.75);

    auto ring = synthetic::lattice(3, 60, 0.7, 0.2, 0.2);
    synthetic::damage_where(ring, [&](std::size_t i) { return std::abs(ring.radius(i) - 50) < 0.7; });
    EXPECT_LT(radial_coherence(ring, 0.8), -0.75);

    auto disc = synthetic::lattice(0, 60, 0.7, 0.2, 0.2);
    synthetic::damage_where(disc, [&](std::size_t i) { return disc.radius(i) < 40; });
    EXPECT_NEAR(radial_coherence(disc, 0.8), 0, 0.1);
    EXPECT_NEAR(radial_coherence(arms({0.7}), 0.8), 1, 1e-9);  // one line of particles: exactly radial
    EXPECT_EQ(radial_coherence(SectionPoints{}, 0.8), 0);
}
