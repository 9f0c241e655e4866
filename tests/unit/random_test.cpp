// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>
#include <vector>

using namespace brisance;

TEST(Random, FollowsSplitMix64) {
    // First outputs of SplitMix64 from the state 1234567, as published with the xoshiro generators.
    const std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
    EXPECT_EQ(mix(1234567 + golden), 6457827717110365317ULL);
    EXPECT_EQ(mix(1234567 + 2 * golden), 3203168211198807973ULL);
}

TEST(Random, UniformIsUniform) {
    constexpr int n = 200000;
    std::vector<double> u(n);
    for (int i = 0; i < n; ++i) u[i] = random_uniform(7, 3, i);
    std::sort(u.begin(), u.end());
    EXPECT_GT(u.front(), 0);
    EXPECT_LT(u.back(), 1);
    double ks = 0;  // largest distance from the distribution function u
    for (int i = 0; i < n; ++i) ks = std::max({ks, u[i] - i / double(n), (i + 1) / double(n) - u[i]});
    EXPECT_LT(ks * std::sqrt(n), 1.95);  // exceeded by chance in 1 of 1000 cases
}

TEST(Random, NeighbouringArgumentsShareNothing) {
    // Every output bit flips for half of the single steps in seed, stream or counter.
    constexpr int n = 4000;
    for (int which = 0; which < 3; ++which) {
        std::vector<int> flips(64);
        for (std::uint64_t i = 0; i < n; ++i) {
            const std::uint64_t a = random_bits(i, i, i);
            const std::uint64_t b = random_bits(i + (which == 0), i + (which == 1), i + (which == 2));
            for (int k = 0; k < 64; ++k) flips[k] += int((a ^ b) >> k & 1);
        }
        for (const int f : flips) EXPECT_NEAR(f, n / 2, 5 * std::sqrt(n / 4.0));
    }
    std::set<std::uint64_t> seen;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (std::uint64_t stream = 0; stream < 20; ++stream) {
            for (std::uint64_t counter = 0; counter < 20; ++counter) seen.insert(random_bits(seed, stream, counter));
        }
    }
    EXPECT_EQ(seen.size(), 8000u);
}

TEST(Random, NormalHasItsMoments) {
    constexpr int n = 400000;
    double m1 = 0, m2 = 0, m3 = 0, m4 = 0, lag = 0, last = 0;
    for (int i = 0; i < n; ++i) {
        const double x = random_normal(1, 2, i);
        m1 += x / n;
        m2 += x * x / n;
        m3 += x * x * x / n;
        m4 += x * x * x * x / n;
        lag += x * last / n;
        last = x;
    }
    const double e = 4 / std::sqrt(n);  // four standard errors of the mean
    EXPECT_NEAR(m1, 0, e);
    EXPECT_NEAR(m2, 1, e * std::sqrt(2));
    EXPECT_NEAR(m3, 0, e * std::sqrt(15));
    EXPECT_NEAR(m4, 3, e * std::sqrt(96));
    EXPECT_NEAR(lag, 0, e);
}
