// SPDX-License-Identifier: Apache-2.0
// Gas dynamics in a tube: exact solutions of Riemann problems, and sound in air.
#include "../core_helpers.h"

using namespace brisance;
using namespace brisance::core_test;

TEST(Gas, SodsShockTube) {
    // (rho, P) = (1, 1) | (0.125, 0.1), gamma = 1.4, at t = 0.2: plateaus of the exact solution
    const double P = 0.30313, u = 0.927453, rho_left = 0.426319, rho_right = 0.265574, shock = 1.752156, t = 0.2;
    // Rows of particles stay rows in a plane flow, and an isotropic kernel sees up to a third too little of div v once a cell is more than
    // 1.7 times as long as wide. So the cells start such that they end as much too long as they begin too short; equal masses.
    const int n = 300;
    const double s = 0.6 / (0.65 * n), cell = 0.65 * s;  // left: cell, s, s; right: 4 cells, s, 2 s
    FluidPart f = fluid(ideal_gas(1.4, 1, 2.5), {}, {s, 1, 1, 1});
    FluidBody b = f.body;
    b.spacing = std::cbrt(cell * s * s);
    b.period = 2 * s;
    resize(b, static_cast<std::size_t>(4 * n + 2 * (n / 4)));
    std::size_t k = 0;
    const auto add = [&](double x, double y, double z, double rho, double e) {
        b.x[0][k] = x;
        b.x[1][k] = y;
        b.x[2][k] = z;
        b.mass[k] = cell * s * s;
        b.rho[k] = rho;
        b.e[k] = e;
        ++k;
    };
    for (int i = 0; i < n; ++i)
        for (double y : {0.5 * s, 1.5 * s}) {
            for (double z : {0.5 * s, 1.5 * s}) add((i + 0.5 - n) * cell, y, z, 1, 2.5);
            if (i < n / 4) add((4 * i + 2) * cell, y, s, 0.125, 2);
        }
    Tube tube(b, 2 * s, 5.6 * 1.3 * b.spacing);
    const BodySums start = tube.sums();
    tube.run(t, 0.3);
    const BodySums end = tube.sums();
    EXPECT_NEAR(end.kinetic + end.internal, start.kinetic + start.internal, 1e-11 * start.internal);
    EXPECT_NEAR(end.py, start.py, 1e-12);
    const double contact = u * t, front_at = shock * t, tail = -0.07027 * t;
    const auto plateau = [&](double low, double high, auto&& f, double want, const char* what) {
        const double have = tube.mean(low, high, f);
        std::printf("Sod: %s %.5f, exact %.5f, %+.2f %%\n", what, have, want, 100 * (have / want - 1));
        EXPECT_NEAR(have, want, 0.02 * want) << what;
    };
    const double off = 0.03;  // keep off the edges of the plateaus
    plateau(tail + off, contact - off, [&](std::size_t i) { return tube.b.rho[i]; }, rho_left, "density left of the contact");
    plateau(contact + off, front_at - off, [&](std::size_t i) { return tube.b.rho[i]; }, rho_right, "density right of the contact");
    plateau(tail + off, front_at - off, [&](std::size_t i) { return tube.b.pressure[i]; }, P, "pressure");
    plateau(tail + off, front_at - off, [&](std::size_t i) { return tube.b.v[0][i]; }, u, "speed");
    plateau(contact + off, front_at - off, [&](std::size_t i) { return tube.b.e[i]; }, 2.85354, "energy right of the contact");
    std::vector<std::pair<double, double>> pressure;
    for (std::size_t i = 0; i < tube.size(); ++i) pressure.emplace_back(tube.b.x[0][i], tube.b.pressure[i]);
    std::sort(pressure.begin(), pressure.end());
    const double where = front(pressure, 0.5 * (P + 0.1));
    std::printf("Sod: shock at %.4f, exact %.4f\n", where, front_at);
    EXPECT_NEAR(where, front_at, 4 * cell);  // the spacing of the gas it runs into
}

namespace {

double speed_of_a_pulse(double smoothing) {
    const double d = 0.1, width = 1.5, c = 0.33454;
    FluidOptions weak;
    weak.smoothing = smoothing;
    weak.alpha = 0.1;  // a sound wave is no shock
    FluidPart f = fluid(library("air_paper"), weak, {d, 500, 1, 1});  // its ends are open: what starts there stays behind the pulse
    for (std::size_t i = 0; i < f.body.mass.size(); ++i) f.body.v[0][i] = 1e-3 * c * std::exp(-sq((f.body.x[0][i] - 20) / width));
    Tube tube(f.body, d, 2.05 * smoothing * d);
    const auto centre = [&] {
        double sum = 0, at = 0;
        for (std::size_t i = 0; i < tube.size(); ++i)
            if (tube.b.x[0][i] > 20 && tube.b.x[0][i] < 36) {
                sum += tube.b.v_now[0][i];
                at += tube.b.v_now[0][i] * tube.b.x[0][i];
            }
        return at / sum;
    };
    tube.run(14, 0.3);
    const double x1 = centre();
    tube.run(22, 0.3);
    // and air that nothing has disturbed yet keeps its pressure
    EXPECT_NEAR(tube.mean(34, 36, [&](std::size_t i) { return tube.b.pressure[i]; }), 0.401 * 2.5e-4, 1e-6 * 0.401 * 2.5e-4);
    return (centre() - x1) / 8;
}

}  // namespace

TEST(Gas, SoundInAir) {
    // The air of the paper: c = sqrt(1.401 P/rho) = 334.54 m/s, whatever h is. With plain gradients h = 1.3 spacings would carry it 4 % too
    // fast: a gas feels the lattice more than a liquid, since its own pressure is most of its stiffness.
    for (const double smoothing : {1.2, 1.3, 1.8}) {
        const double speed = speed_of_a_pulse(smoothing);
        std::printf("sound in air, h = %g spacings: %.2f m/s, air 334.54 m/s\n", smoothing, 1e3 * speed);
        EXPECT_NEAR(speed, 0.33454, 0.005 * 0.33454);
    }
}
