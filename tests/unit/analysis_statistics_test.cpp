// SPDX-License-Identifier: Apache-2.0
#include "analysis/failure_cause.h"
#include "analysis/point_grid.h"
#include "analysis/statistics.h"
#include "analysis/synthetic_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace brisance::analysis;

TEST(Statistics, QuantilesInterpolateBetweenRanks) {
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
    EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.1), 1);
    EXPECT_DOUBLE_EQ(quantile({7}, 0.9), 7);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Statistics, PearsonOfLinesAndOfOrthogonalSeries) {
    const std::vector<double> a{1, 2, 3, 4}, up{3, 5, 7, 9}, down{4, 3, 2, 1}, even{1, -1, -1, 1}, flat{2, 2, 2, 2};
    EXPECT_NEAR(pearson(a, up), 1, 1e-15);
    EXPECT_NEAR(pearson(a, down), -1, 1e-15);
    EXPECT_NEAR(pearson(a, even), 0, 1e-15);
    EXPECT_TRUE(std::isnan(pearson(a, flat)));
    EXPECT_THROW(pearson(a, std::vector<double>{1}), std::invalid_argument);
}

TEST(Statistics, ChiSquareHasItsClosedForms) {
    for (double x : {0.01, 0.5, 1.0, 3.0, 10.0, 60.0}) {
        EXPECT_NEAR(chi_square_survival(x, 1), std::erfc(std::sqrt(x / 2)), 1e-13);
        EXPECT_NEAR(chi_square_survival(x, 2), std::exp(-x / 2), 1e-13);
        EXPECT_NEAR(chi_square_survival(x, 6), std::exp(-x / 2) * (1 + x / 2 + x * x / 8), 1e-13);
    }
    // Even degrees of freedom: a sum of Poisson terms.
    double term = std::exp(-40.0), sum = term;
    for (int k = 1; k < 36; ++k) sum += term *= 40.0 / k;
    EXPECT_NEAR(chi_square_survival(80, 72), sum, 1e-12);
    EXPECT_DOUBLE_EQ(chi_square_survival(0, 71), 1);
}

TEST(PointGrid, FindsWhatBruteForceFinds) {
    std::uint64_t state = 5;
    std::vector<double> x, y;
    for (int i = 0; i < 400; ++i) {
        x.push_back(10 * synthetic::noise(state));
        y.push_back(3 * synthetic::noise(state));
    }
    for (double cell : {0.3, 2.0, 50.0}) {
        const PointGrid grid(x, y, cell);
        for (double distance : {0.1, 1.0, 30.0})
            for (int i = 0; i < 40; ++i) {
                const double px = 11 * synthetic::noise(state), py = 4 * synthetic::noise(state);
                std::set<std::size_t> found, brute;
                grid.near(px, py, distance, [&](std::size_t j) { EXPECT_TRUE(found.insert(j).second); });
                for (std::size_t j = 0; j < x.size(); ++j)
                    if (std::pow(x[j] - px, 2) + std::pow(y[j] - py, 2) <= distance * distance) brute.insert(j);
                EXPECT_EQ(found, brute);
            }
    }
}

TEST(FailureCause, IsTheStrengthThatWasPassed) {
    // The three particles of the paper's Figs. 6 to 8, GPa: near the wall, on a radial crack, on the spall crack.
    EXPECT_EQ(cause_of_failure(-0.1, 0.853, 0.100, 0.265), Cause::shear);
    EXPECT_EQ(cause_of_failure(0.115, 0.2, 0.100, 0.265), Cause::tensile);
    EXPECT_EQ(cause_of_failure(0.107, 0.1, 0.100, 0.265), Cause::tensile);
    EXPECT_EQ(cause_of_failure(0.2, 0.3, 0.100, 0.265), Cause::mixed);
    EXPECT_EQ(cause_of_failure(0.05, 0.1, 0.100, 0.265), Cause::tensile);  // neither passed: tension came nearer
    EXPECT_EQ(cause_of_failure(0.02, 0.2, 0.100, 0.265), Cause::shear);
    EXPECT_EQ(cause_of_failure(0.2, 0.3, 0, 0), Cause::mixed);
    EXPECT_EQ(cause_of_failure(0.2, 0.3, 0, 0.265), Cause::shear);
    static_assert(static_cast<int>(Cause::none) == 0 && static_cast<int>(Cause::mixed) == 3);
}
