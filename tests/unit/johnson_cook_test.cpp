// SPDX-License-Identifier: Apache-2.0
// Johnson-Cook at a point: tabulated stresses and adiabatic paths of OFHC copper, the radial return against closed forms, heating, damage.
#include "law_helpers.h"

using namespace brisance;
using namespace brisance::law_test;

namespace {

constexpr double G = 46, A = 0.090, B = 0.292, n = 0.31, C = 0.025, m = 1.09, room = 294, melt = 1356, c_v = 383e-6, rho = 8.96;

double stress(double eps, double rate_per_s, double kelvin) {
    const double theta = std::min(std::max((kelvin - room) / (melt - room), 0.0), 1.0);
    return (A + B * (eps > 0 ? std::pow(eps, n) : 0)) * (1 + C * std::log(std::max(rate_per_s, 1.0))) * (1 - std::pow(theta, m));
}
/// Shear strain whose equivalent is e: e = sqrt(2/3 d:d) = 2/sqrt 3 d_xy.
Sym shear(double e) { return {0, 0, 0, std::sqrt(0.75) * e, 0, 0}; }

/// Copper as a plain hardening metal: no rate, no heating.
Material quiet(double hardening, double exponent, double yield = A) {
    return varied("copper_ofhc", {}, {{"A", yield}, {"B", hardening}, {"n", exponent}, {"C", 0}, {"chi", 0}});
}
/// Elastic-ideally-plastic after von Mises.
Material ideal(double yield) { return quiet(0, 1, yield); }

}  // namespace

TEST(JohnsonCook, TabulatedPoints) {
    struct Point {
        double eps, rate, kelvin, mpa;
    };
    const Point table[] = {{0, 1, 294, 90.0000},       {0.1, 1, 294, 233.0154},   {0.3, 1e3, 294, 341.3052},
                           {1, 1e4, 294, 469.9588},    {0.3, 1e3, 500, 284.1859}, {1, 1e4, 600, 348.8933}};
    const Material copper = library("copper_ofhc");
    for (const Point& t : table) {
        SolidPoint<double> p = at_rest(copper, 1);
        p.d = shear(1e-6 * t.rate);  // 1/s = 1e-6 1/us, dt = 1 us
        p.state[1] = t.eps;
        p.state[2] = t.kelvin - room;
        copper.strength->update(p);
        EXPECT_NEAR(1e3 * p.yield, t.mpa, 1e-6 * t.mpa);
        EXPECT_NEAR(1e3 * stress(t.eps, t.rate, t.kelvin), t.mpa, 1e-6 * t.mpa);
    }
}

TEST(JohnsonCook, AdiabaticPaths) {
    struct End {
        double rate, mpa, kelvin, work;  // work in MJ/m3
    };
    const Material copper = library("copper_ofhc");
    for (const End& e : {End{1e3, 416.478, 386.955, 354.434}, End{1e4, 435.220, 391.338, 371.147}, End{1e5, 453.803, 395.704, 387.795}}) {
        const double increment = 1.0 / 200;
        SolidPoint<double> p = at_rest(copper, increment / (1e-6 * e.rate));
        double work = 0, last = 0;
        // total strain: plastic strain 1 and the elastic part; the last increment only as long as it takes
        while (p.state[1] < 1 - 1e-9) {
            const double elastic = p.state[1] > 0 ? 0 : mises(p.s) / (3 * G), want = std::min(increment, 1 - p.state[1] + elastic);
            p.dt = want / (1e-6 * e.rate);
            const double before = p.state[1];
            step(copper, p, shear(want), 0);
            work += 0.5 * (last + mises(p.s)) * (p.state[1] - before);
            last = mises(p.s);
            if (p.state[1] == before && want < 1e-6) break;
        }
        EXPECT_NEAR(1e3 * mises(p.s), e.mpa, 0.002 * e.mpa);
        EXPECT_NEAR(room + p.state[2], e.kelvin, 0.002 * (e.kelvin - room));
        EXPECT_NEAR(1e3 * work, e.work, 0.002 * e.work);
    }
}

