// SPDX-License-Identifier: Apache-2.0
// Holmquist-Johnson-Cook concrete at a point: closed forms with the published constants of 1993.
#include "laws/point_path.h"
#include "law_helpers.h"

using namespace brisance;
using namespace brisance::law_test;

namespace {

// the published set, GPa
constexpr double G = 14.86, A = 0.79, B = 1.6, C = 0.007, N = 0.61, FC = 0.048, T = 0.004, EFMIN = 0.01, SFMAX = 7, PC = 0.016, UC = 0.001, PL = 0.8,
                 UL = 0.1, D1 = 0.04, K1 = 85, K2 = -171, K3 = 208;
constexpr double slow = 1e12;

double dense(double mu) {
    const double m = (mu - UL) / (1 + UL);
    return m > 0 ? m * (K1 + m * (K2 + m * K3)) : K1 * m;
}
/// mu at which the material without pores has PL: the positive root of the cubic, by bisection.
double lock() {
    double low = 0.1, high = 0.2;
    for (int i = 0; i < 100; ++i) {
        const double m = 0.5 * (low + high);
        (dense(m) < PL ? low : high) = m;
    }
    return low;
}

SolidPoint<double> pressed_to(const Material& m, double mu, int steps = 1) {
    SolidPoint<double> p = at_rest(m, slow);
    for (int i = 1; i <= steps; ++i) step(m, p, {}, mu * i / steps);
    return p;
}

/// The strength in force at a pressure in the elastic range.
double yield_at(const Material& m, double pressure, double damage, double rate = 0) {
    SolidPoint<double> p = at_rest(m, 1);
    p.state[0] = damage;
    step(m, p, {0, 0, 0, rate * std::sqrt(0.75), 0, 0}, pressure * UC / PC);
    return p.yield;
}

}  // namespace

TEST(Hjc, PressureOfTheThreeRegions) {
    const Material m = library("concrete_hjc");
    const double mu_l = lock();
    EXPECT_NEAR(mu_l, 0.1105, 2e-4);
    for (const auto& [mu, P] : std::vector<std::pair<double, double>>{{0.0005, 0.008},
                                                                      {0.001, 0.016},
                                                                      {0.05, PC + (PL - PC) * (0.05 - UC) / (mu_l - UC)},
                                                                      {0.1, PC + (PL - PC) * (0.1 - UC) / (mu_l - UC)},
                                                                      {0.15, dense(0.15)},
                                                                      {0.3, dense(0.3)}}) {
        EXPECT_NEAR(pressed_to(m, mu).pressure, P, 1e-12) << mu;
        EXPECT_NEAR(pressed_to(m, mu, 50).pressure, P, 1e-12) << "many steps, " << mu;
    }
    EXPECT_NEAR(pressed_to(m, mu_l).pressure, PL, 1e-9);
    // by hand: m = 0.05/1.1, 85 m - 171 m^2 + 208 m^3
    EXPECT_NEAR(dense(0.15), 3.863636 - 0.353306 + 0.019534, 2e-6);
}

TEST(Hjc, UnloadingStiffensAsThePoresClose) {
    const Material m = library("concrete_hjc");
    const double mu_l = lock(), mu_m = 0.05, F = (mu_m - UC) / (mu_l - UC), ku = (1 - F) * 16 + F * K1;
    SolidPoint<double> p = pressed_to(m, mu_m);
    const double top = p.pressure;
    step(m, p, {}, 0.045);
    EXPECT_NEAR(p.pressure, top - ku * 0.005, 1e-12);
    step(m, p, {}, 0.049);
    EXPECT_NEAR(p.pressure, top - ku * 0.001, 1e-12) << "and back the same way";
    EXPECT_DOUBLE_EQ(p.state[2], mu_m - UC);
    step(m, p, {}, 0.06);
    EXPECT_NEAR(p.pressure, PC + (PL - PC) * (0.06 - UC) / (mu_l - UC), 1e-12) << "then crushing goes on";
    // without pores: back along the same curve, to P = 0 at UL and tension beyond, cut off
    p = pressed_to(m, 0.2);
    step(m, p, {}, 0.15);
    EXPECT_NEAR(p.pressure, dense(0.15), 1e-12);
    step(m, p, {}, UL);
    EXPECT_NEAR(p.pressure, 0, 1e-12);
    step(m, p, {}, UL - 1e-4);
    EXPECT_NEAR(p.pressure, -T * (1 - p.state[0]), 1e-12);
}

