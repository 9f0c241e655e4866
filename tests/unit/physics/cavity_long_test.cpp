// SPDX-License-Identifier: Apache-2.0
// The most relevant elastic test: a borehole in granite under a step of pressure (Selberg 1952), and a thick ring at rest.
// The cloud, its walls and the loads are those of a run.
#include "../core_helpers.h"
#include "geometry/placement.h"

using namespace brisance;
using namespace brisance::core_test;

namespace {

constexpr double a = 3.225, c = 4.54303, p0 = 0.1;  // mm, mm/us, GPa

World<double> pressed_ring(double outer, double spacing, double far, double growth, const SolidOptions& o, double rise, double pressure) {
    PlacementOptions p;
    p.spacing = spacing;
    p.spacing_far = far;
    p.grading_radius = a;
    p.grading_growth = growth;
    p.spacing_z = spacing;
    p.slice = true;
    p.z_high = spacing;
    const Placement placement = place(*make_annulus({0, 0, -100}, {0, 0, 100}, a, outer), {}, p);
    World<double> w;
    w.solids.push_back(solid(elastic_granite(), o, placement.columns, placement.dz, true));
    w.period = placement.dz;
    SolidPart<double>& s = w.solids[0];
    s.loads.push_back(make_wall_pressure(s.body, s.surface, *make_cylinder({0, 0, -100}, {0, 0, 100}, a + 0.5 * spacing), {0, rise}, {0, pressure}));
    return w;
}

struct Polar {
    double u = 0, sigma_r = 0, sigma_t = 0, n = 0;
};
/// Means around the hole at a radius, of particles within half a width; each value is carried to the radius along the static field.
Polar around(const SolidPart<double>& part, double r, double half_width) {
    const SolidBody<double>& b = part.body;
    const std::vector<Sym3<double>> deviator = deviators(part);
    Polar out;
    each(b, [&](std::size_t i, const Column& column, Vec3<double>) {
        const double at = std::hypot(column.x, column.y);
        if (std::abs(at - r) > half_width) return;
        const double nx = column.x / at, ny = column.y / at;
        const Sym3<double>& d = deviator[i];
        const double rr = d.xx * nx * nx + d.yy * ny * ny + 2 * d.xy * nx * ny, tt = d.xx * ny * ny + d.yy * nx * nx - 2 * d.xy * nx * ny;
        out.u += b.u[0][i] * nx + b.u[1][i] * ny;
        out.sigma_r += rr - b.pressure[i];
        out.sigma_t += tt - b.pressure[i];
        ++out.n;
    });
    return {out.u / out.n, out.sigma_r / out.n, out.sigma_t / out.n, out.n};
}

}  // namespace

TEST(Cavity, StepOfPressureInABorehole) {
    // Laplace-transform solution inverted numerically: radius/a, time since arrival times c/a, u in um, sigma_r and sigma_theta in MPa.
    struct Row { double r, tau, u, sigma_r, sigma_t; };
    const std::vector<Row> rows{{2, 1, 3.1509, -47.7209, 16.0747}, {2, 2, 4.5789, -31.4249, 31.0270}, {4, 1, 2.1276, -26.7002, 3.2862},
                                {4, 2, 2.9501, -11.1069, 9.7962},  {2, 4, 4.7457, -20.0712, 34.6839}, {4, 4, 2.7722, -1.0464, 11.1043}};
    const double spacing = a / 20, rise = 10 * spacing / c;  // its middle counts as the step's time
    SolidOptions o;
    o.linear = 0.06;
    o.quadratic = 1.5;
    World<double> w = pressed_ring(6.6 * a, spacing, 1.5 * spacing, 0.01, o, rise, p0);
    std::printf("cavity: %lld particles\n", static_cast<long long>(w.solids[0].body.layout.particles));
    begin(w);
    std::vector<Row> in_time = rows;
    const auto when = [&](const Row& r) { return 0.5 * rise + ((r.r - 1) * a + r.tau * a) / c; };
    std::sort(in_time.begin(), in_time.end(), [&](const Row& x, const Row& y) { return when(x) < when(y); });
    for (const Row& row : in_time) {
        run(w, when(row));
        const Polar q = around(w.solids[0], row.r * a, 0.75 * spacing);
        std::printf("cavity r/a = %g, tau = %g: u %.4f (%.4f) um %+.1f %%, sigma_r %.2f (%.2f) MPa, sigma_theta %.2f (%.2f) MPa\n", row.r, row.tau, 1e3 * q.u, row.u,
                    100 * (1e3 * q.u / row.u - 1), 1e3 * q.sigma_r, row.sigma_r, 1e3 * q.sigma_t, row.sigma_t);
        EXPECT_NEAR(1e3 * q.u, row.u, 0.05 * row.u);
        // of the largest stress that passes this radius: 70.7 and 50 MPa at the front of a step
        const double scale = p0 * 1e3 / std::sqrt(row.r);
        EXPECT_NEAR(1e3 * q.sigma_r, row.sigma_r, 0.05 * scale);
        EXPECT_NEAR(1e3 * q.sigma_t, row.sigma_t, 0.05 * scale);
    }
    const Audit audited = audit(w);
    EXPECT_LT(std::abs(audited.residual_relative), 1e-3);
}

TEST(Cavity, ThickRingAtRest) {
    // a = 3.225, b = 16 mm under p: Lame, plane strain. Velocities fade by the damping of the slowest ringing until all is at rest.
    const double b = 16, spacing = a / 12, G = 21.9, K = 25.7, lambda = K - 2.0 / 3 * G;
    World<double> w = pressed_ring(b, spacing, spacing, 0, {}, 0.5, p0);
    SolidBody<double>& body = w.solids[0].body;
    begin(w);
    while (w.time < 60) {
        step(w, 60);
        for (auto& v : body.v)
            for (double& x : v) x *= 1 - 0.5 * w.dt;
    }
    EXPECT_LT(sums(body).kinetic, 1e-6 * sums(body).internal);
    const double A = p0 * a * a / (b * b - a * a);
    for (const double r : {1.5 * a, 2 * a, 3 * a, 4 * a}) {
        const Polar q = around(w.solids[0], r, 0.75 * spacing);
        const double radial = A * (1 - b * b / (r * r)), hoop = A * (1 + b * b / (r * r)), u = A * r / (2 * (lambda + G)) + A * b * b / (2 * G * r);
        std::printf("ring r/a = %g: sigma_r %.2f (%.2f), sigma_theta %.2f (%.2f) MPa, u %.4f (%.4f) um\n", r / a, 1e3 * q.sigma_r, 1e3 * radial, 1e3 * q.sigma_t, 1e3 * hoop,
                    1e3 * q.u, 1e3 * u);
        EXPECT_NEAR(q.sigma_t, hoop, 0.03 * hoop);
        EXPECT_NEAR(q.sigma_r, radial, 0.03 * hoop);
        EXPECT_NEAR(q.u, u, 0.03 * u);
    }
}