TEST(JohnsonCook, HeatingIsTheFractionOfThePlasticWork) {
    const Material copper = library("copper_ofhc");
    SolidPoint<double> p = at_rest(copper, 1);
    for (int i = 0; i < 20; ++i) {
        const SolidPoint<double> before = p;
        step(copper, p, shear(2e-3), 0);
        EXPECT_NEAR(p.state[2] - before.state[2], 0.9 * 0.5 * (p.yield + mises(p.s)) * (p.state[1] - before.state[1]) / (rho * c_v), 1e-10);
    }
    EXPECT_GT(p.state[2], 1);
}

TEST(JohnsonCook, ReturnsToTheYieldSurfaceOfTheNewStrain) {
    // |s_eq - sigma_y(eps + de)|/sigma_y <= 1e-10 wherever the step yields, from the first increment that barely does to huge ones.
    double worst = 0;
    for (const double exponent : {0.1, 0.2, 0.31, 0.5, 0.8, 1.0, 1.5, 2.0})
        for (const double eps : {0.0, 1e-9, 1e-6, 1e-3, 0.1, 1.0})
            for (double over = 1e-9; over < 300; over *= 3) {  // trial stress over yield stress, less 1
                const Material metal = quiet(B, exponent);
                SolidPoint<double> p = at_rest(metal, 1);
                p.state[1] = eps;
                const double y0 = A + B * (eps > 0 ? std::pow(eps, exponent) : 0);
                step(metal, p, shear((1 + over) * y0 / (3 * G)), 0);
                const double y = A + B * std::pow(p.state[1], exponent);
                const double off = std::abs(mises(p.s) / y - 1);
                worst = std::max(worst, off);
                EXPECT_LE(off, 1e-10) << "n = " << exponent << ", eps = " << eps << ", over = " << over;
                EXPECT_GE(p.state[1], eps);
            }
    EXPECT_LE(worst, 1e-10);
}

TEST(JohnsonCook, ReturnsWithRateAndTemperature) {
    const Material copper = library("copper_ofhc");
    for (const double rate : {1e2, 1e5})
        for (const double kelvin : {294.0, 500.0, 1200.0, 1350.0})
            for (const double eps : {0.0, 0.2})
                for (const double increment : {1e-4, 1e-2, 0.5}) {
                    SolidPoint<double> p = at_rest(copper, increment / (1e-6 * rate));
                    p.state[1] = eps;
                    p.state[2] = kelvin - room;
                    p.s = {0, 0, 0, stress(eps, rate, kelvin) / std::sqrt(3.0), 0, 0};  // on the surface already
                    step(copper, p, shear(increment), 0);
                    EXPECT_NEAR(mises(p.s) / stress(p.state[1], rate, kelvin), 1, 1e-10) << rate << ' ' << kelvin << ' ' << eps << ' ' << increment;
                }
}

TEST(JohnsonCook, ElasticUntilYield) {
    const Material copper = library("copper_ofhc");
    SolidPoint<double> p = at_rest(copper, 1e6);
    step(copper, p, shear(0.999 * A / (3 * G)), 0);
    EXPECT_NEAR(mises(p.s), 0.999 * A, 1e-15);
    EXPECT_EQ(p.state[1], 0);
    EXPECT_EQ(p.state[2], 0);
    step(copper, p, shear(0.002 * A / (3 * G)), 0);
    EXPECT_GT(p.state[1], 0);
}

