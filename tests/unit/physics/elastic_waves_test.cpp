// SPDX-License-Identifier: Apache-2.0
// Plane waves in elastic granite: speed, and the stress of a symmetric impact.
#include "../core_helpers.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

/// A bar along x that repeats in y and z: uniaxial strain.
SolidPart<double> bar(double x, int n, double spacing, const SolidOptions& o) {
    return block(elastic_granite(), o, Lattice{n, 1, 8, spacing, spacing, false, true, true, x, 0, 0});
}
std::vector<std::pair<double, double>> profile(const SolidPart<double>& s, const Array<double>& field) {
    std::vector<std::pair<double, double>> p;
    for (const Column& c : s.body.layout.columns) p.emplace_back(c.x, field[static_cast<std::size_t>(c.start)]);
    return p;
}

}  // namespace

TEST(ElasticWaves, APulseRunsWithTheSpeedOfSound) {
    const double spacing = 0.1, width = 1.5, c = 4.54303;  // mm, mm/us
    World<double> w;
    w.solids.push_back(bar(0, 600, spacing, {}));
    w.period = 8 * spacing;
    SolidBody<double>& b = w.solids[0].body;
    const double height = 1e-3;
    set_field(b, b.v, [&](Vec3<double> x) { return Vec3<double>{height * std::exp(-sq((x.x - 25) / width)), 0, 0}; });
    begin(w);
    // the pulse splits into two; centre of the right one, by its middle of mass
    const auto centre = [&] {
        double sum = 0, at = 0;
        for (const auto& [x, v] : profile(w.solids[0], b.v[0]))
            if (x > 27.5) {
                sum += v;
                at += v * x;
            }
        return std::pair{at / sum, w.time - 0.5 * w.dt};
    };
    run(w, 1.5);
    const auto [x1, t1] = centre();
    run(w, 6.5);
    const auto [x2, t2] = centre();
    std::printf("speed of a pulse %.2f m/s, c_p = %.2f m/s\n", 1e3 * (x2 - x1) / (t2 - t1), 1e3 * c);
    EXPECT_NEAR((x2 - x1) / (t2 - t1), c, 0.005 * c);
    double highest = 0;
    for (const auto& [x, v] : profile(w.solids[0], b.v[0])) highest = std::max(highest, v);
    EXPECT_NEAR(highest, 0.5 * height, 0.02 * height);
    EXPECT_LT(audit(w).momentum_residual, 1e-13);
}

TEST(ElasticWaves, SymmetricImpact) {
    // 10 m/s on the same rock at rest: sigma = rho c v/2 = 60.4223 MPa, u = 5 m/s, in fronts that run with c.
    const double spacing = 0.1, c = 4.54303, v = 0.010;
    SolidOptions o;
    o.linear = 0.06;
    o.quadratic = 1.5;
    World<double> w;
    w.period = 8 * spacing;
    w.solids.push_back(bar(-20, 200, spacing, o));
    w.solids.push_back(bar(0, 200, spacing, o));
    set_field(w.solids[0].body, w.solids[0].body.v, [&](Vec3<double>) { return Vec3<double>{v, 0, 0}; });
    w.contacts.push_back({ContactPair::solid_solid, 0, 1});
    begin(w);
    run(w, 3);
    EXPECT_LT(audit(w).momentum_residual, 1e-12);
    for (std::size_t k = 0; k < 2; ++k) {
        const SolidPart<double>& s = w.solids[k];
        const std::vector<Sym3<double>> deviator = deviators(s);
        double stress = 0, speed = 0, n = 0;
        for (const Column& column : s.body.layout.columns) {
            const auto i = static_cast<std::size_t>(column.start);
            if (std::abs(column.x) < 2 || std::abs(column.x) > 10) continue;
            stress += s.body.pressure[i] - deviator[i].xx;
            speed += s.body.v[0][i];
            ++n;
        }
        EXPECT_NEAR(stress / n, 0.0604223, 0.01 * 0.0604223);
        EXPECT_NEAR(speed / n, 0.005, 0.01 * 0.005);
        std::printf("impact: stress %.3f MPa (60.422), speed %.4f m/s (5)\n", 1e3 * stress / n, 1e3 * speed / n);
    }
    const double arrival = front(profile(w.solids[1], w.solids[1].body.v[0]), 0.0025);
    EXPECT_NEAR(arrival, c * (w.time - 0.5 * w.dt), 2 * spacing);
}
