// SPDX-License-Identifier: Apache-2.0
#include "analysis/attenuation.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace brisance::analysis;

TEST(Attenuation, AnExactPowerLawIsRecovered) {
    std::vector<double> r, p;
    for (double x = 3; x < 70; x *= 1.2) {
        r.push_back(x);
        p.push_back(40 * std::pow(x, -1.7));
    }
    const auto law = fit_power_law(r, p, 0, 100);
    EXPECT_NEAR(law.exponent, 1.7, 1e-12);
    EXPECT_NEAR(law.coefficient, 40, 1e-9);
    EXPECT_NEAR(law.exponent_error, 0, 1e-7);
    EXPECT_EQ(law.points, static_cast<int>(r.size()));
}

TEST(Attenuation, OnlyPositivePeaksInTheRangeCount) {
    const auto law = fit_power_law(std::vector<double>{1, 2, 4, 8, 0, 3}, std::vector<double>{8, 4, 2, 50, 3, 0}, 1, 4);
    EXPECT_EQ(law.points, 3);
    EXPECT_NEAR(law.exponent, 1, 1e-12);
    EXPECT_TRUE(std::isnan(fit_power_law(std::vector<double>{2, 2}, std::vector<double>{1, 3}, 0, 9).exponent));
    const auto two = fit_power_law(std::vector<double>{1, 2}, std::vector<double>{4, 1}, 0, 9);
    EXPECT_NEAR(two.exponent, 2, 1e-12);
    EXPECT_TRUE(std::isnan(two.exponent_error));
}

TEST(Attenuation, TheStandardErrorIsThatOfRepeatedTrials) {
    std::uint64_t state = 1;
    const int trials = 2000, n = 25;
    double mean = 0, square = 0, quoted = 0;
    for (int t = 0; t < trials; ++t) {
        std::vector<double> r, p;
        for (int i = 0; i < n; ++i) {
            r.push_back(5 + 2.5 * i);
            p.push_back(3 * std::pow(r.back(), -1.4) * std::exp(0.3 * synthetic::noise(state)));
        }
        const auto law = fit_power_law(r, p, 0, 1e3);
        mean += law.exponent / trials;
        square += law.exponent * law.exponent / trials;
        quoted += law.exponent_error / trials;
    }
    EXPECT_NEAR(mean, 1.4, 0.01);
    EXPECT_NEAR(quoted / std::sqrt(square - mean * mean), 1, 0.06);
}

TEST(Attenuation, BinsGiveQuantilesAndSkipEmptyOnes) {
    std::vector<double> r, p;
    for (int i = 0; i <= 100; ++i) {
        r.push_back(5 + 0.001 * i);
        p.push_back(100 - i);
    }
    r.push_back(25);
    p.push_back(7);
    r.push_back(30);  // at the upper edge: outside
    p.push_back(1);
    const auto bins = bin_peaks(r, p, std::vector<double>{0, 10, 20, 30});
    ASSERT_EQ(bins.r.size(), 2u);
    EXPECT_NEAR(bins.r[0], 5.05, 1e-12);
    EXPECT_DOUBLE_EQ(bins.median[0], 50);
    EXPECT_DOUBLE_EQ(bins.p10[0], 10);
    EXPECT_DOUBLE_EQ(bins.p90[0], 90);
    EXPECT_EQ(bins.particles[0], 101);
    EXPECT_DOUBLE_EQ(bins.p10[1], 7);
    EXPECT_THROW(bin_peaks(r, p, std::vector<double>{0, 10, 10}), std::invalid_argument);
    EXPECT_THROW(bin_peaks(r, std::vector<double>{1}, std::vector<double>{0, 10}), std::invalid_argument);
}

TEST(Attenuation, LogarithmicEdges) {
    const auto edges = logarithmic_edges(2, 32, 4);
    ASSERT_EQ(edges.size(), 5u);
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(edges[static_cast<std::size_t>(k)], 2 * std::pow(2, k), 1e-12);
    EXPECT_THROW(logarithmic_edges(0, 1, 3), std::invalid_argument);
}