TEST(JohnsonCook, ProportionalPathHasTheClosedForm) {
    // Linear hardening: s_eq = A + B (e - e_y)/(1 + B/(3G)) beyond e_y = A/(3G), in any number of increments.
    const double hardening = 0.5;
    const Material metal = quiet(hardening, 1);
    for (const int steps : {1, 7, 1000}) {
        SolidPoint<double> p = at_rest(metal, 1);
        const double e = 0.03;
        for (int i = 0; i < steps; ++i) step(metal, p, (e / steps) * Sym{-0.5, -0.5, 1, 0, 0, 0}, 0);  // sqrt(2/3 d:d) = e
        const double plastic = (3 * G * e - A) / (3 * G + hardening);
        EXPECT_NEAR(p.state[1], plastic, 1e-12);
        EXPECT_NEAR(mises(p.s), A + hardening * plastic, 1e-12);
        EXPECT_NEAR(p.s.zz, 2.0 / 3 * mises(p.s), 1e-12) << "along the path";
    }
}

TEST(JohnsonCook, PathThatTurnsByARightAngleHasTheClosedForm) {
    // Ideal plasticity under a strain increment of constant direction (Krieg & Krieg 1977): the angle psi between s and the direction of d falls
    // as tan(psi/2) = tan(psi_0/2) exp(-2 G |d|/R), R = sqrt(2/3) Y.
    const double Y = 0.3, R = std::sqrt(2.0 / 3) * Y;
    const Material metal = ideal(Y);
    const Sym along{-std::sqrt(1.0 / 6), -std::sqrt(1.0 / 6), std::sqrt(2.0 / 3), 0, 0, 0}, across{0, 0, 0, std::sqrt(0.5), 0, 0};
    for (const double length : {0.3, 1.0, 3.0}) {  // of the path, in units R/2G
        const auto angle = [&](int steps) {
            SolidPoint<double> p = at_rest(metal, 1);
            step(metal, p, (5 * R / (2 * G)) * along, 0);
            EXPECT_NEAR(norm(p.s), R, 1e-14);
            for (int i = 0; i < steps; ++i) step(metal, p, (length * R / (2 * G) / steps) * across, 0);
            EXPECT_NEAR(mises(p.s), Y, 1e-10 * Y);
            return std::acos(ddot(p.s, across) / norm(p.s));
        };
        const double exact = 2 * std::atan(std::exp(-length));
        EXPECT_NEAR(angle(4000), exact, 1e-3 * exact);
        EXPECT_NEAR((angle(200) - exact) / (angle(400) - exact), 2, 0.1) << "radial return is of first order in the angle";
    }
}

TEST(JohnsonCook, PerfectPlasticityHasNoExponentTrouble) {
    // n = 0: x^0 = 1 also at x = 0, so A + B from the start.
    const Material metal = quiet(0.2, 0);
    SolidPoint<double> p = at_rest(metal, 1);
    step(metal, p, shear(0.01), 0);
    EXPECT_NEAR(p.yield, A + 0.2, 1e-14);
    EXPECT_NEAR(mises(p.s), A + 0.2, 1e-13);
    step(metal, p, shear(0.01), 0);
    EXPECT_NEAR(mises(p.s), A + 0.2, 1e-13);
}

TEST(JohnsonCook, MoltenMetalBearsNoShear) {
    const Material copper = library("copper_ofhc");
    for (const double kelvin : {1356.0, 5000.0}) {
        SolidPoint<double> p = at_rest(copper, 1);
        p.state[1] = 0.3;
        p.state[2] = kelvin - room + 1e-9;
        p.s = {0, 0, 0, 0.05, 0.01, 0};
        step(copper, p, shear(0.01), 0.05);
        EXPECT_EQ(p.yield, 0);
        EXPECT_NEAR(norm(p.s), 0, 1e-15);
        EXPECT_NEAR(p.state[2], kelvin - room + 1e-9, 1e-12) << "no work, no heat";
        EXPECT_NEAR(p.pressure, copper.eos->pressure(0.05, p.energy), 0) << "pressure stays";
    }
    // softening on the way: 1 - theta^m
    for (const double kelvin : {400.0, 800.0, 1300.0}) {
        SolidPoint<double> p = at_rest(copper, 1e12);
        p.state[2] = kelvin - room;
        step(copper, p, {}, 0);
        EXPECT_NEAR(p.yield, A * (1 - std::pow((kelvin - room) / (melt - room), m)), 1e-14);
    }
}

