// SPDX-License-Identifier: Apache-2.0
// Gas dynamics in a tube: exact solutions of Riemann problems, and sound in air.
#include "../core_helpers.h"

using namespace brisance;
using namespace brisance::core_test;

TEST(Gas, SodsShockTube) {
    // (rho, P) = (1, 1) | (0.125, 0.1), gamma = 1.4, at t = 0.2: plateaus of the exact solution
    const double P = 0.30313, u = 0.927453, rho_left = 0.426319, rho_right = 0.265574, shock = 1.752156, t = 0.2;
    const int n = 400;
    const double d = 0.5 / n * 1.2;  // 0.6 on either side of the membrane
    // equal masses: the right lattice is twice as wide in every direction
    FluidPart left = fluid(ideal_gas(1.4, 1, 2.5), {}, {d, n, 2, 2, -n * d, 0, 0});
    FluidPart right = fluid(ideal_gas(1.4, 1, 2.5), {}, {2 * d, n / 2, 1, 1, 0, 0, 0});
    FluidBody b = left.body;
    resize(b, left.body.mass.size() + right.body.mass.size());
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
        const bool is_left = i < left.body.mass.size();
        const FluidBody& from = is_left ? left.body : right.body;
        const std::size_t k = is_left ? i : i - left.body.mass.size();
        for (std::size_t a = 0; a < 3; ++a) b.x[a][i] = from.x[a][k];
        b.mass[i] = d * d * d;
        b.rho[i] = is_left ? 1 : 0.125;
        b.e[i] = is_left ? 2.5 : 2;
    }
    Tube tube(b, 2 * d, 7 * d);
    const FluidSums start = tube.sums();
    tube.run(t, 0.3);
    const FluidSums end = tube.sums();
    EXPECT_NEAR(end.kinetic + end.internal, start.kinetic + start.internal, 1e-11 * start.internal);
    EXPECT_NEAR(end.py, 0, 1e-12);
    const double contact = u * t, front_at = shock * t, tail = -0.07027 * t;
    const auto plateau = [&](double low, double high, auto&& f, double want, const char* what) {
        const double have = tube.mean(low, high, f);
        std::printf("Sod: %s %.5f, exact %.5f, %+.2f %%\n", what, have, want, 100 * (have / want - 1));
        EXPECT_NEAR(have, want, 0.02 * want) << what;
    };
    const double m = 0.02;  // keep off the edges of the plateaus
    plateau(tail + m, contact - m, [&](std::size_t i) { return tube.b.rho[i]; }, rho_left, "density left of the contact");
    plateau(contact + m, front_at - m, [&](std::size_t i) { return tube.b.rho[i]; }, rho_right, "density right of the contact");
    plateau(tail + m, front_at - m, [&](std::size_t i) { return tube.b.pressure[i]; }, P, "pressure");
    plateau(tail + m, front_at - m, [&](std::size_t i) { return tube.b.v[0][i]; }, u, "speed");
    plateau(contact + m, front_at - m, [&](std::size_t i) { return tube.b.e[i]; }, 2.85354, "energy right of the contact");
    std::vector<std::pair<double, double>> pressure;
    for (std::size_t i = 0; i < tube.size(); ++i) pressure.emplace_back(tube.b.x[0][i], tube.b.pressure[i]);
    std::sort(pressure.begin(), pressure.end());
    const double where = front(pressure, 0.5 * (P + 0.1));
    std::printf("Sod: shock at %.4f, exact %.4f\n", where, front_at);
    EXPECT_NEAR(where, front_at, 3 * d);
}

TEST(Gas, SoundInAir) {
    // The air of the paper: c = sqrt(1.401 P/rho) = 334.54 m/s.
    const Material air = library("air_paper");
    const double d = 0.1, width = 1.5, c = 0.33454;
    FluidOptions weak;
    weak.alpha = 0.1;  // a sound wave is no shock
    FluidPart f = fluid(air, weak, {d, 500, 1, 1});
    const double height = 1e-3 * c;
    for (std::size_t i = 0; i < f.body.mass.size(); ++i) f.body.v[0][i] = height * std::exp(-sq((f.body.x[0][i] - 20) / width));
    Tube tube(f.body, d, 4 * d);
    const auto centre = [&] {
        double sum = 0, at = 0;
        for (std::size_t i = 0; i < tube.size(); ++i)
            if (tube.b.x[0][i] > 22.5 && tube.b.x[0][i] < 45) {
                sum += tube.b.v_now[0][i];
                at += tube.b.v_now[0][i] * tube.b.x[0][i];
            }
        return at / sum;
    };
    tube.run(20, 0.3);
    const double x1 = centre();
    tube.run(45, 0.3);
    const double speed = (centre() - x1) / 25;
    std::printf("sound in air %.2f m/s, exact 334.54 m/s\n", 1e3 * speed);
    EXPECT_NEAR(speed, c, 0.01 * c);
    // and air that nothing disturbs keeps its pressure
    EXPECT_NEAR(tube.mean(45.5, 46, [&](std::size_t i) { return tube.b.pressure[i]; }), 0.401 * 2.5e-4, 1e-3 * 0.401 * 2.5e-4);
}
