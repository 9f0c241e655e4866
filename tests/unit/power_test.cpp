// SPDX-License-Identifier: Apache-2.0
// References: the functions of <cmath> in long double.
#include "law_helpers.h"
#include "math/power.h"

#include <rapidcheck.h>

using namespace brisance;
using namespace brisance::law_test;

namespace {

template <class R> constexpr double ulp = static_cast<double>(std::numeric_limits<R>::epsilon());
template <class R> double lowest_x() { return sizeof(R) == 8 ? 1e-290 : 1e-36; }
template <class R> double highest_x() { return sizeof(R) == 8 ? 1e290 : 1e36; }
template <class R> double exponent_limit() { return sizeof(R) == 8 ? 999 : 119; }

double relative(long double value, long double exact) { return static_cast<double>(std::abs(value - exact) / std::abs(exact)); }

template <class R> class Power : public testing::Test {};
using Reals = testing::Types<double, float>;
TYPED_TEST_SUITE(Power, Reals);

}  // namespace

TYPED_TEST(Power, LogarithmIsGoodToAFewUnitsInTheLastPlace) {
    using R = TypeParam;
    Random random(1);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        // also many numbers near 1, where the logarithm is small and must keep its relative accuracy
        const R x = static_cast<R>(i % 2 ? random.decades(lowest_x<R>(), highest_x<R>()) : 1 + random.uniform(-1, 1) * random.decades(1e-7, 0.9));
        const long double exact = std::log2(static_cast<long double>(x));
        if (exact == 0) continue;
        worst = std::max(worst, relative(log2_positive(x), exact) / ulp<R>);
        EXPECT_NEAR(natural_log(x), std::log(static_cast<double>(x)), 4 * ulp<R> * std::abs(std::log(static_cast<double>(x))));
    }
    EXPECT_LT(worst, 3);
    EXPECT_EQ(log2_positive(R(1)), R(0));
    for (int k = -100; k <= 100; ++k) EXPECT_EQ(log2_positive(static_cast<R>(std::ldexp(1.0, k))), static_cast<R>(k));
}

TYPED_TEST(Power, ExponentialIsGoodOverTheRangeOfTheType) {
    using R = TypeParam;
    Random random(2);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const R x = static_cast<R>(random.uniform(-exponent_limit<R>(), exponent_limit<R>()));
        worst = std::max(worst, relative(exp2_clamped(x), std::exp2(static_cast<long double>(x))) / ulp<R>);
        // e^x: the argument in base 2 is rounded once
        const R y = static_cast<R>(0.69 * static_cast<double>(x));
        const double allowed = (2 + 0.8 * std::abs(static_cast<double>(x))) * ulp<R>;
        EXPECT_LT(relative(exponential(y), std::exp(static_cast<long double>(y))), allowed) << y;
    }
    EXPECT_LT(worst, 2);
    for (int k = -100; k <= 100; ++k) EXPECT_EQ(exp2_clamped(static_cast<R>(k)), static_cast<R>(std::ldexp(1.0, k)));
}

TYPED_TEST(Power, RelativeErrorOfPowersIsAsTheHeaderSays) {
    using R = TypeParam;
    Random random(3);
    double worst = 0;  // over 2 + |y log2 x| / 2 units in the last place
    for (int i = 0; i < 400000; ++i) {
        const R x = static_cast<R>(i % 2 ? random.decades(lowest_x<R>(), highest_x<R>()) : random.decades(1e-4, 1e4));
        const R y = static_cast<R>(random.uniform(-5, 5));
        const double exponent = std::abs(static_cast<double>(y) * std::log2(static_cast<double>(x)));
        if (exponent > exponent_limit<R>()) continue;
        const double error = relative(power(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y)));
        worst = std::max(worst, error / ((2 + 0.5 * exponent) * ulp<R>));
    }
    this->RecordProperty("worst_over_claim", std::to_string(worst));
    EXPECT_LT(worst, 1.5);  // "about"
}

TYPED_TEST(Power, EndsOfTheRange) {
    using R = TypeParam;
    for (const R y : {R(0.3), R(1), R(2.5)}) {
        EXPECT_EQ(power(R(0), y), R(0));
        EXPECT_EQ(power(R(-0.0), y), R(0));
        EXPECT_EQ(power(R(-3), y), R(0));
        EXPECT_EQ(power(R(1), y), R(1));
    }
    EXPECT_EQ(power(R(7), R(0)), R(1));
    EXPECT_EQ(power(R(0), R(0)), R(0));  // laws guard the exponent 0 themselves
    for (const R x : {R(1e30), std::numeric_limits<R>::infinity()}) {
        EXPECT_TRUE(std::isfinite(exponential(x)));
        EXPECT_GT(exponential(x), R(1e30));
        EXPECT_GE(exponential(-x), R(0));
        EXPECT_LT(exponential(-x), R(1e-30));
    }
    EXPECT_TRUE(std::isfinite(log2_positive(R(0))));
    EXPECT_TRUE(std::isfinite(power(std::numeric_limits<R>::max(), R(5))));
}

TYPED_TEST(Power, PackGivesTheBitsOfTheScalar) {
    using R = TypeParam;
    using V = Pack<R>;
    Random random(4);
    for (int i = 0; i < 20000; ++i) {
        R x[lanes<R>], z[lanes<R>];
        for (int l = 0; l < lanes<R>; ++l) {
            x[l] = static_cast<R>(i % 5 == 0 ? random.uniform(-1, 3) : random.decades(lowest_x<R>(), highest_x<R>()));
            z[l] = static_cast<R>(random.uniform(-1.2, 1.2) * exponent_limit<R>());
        }
        const R y = static_cast<R>(random.uniform(-5, 5));
        const V px = load<V>(x), pz = load<V>(z);
        const V log = log2_positive(px), exp2 = exp2_clamped(pz), exp = exponential(pz), pow = power(px, y), ln = natural_log(px);
        for (int l = 0; l < lanes<R>; ++l) {
            ASSERT_TRUE(same_bits(lane(log, l), log2_positive(x[l]))) << x[l];
            ASSERT_TRUE(same_bits(lane(ln, l), natural_log(x[l]))) << x[l];
            ASSERT_TRUE(same_bits(lane(exp2, l), exp2_clamped(z[l]))) << z[l];
            ASSERT_TRUE(same_bits(lane(exp, l), exponential(z[l]))) << z[l];
            ASSERT_TRUE(same_bits(lane(pow, l), power(x[l], y))) << x[l] << ' ' << y;
        }
    }
}

TEST(PowerLaws, ExponentsAddAndInverseUndoes) {
    EXPECT_TRUE(rc::check("x^a x^b = x^(a+b), (x^a)^(1/a) = x", [] {
        const auto number = [](double low, double high) {
            return *rc::gen::map(rc::gen::inRange<std::int64_t>(0, 1000000000), [=](std::int64_t n) { return low + (high - low) * 1e-9 * static_cast<double>(n); });
        };
        const double x = std::exp(number(-30, 30)), a = number(0.05, 4), b = number(-4, 4);
        const double tolerance = 1e-15 * (20 + 10 * std::abs(std::log2(x)) * (a + std::abs(b) + 1 / a));
        RC_ASSERT(std::abs(power(x, a) * power(x, b) / power(x, a + b) - 1) < tolerance);
        RC_ASSERT(std::abs(power(power(x, a), 1 / a) / x - 1) < tolerance);
    }));
}