TEST(JohnsonCook, DamageOffLeavesTheStrength) {
    const Material off = library("copper_ofhc");
    SolidPoint<double> p = at_rest(off, 1e12);
    p.state[0] = 1;
    step(off, p, {}, 0);
    EXPECT_NEAR(p.yield, A, 1e-15);
}

TEST(JohnsonCook, DamageGrowsByItsFailureStrain) {
    // eps_f = (D1 + D2 exp(D3 sigma*)) (1 + D4 ln rate*) (1 + D5 theta), sigma* = mean stress over von Mises stress, at most 1.5.
    const Material on = varied("copper_ofhc", {}, {{"chi", 0}});
    for (const double ratio : {-1.0, -1.0 / 3, 0.0, 1.0 / 3, 1.5, 4.0})
        for (const double rate : {1.0, 1e4}) {
            SolidPoint<double> p = at_rest(on, 0.01 / (1e-6 * rate));
            p.state[1] = 0.2;
            p.state[2] = 200;
            p.d = shear(0.01);
            SolidPoint<double> probe = p;
            probe.pressure = 0;
            on.strength->update(probe);
            p.pressure = -ratio * mises(probe.s);
            on.strength->update(p);
            const double theta = 200 / (melt - room), star = std::min(ratio, 1.5);
            const double eps_f = (0.54 + 4.89 * std::exp(-3.03 * star)) * (1 + 0.014 * std::log(rate)) * (1 + 1.12 * theta);
            EXPECT_NEAR(p.state[0], (p.state[1] - 0.2) / eps_f, 1e-12) << ratio << ' ' << rate;
        }
}

TEST(JohnsonCook, AFailureStrainBelowZeroFailsAtOnce) {
    // 6061-T6: D1 = -0.77, D2 = 1.45, D3 = -0.47 give eps_f < 0 under strong mean tension: no strain is borne there.
    const Material aluminium = library("aluminium_6061_t6");
    EXPECT_LT(-0.77 + 1.45 * std::exp(-0.47 * 1.5), 0);
    SolidPoint<double> p = at_rest(aluminium, 1);
    p.d = shear(0.05);
    p.pressure = -2;
    aluminium.strength->update(p);
    EXPECT_GT(p.state[1], 0);
    EXPECT_EQ(p.state[0], 1);
}

TEST(JohnsonCook, DamageWeakensWhereItIsAsked) {
    MaterialData data = read_material("copper_ofhc");
    data.strength->parameters["damage"] = {1, dimension::none, "1", "test", "c", "x.toml:1:1"};
    const Material on = make_material(data);
    for (const double damage : {0.0, 0.5, 0.9}) {
        SolidPoint<double> p = at_rest(on, 1e12);
        p.state[0] = damage;
        step(on, p, {}, 0);
        EXPECT_NEAR(p.yield, (1 - damage) * A, 1e-14);
    }
}

TEST(JohnsonCook, NoDamageConstantsNoDamage) {
    MaterialData data = read_material("copper_ofhc");
    for (int i = 1; i <= 5; ++i) data.strength->parameters.erase("D" + std::to_string(i));
    const Material none = make_material(data);
    SolidPoint<double> p = at_rest(none, 1);
    step(none, p, shear(0.5), 0);
    EXPECT_GT(p.state[1], 0.4);
    EXPECT_EQ(p.state[0], 0);
}

TEST(JohnsonCook, MeltingBelowRoomTemperatureIsRefused) {
    for (const double t : {294.0, 100.0}) {
        MaterialData data = read_material("copper_ofhc");
        set(*data.strength, {{"T_melt", t}});
        const std::string message = refusal(data);
        EXPECT_TRUE(says(message, "T_melt") && names_a_place(message)) << message;
    }
}
