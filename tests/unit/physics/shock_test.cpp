// SPDX-License-Identifier: Apache-2.0
// Strong shocks by impact: states on the Hugoniots, and what contact hands from one material to the other.
#include "../core_helpers.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

SolidOptions viscous() {
    SolidOptions o;
    o.pairwise = true;
    o.alpha = 1;
    o.beta = 2;
    return o;
}

}  // namespace

TEST(Shock, CopperOnCopper) {
    // 500 m/s: P = 9.627098 GPa, u = 250 m/s, rho = 9479.572 kg/m3, e = 31.25 kJ/kg, U_s = 4312.25 m/s (rho_0 = 8930, C = 3940 m/s, S = 1.489)
    const double d = 0.05, v = 0.5, P = 9.627098, u = 0.25, rho = 9.479572, e = 0.03125, Us = 4.31225;
    const Material copper = without_strength("copper_ofhc", 8.93);
    World<double> w;
    w.period = 8 * d;
    w.solids.push_back(block(copper, viscous(), Lattice{200, 1, 8, d, d, false, true, true, -200 * d, 0, 0}));
    w.solids.push_back(block(copper, viscous(), Lattice{200, 1, 8, d, d, false, true, true, 0, 0, 0}));
    set_field(w.solids[0].body, w.solids[0].body.v, [&](Vec3<double>) { return Vec3<double>{v, 0, 0}; });
    w.contacts.push_back({ContactPair::solid_solid, 0, 1});
    begin(w);
    run(w, 1.6);
    const Audit a = audit(w);
    EXPECT_LT(a.momentum_residual, 1e-12);
    EXPECT_LT(std::abs(a.residual_relative), 1e-3);
    EXPECT_LT(a.penetration, 0.3 * d);
    const SolidBody<double>& b = w.solids[1].body;
    double n = 0, p = 0, speed = 0, density = 0, energy = 0;
    std::vector<std::pair<double, double>> profile;
    for (std::size_t c = 0; c < b.layout.columns.size(); ++c) {
        const Column& column = b.layout.columns[c];
        const auto i = static_cast<std::size_t>(column.start);
        profile.emplace_back(column.x, b.pressure[i]);
        if (column.x < 1 || column.x > 5.5) continue;  // off the heated contact and the front
        const auto next = static_cast<std::size_t>(b.layout.columns[c + 1].start);
        ++n;
        p += b.pressure[i];
        speed += b.v[0][i];
        density += 8.93 * d / (d + b.u[0][next] - b.u[0][i]);
        energy += b.energy[i] / 8.93;
    }
    const double reference_front = front(profile, 0.5 * P);  // in the material's own coordinate: U_s t
    std::printf("copper: P %.4f (%.4f) GPa, u %.4f (%.4f), rho %.4f (%.4f), e %.5f (%.5f) kJ/g, front at %.3f (%.3f) mm, overlap %.3f spacings\n", p / n, P, speed / n, u,
                density / n, rho, energy / n, e, reference_front, Us * w.time, a.penetration / d);
    EXPECT_NEAR(p / n, P, 0.01 * P);
    EXPECT_NEAR(speed / n, u, 0.01 * u);
    EXPECT_NEAR(density / n, rho, 0.01 * rho);
    EXPECT_NEAR(energy / n, e, 0.02 * e);
    EXPECT_NEAR(reference_front, Us * w.time, 2 * d);
}

TEST(Shock, CopperOnWater) {
    // 500 m/s: P = 1.08230 GPa, u = 469.589 m/s (rho_0 = 8930 and 1000 kg/m3)
    const double d = 0.05, P = 1.0823, u = 0.469589;
    World<double> w;
    w.period = 2 * d;
    w.solids.push_back(block(without_strength("copper_ofhc", 8.93), viscous(), Lattice{40, 100, 2, d, d, false, false, true, -40 * d, -50 * d, 0}));
    MaterialData data = read_material("water");
    data.density.value = 1;
    data.eos = law("mie_gruneisen", {{"C", 1.483, dimension::velocity}, {"S1", 1.75, dimension::none}, {"S2", 0, dimension::none}, {"S3", 0, dimension::none},
                                     {"Gamma0", 0.28, dimension::none}, {"a", 0, dimension::none}, {"E0", 0, dimension::pressure}});
    w.fluids.push_back(fluid(make_material(data), {}, {d, 60, 100, 2, 0, -50 * d, 0}));
    set_field(w.solids[0].body, w.solids[0].body.v, [&](Vec3<double>) { return Vec3<double>{0.5, 0, 0}; });
    w.contacts.push_back({ContactPair::fluid_solid, 0, 0});
    begin(w);
    run(w, 0.8);
    const Audit a = audit(w);
    EXPECT_LT(a.momentum_residual, 1e-12);
    const FluidBody& b = w.fluids[0].body;
    double n = 0, p = 0, speed = 0;
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
        if (std::abs(b.x[1][i]) > 0.3 || b.reference[0][i] < 0.25 || b.reference[0][i] > 1.2) continue;  // the middle, which its sides have not told of yet
        ++n;
        p += b.pressure[i];
        speed += b.v[0][i];
    }
    std::printf("copper on water: P %.4f (%.4f) GPa, u %.4f (%.4f), overlap %.3f spacings\n", p / n, P, speed / n, u, a.penetration / d);
    EXPECT_NEAR(p / n, P, 0.03 * P);
    EXPECT_NEAR(speed / n, u, 0.02 * u);
}
