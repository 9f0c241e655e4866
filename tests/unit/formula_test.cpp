// SPDX-License-Identifier: Apache-2.0
#include "base/formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace brisance;

namespace {

double at(const char* text, Dimension wanted, double x = 0, double y = 0, double z = 0) { return Formula(text, wanted)(x, y, z); }

std::string message_of(const char* text, Dimension wanted) {
    try {
        Formula(text, wanted);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(Formula, Values) {
    using namespace dimension;
    EXPECT_DOUBLE_EQ(at("1 + 2*3^2 - 8/4/2", none), 18);
    EXPECT_DOUBLE_EQ(at("-2^2", none), -4);
    EXPECT_DOUBLE_EQ(at("2^-1^2", none), 0.5);
    EXPECT_DOUBLE_EQ(at("2^3^2", none), 512);
    EXPECT_DOUBLE_EQ(at("-(1 - 3)*-2", none), -4);
    EXPECT_DOUBLE_EQ(at("10 m/s", velocity), 0.01);
    EXPECT_DOUBLE_EQ(at("10 m/s*exp(0)", velocity), 0.01);
    EXPECT_DOUBLE_EQ(at("1e-3 km/s * exp(-((x - 2.5 cm)/1.5 mm)^2)", velocity, 26.5), 1e-3 * std::exp(-1));
    EXPECT_DOUBLE_EQ(at("5 kJ/g/2", specific_energy), 2.5);
    EXPECT_DOUBLE_EQ(at("y/us - y/(1 us)", velocity, 0, 3), 0);
    EXPECT_DOUBLE_EQ(at("1 /us * y", velocity, 0, 3), 3);
    EXPECT_DOUBLE_EQ(at("-1 km/s*x/sqrt(x^2 + y^2 + z^2)", velocity, 2, 3, 6), -2.0 / 7);
    EXPECT_DOUBLE_EQ(at("min(x, y) + max(x, z) + abs(-1 mm) + hypot(3 mm, 4 mm)", length, 1, 2, 3), 10);
    EXPECT_DOUBLE_EQ(at("step(x - 1 mm) + 10*step(1 mm - x)", none, 1), 11);
    EXPECT_DOUBLE_EQ(at("step(x - 1 mm)", none, 0.5), 0);
    EXPECT_NEAR(at("besselj1(-1.8412) + besselj0(0)", none), 1 - 0.58186522, 1e-6);
    EXPECT_DOUBLE_EQ(at("atan2(y, x)/pi", none, 0, 1), 0.5);
    EXPECT_DOUBLE_EQ(at("2660 kg/m3", density), 2.66);
}

TEST(Formula, Refusals) {
    using namespace dimension;
    const auto says = [](const std::string& message, const char* fragment) { return message.find(fragment) != std::string::npos; };
    EXPECT_TRUE(says(message_of("x + 1 m/s", length), "a length and a velocity can not be added"));
    EXPECT_TRUE(says(message_of("x", velocity), "is a length; wanted is a velocity"));
    EXPECT_TRUE(says(message_of("exp(x)", none), "exp takes a number without unit"));
    EXPECT_TRUE(says(message_of("sqrt(x)", none), "no root of a length"));
    EXPECT_TRUE(says(message_of("x^y", none), "exponent"));
    EXPECT_TRUE(says(message_of("x^0.5", none), "whole number"));
    EXPECT_TRUE(says(message_of("sni(1)", none), "did you mean 'sin'"));
    EXPECT_TRUE(says(message_of("(1", none), "not closed"));
    EXPECT_TRUE(says(message_of("1 +", none), "too early"));
    EXPECT_TRUE(says(message_of("1 2", none), "not understood"));
    EXPECT_TRUE(says(message_of("min(1)", none), "two arguments"));
    EXPECT_TRUE(says(message_of("sin 1", none), "brackets"));
    EXPECT_TRUE(says(message_of("", none), "too early"));
    EXPECT_TRUE(says(message_of(std::string(200, '(').c_str(), none), "too many brackets"));
    EXPECT_TRUE(says(message_of(std::string(200, '-').c_str(), none), "too many signs"));
}
