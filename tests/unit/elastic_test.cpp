// SPDX-License-Identifier: Apache-2.0
#include "law_helpers.h"

using namespace brisance;
using namespace brisance::law_test;

namespace {

Material rock(double G) {
    MaterialData data = read_material("barre_granite");
    data.strength = LawData{"elastic", "x.toml:1:1", {{"G", {G, dimension::pressure, "G", "test", "c", "x.toml:2:1"}}}};
    set(data.eos, {{"K2", 0}, {"K3", 0}});
    return make_material(data);
}

}  // namespace

TEST(Elastic, HookeWithoutLimitInAnyNumberOfSteps) {
    const double G = 21.9;
    const Material m = rock(G);
    Random random(1);
    for (const double size : {1e-9, 1e-3, 10.0}) {
        SolidPoint<double> p = at_rest(m);
        Sym total{};
        for (int i = 0; i < 50; ++i) {
            const Sym d = random.sym(size);
            total = total + d;
            step(m, p, d, 0);
        }
        EXPECT_LT(norm(p.s - (2 * G) * deviator(total)), 1e-13 * 2 * G * 50 * size);
        EXPECT_NEAR(trace(p.s), 0, 1e-12 * 2 * G * size);
    }
}

TEST(Elastic, UniaxialStrainAndStress) {
    // K = 25.7, G = 21.9 GPa: E = 51.166 GPa, nu = 0.16818, M = K + 4/3 G = 54.9 GPa.
    const double K = 25.7, G = 21.9, E = 51.166, nu = 0.16818, mu = 1e-6;
    const Material m = rock(G);
    SolidPoint<double> p = at_rest(m);
    step(m, p, {0, 0, -mu, 0, 0, 0}, mu);
    EXPECT_NEAR(p.s.zz - p.pressure, -(K + 4.0 / 3 * G) * mu, 1e-12 * K * mu);
    EXPECT_NEAR(p.s.xx - p.pressure, -(K - 2.0 / 3 * G) * mu, 1e-12 * K * mu);
    p = at_rest(m);
    step(m, p, {-nu * mu, -nu * mu, mu, 0, 0, 0}, -(1 - 2 * nu) * mu);
    EXPECT_NEAR(p.s.zz - p.pressure, E * mu, 1e-4 * E * mu);
    EXPECT_NEAR(p.s.xx - p.pressure, 0, 1e-4 * E * mu);
    EXPECT_NEAR(m.longitudinal_modulus(), K + 4.0 / 3 * G, 1e-12);
    EXPECT_NEAR(m.sound_speed(), std::sqrt(54.9 / 2.66), 1e-12);
}

TEST(Elastic, NeverYieldsAndKeepsThePressure) {
    const Material m = rock(21.9);
    SolidPoint<double> p = at_rest(m);
    step(m, p, {1, -2, 3, 4, 5, -6}, 0.7);
    EXPECT_EQ(p.pressure, m.eos->pressure(0.7, 0));
    EXPECT_GT(p.yield, 1e20);
    EXPECT_EQ(p.integrity, 1);
    EXPECT_DOUBLE_EQ(p.shear_stiffness, 4.0 / 3 * 21.9);
}