TEST(Hjc, StrengthSurface) {
    const Material m = library("concrete_hjc");
    for (const double P : {0.0, 0.004, 0.008, 0.012})
        for (const double D : {0.0, 0.4, 1.0}) EXPECT_NEAR(yield_at(m, P, D), FC * (A * (1 - D) + B * std::pow(P / FC, N)), 1e-15) << P << " " << D;
    // tension: a straight line to nothing at -T (1 - D)
    for (const double D : {0.0, 0.4})
        for (const double f : {0.25, 0.5, 1.0}) EXPECT_NEAR(yield_at(m, -f * T * (1 - D), D), FC * A * (1 - D) * (1 - f), 1e-12);
    // rate: 1 + C ln(rate), rate in 1/s, and 1 below the reference
    EXPECT_NEAR(yield_at(m, 0, 0, 1e-4) / (FC * A), 1 + C * std::log(100), 1e-12);  // 1e-4/us = 100/s
    EXPECT_NEAR(yield_at(m, 0, 0, 1e-9) / (FC * A), 1, 1e-15);
    // the cap, at high pressure
    EXPECT_NEAR(pressed_to(m, 0.3).yield, FC * SFMAX, 1e-15);
}

TEST(Hjc, UniaxialStrengthsAreThoseOfTheSurface) {
    const Material m = library("concrete_hjc");
    PathLeg l;
    l.kind = PathLeg::Kind::axial;
    l.steps = 4000;
    l.rate = 1e-9;
    for (const int sign : {1, -1}) {
        l.strain.z = -sign * 0.006;
        PathPoint peak;
        for (const PathPoint& r : drive(m, {"uniaxial", {l}, 1}))
            if (r.mises > peak.mises) peak = r;
        const auto surface = [&](double P, double D) { return FC * (P > 0 ? A * (1 - D) + B * std::pow(P / FC, N) : A * std::max(1 - D + P / T, 0.0)); };
        EXPECT_NEAR(peak.mises, surface(peak.pressure, peak.state[0]), 2e-3 * peak.mises) << sign << ": on the surface of its damage";
        double low = 0, high = 1;  // q = Y(sign q/3) of the intact surface
        for (int i = 0; i < 100; ++i) {
            const double q = 0.5 * (low + high);
            (q < surface(sign * q / 3, 0) ? low : high) = q;
        }
        // pores crush from PC on, well below the peak in compression, and that is damage
        EXPECT_LE(peak.mises, low * (1 + 1e-9));
        EXPECT_GE(peak.mises, (sign > 0 ? 0.95 : 0.99) * low);
        EXPECT_NEAR(1e3 * low, sign > 0 ? 99.0 : 9.12, 0.05);
    }
}

TEST(Hjc, DamageCountsPlasticStrainAndCompaction) {
    const Material m = library("concrete_hjc");
    // compaction alone, in one step to mu_m = 0.05: mu_p = mu_m - P/K_u
    const double mu_l = lock(), mu_m = 0.05, F = (mu_m - UC) / (mu_l - UC), ku = (1 - F) * 16 + F * K1, P = PC + (PL - PC) * (mu_m - UC) / (mu_l - UC);
    EXPECT_NEAR(pressed_to(m, mu_m).state[0], (mu_m - P / ku) / (D1 * (P + T) / FC), 1e-12);
    // shear alone, at P = 0: d eps_p/EFMIN, since D1 T* = 0.0033 < EFMIN
    SolidPoint<double> p = at_rest(m, slow);
    const double e = 3e-3;
    step(m, p, {0, 0, 0, e, 0, 0}, 0);
    const double q = std::sqrt(3.0) * 2 * G * e, plastic = (q - FC * A) / (3 * G), D = plastic / EFMIN;
    EXPECT_NEAR(p.state[1], plastic, 1e-15);
    EXPECT_NEAR(p.state[0], D, 1e-12);
    EXPECT_NEAR(mises(p.s), FC * A * (1 - D), 1e-12) << "on the surface of the new damage";
    for (int i = 0; i < 40; ++i) step(m, p, {0, 0, 0, e, 0, 0}, 0);
    EXPECT_EQ(p.state[0], 1);
    EXPECT_EQ(mises(p.s), 0) << "no cohesion left and no pressure";
}

TEST(Hjc, InconsistentSetsAreRefusedWithTheirPlace) {
    const auto refused = [](const Values& eos, const Values& strength, const std::string& said) {
        MaterialData data = read_material("concrete_hjc");
        set(data.eos, eos);
        set(*data.strength, strength);
        const std::string message = refusal(data);
        EXPECT_TRUE(says(message, said) && names_a_place(message) && says(message, "source: ")) << message;
    };
    refused({{"K1", 30}}, {}, "P = PC/UC mu");
    refused({{"K2", 100}}, {}, "P = PC/UC mu");
    refused({}, {{"PL", 0.01}}, "has to be above PC");
    refused({}, {{"K1", 10}}, "at least the elastic modulus");
    refused({}, {{"K2", -400}}, "falls from m");
}
