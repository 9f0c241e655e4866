// SPDX-License-Identifier: Apache-2.0
#include "geometry/strength_field.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace brisance;

TEST(StrengthField, NoModulusIsNoScatter) {
    const StrengthField field(0, 0, 1, 0);
    EXPECT_EQ(field({1, 2, 3}), 1);
    EXPECT_EQ(field({-40, 0.1, 7}), 1);
}

TEST(StrengthField, FollowsWeibullOverManyRocks) {
    // One point in each of many rocks: independent values. Kolmogorov and Smirnov against 1 - exp(-(w Gamma(1 + 1/m))^m).
    constexpr int n = 20000;
    for (const double m : {1.5, 6.0, 20.0}) {
        std::vector<double> w(n);
        for (int i = 0; i < n; ++i) w[i] = StrengthField(m, 2, std::uint64_t(i), 0)({3, -1, 2});
        std::sort(w.begin(), w.end());
        const double gamma = std::tgamma(1 + 1 / m);
        double ks = 0, mean = 0, square = 0;
        for (int i = 0; i < n; ++i) {
            const double f = 1 - std::exp(-std::pow(w[i] * gamma, m));
            ks = std::max({ks, f - i / double(n), (i + 1) / double(n) - f});
            mean += w[i] / n;
            square += w[i] * w[i] / n;
        }
        EXPECT_LT(ks * std::sqrt(n), 1.95) << "m = " << m;  // 1 of 1000 by chance
        const double variance = std::tgamma(1 + 2 / m) / (gamma * gamma) - 1;
        EXPECT_NEAR(mean, 1, 4 * std::sqrt(variance / n));
        EXPECT_NEAR(square - mean * mean, variance, 0.1 * variance);
    }
}

TEST(StrengthField, OneRockIsAlreadyTypical) {
    // Over 40 correlation lengths in each direction the average over one rock comes near to that over rocks.
    const StrengthField field(6, 1, 5, 0);
    double g1 = 0, g2 = 0, w1 = 0;
    constexpr int n = 24;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                const Point p{1.7 * i, 1.7 * j, 1.7 * k};
                const double g = field.gaussian(p);
                g1 += g / (n * n * n);
                g2 += g * g / (n * n * n);
                w1 += field(p) / (n * n * n);
            }
        }
    }
    EXPECT_NEAR(g1, 0, 0.05);
    EXPECT_NEAR(g2, 1, 0.05);
    EXPECT_NEAR(w1, 1, 0.02);
}

TEST(StrengthField, TheWeakestOfManyPlacesFollowsTheSizeEffect) {
    // The weakest of n independent places of a Weibull rock has the mean n^(-1/m) (weakest link). Places four correlation lengths apart are
    // independent to exp(-8). Error of a mean over k rocks: that of the weakest, of the relative width of a single strength, over sqrt(k).
    constexpr int rocks = 600;
    const double l = 1.5;
    for (const double m : {5.0, 10.0}) {
        const double width = std::sqrt(std::tgamma(1 + 2 / m) / std::pow(std::tgamma(1 + 1 / m), 2) - 1);
        for (const int side : {1, 2, 3, 5}) {
            const int n = side * side * side;
            double mean = 0;
            for (int rock = 0; rock < rocks; ++rock) {
                const StrengthField field(m, l, std::uint64_t(rock + 1000 * side), 0);
                double weakest = 1e300;
                for (int i = 0; i < n; ++i) weakest = std::min(weakest, field({4 * l * (i % side), 4 * l * (i / side % side), 4 * l * (i / side / side)}));
                mean += weakest / rocks;
            }
            const double law = std::pow(n, -1 / m);
            EXPECT_NEAR(mean / law, 1, 4 * width / std::sqrt(rocks)) << "m = " << m << ", n = " << n;
        }
    }
}

TEST(StrengthField, CorrelationIsGaussianInEveryDirection) {
    constexpr int n = 6000;
    const double l = 2.5;
    for (const Point e : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{0.6, 0, 0.8}}) {
        for (const double r : {0.5 * l, l, 2 * l, 4 * l}) {
            double sum = 0;
            for (int i = 0; i < n; ++i) {
                const StrengthField field(6, l, std::uint64_t(i), 0);
                sum += field.gaussian({1, 1, 1}) * field.gaussian(Point{1, 1, 1} + r * e) / n;
            }
            EXPECT_NEAR(sum, std::exp(-r * r / (2 * l * l)), 4 * std::sqrt(2.0 / n)) << "r = " << r;
        }
    }
}

TEST(StrengthField, RepeatsAlongZ) {
    const double period = 7.5;
    const StrengthField field(6, 2, 3, period), free(6, 2, 3, 0);
    double difference = 0;
    for (int i = 0; i < 200; ++i) {
        const Point p{0.37 * i, 5 - 0.21 * i, 0.11 * i};
        EXPECT_NEAR(field(p), field(p + Point{0, 0, period}), 1e-12);
        EXPECT_NEAR(field(p), field(p - Point{0, 0, 3 * period}), 1e-12);
        difference = std::max(difference, std::abs(free(p) - free(p + Point{0, 0, period})));
    }
    EXPECT_GT(difference, 0.1);
}

TEST(StrengthField, SeedIsTheRock) {
    const StrengthField a(6, 2, 1, 0), same(6, 2, 1, 0), other(6, 2, 2, 0);
    EXPECT_EQ(a({1, 2, 3}), same({1, 2, 3}));
    EXPECT_NE(a({1, 2, 3}), other({1, 2, 3}));
}

TEST(StrengthField, RefusesNonsense) {
    EXPECT_THROW(StrengthField(-1, 2, 1, 0), InputError);
    EXPECT_THROW(StrengthField(6, 0, 1, 0), InputError);
    EXPECT_THROW(StrengthField(6, 2, 1, -1), InputError);
}
