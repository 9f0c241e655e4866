// SPDX-License-Identifier: Apache-2.0
// A plane programmed detonation against a rigid rear wall: PETN at 1.32 g/cm3, D = 6690 m/s, P_CJ = 16 GPa.
#include "../core_helpers.h"

using namespace brisance;
using namespace brisance::core_test;

TEST(Detonation, PlaneChargeOnARigidWall) {
    const Material petn = library("petn_1320_cj");
    const double D = 6.69, P_CJ = 16, d = 0.05;
    const int n = 300;
    FluidPart f = fluid(petn, {}, {d, n, 1, 1});
    for (std::size_t i = 0; i < f.body.mass.size(); ++i) f.body.lit[i] = f.body.x[0][i] / D;
    Tube tube(f.body, d, 3 * d);
    tube.platens.push_back(Platen{{0, 0, 0}, {-1, 0, 0}});
    const double start = tube.sums().internal;

    std::vector<std::pair<double, double>> fronts;  // time, where the pressure rises through half of P_CJ
    double peak = 0;
    for (const double share : {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
        tube.run(share * n * d / D, 0.3, 0.25 * d / D);
        std::vector<std::pair<double, double>> pressure;
        peak = 0;
        for (std::size_t i = 0; i < tube.size(); ++i) {
            pressure.emplace_back(tube.b.x[0][i], tube.b.pressure[i]);
            peak = std::max(peak, tube.b.pressure[i]);
        }
        fronts.emplace_back(tube.time, front(pressure, 0.5 * P_CJ));
        std::printf("detonation at t = %.3f us: front at %.3f mm (Dt = %.3f), peak %.2f GPa\n", tube.time, fronts.back().second, D * tube.time, peak);
        EXPECT_NEAR(fronts.back().second, D * tube.time, 3 * d);
    }
    const double speed = (fronts.back().second - fronts.front().second) / (fronts.back().first - fronts.front().first);
    std::printf("detonation speed %.1f m/s (6690), peak pressure %.2f GPa (16.00)\n", 1e3 * speed, peak);
    EXPECT_NEAR(speed, D, 0.01 * D);
    EXPECT_NEAR(peak, P_CJ, 0.1 * P_CJ);

    // the products at rest behind the Taylor wave: 0.3022 of P_CJ within half of D t (JWL, by integration along the isentrope)
    const double length = D * tube.time;
    const double plateau = tube.mean(0.1 * length, 0.4 * length, [&](std::size_t i) { return tube.b.pressure[i]; });
    std::printf("plateau behind the Taylor wave %.3f GPa (4.84)\n", plateau);
    EXPECT_NEAR(plateau, 0.3022 * P_CJ, 0.05 * 0.3022 * P_CJ);
    EXPECT_NEAR(tube.mean(0.1 * length, 0.4 * length, [&](std::size_t i) { return tube.b.v[0][i]; }), 0, 0.03);

    // burn out: all of E0 is there, as heat, motion and the work at the wall (which is none)
    tube.run(1.05 * n * d / D, 0.3, 0.25 * d / D);
    double released = 0;
    for (std::size_t i = 0; i < tube.size(); ++i) released += tube.b.mass[i] * 7.38 / 1.32 * tube.b.burnt[i];
    EXPECT_NEAR(released, 7.38 * n * d * d * d, 1e-12 * released);  // E0 times volume
    const BodySums end = tube.sums();
    EXPECT_NEAR(end.kinetic + end.internal, start + tube.work, 1e-11 * start);
    EXPECT_NEAR(end.px, tube.impulse, 1e-11 * tube.impulse);
}
