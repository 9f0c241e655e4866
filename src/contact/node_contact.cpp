// SPDX-License-Identifier: Apache-2.0
#include "contact/stiffness.h"
#include "exec/launch.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

struct Touched {
    double stored = 0, overlap = 0;
    std::int64_t touching = 0;
    BRISANCE_HD Touched& operator+=(const Touched& o) {
        stored += o.stored;
        overlap = std::max(overlap, o.overlap);
        touching += o.touching;
        return *this;
    }
};

/// One of the two fluids.
struct Side {
    FluidView body;
    const double *spacing, *modulus;
    double* f[3];
    CellGridView grid;
    MirroredView points;
};
Side side(const FluidBody& b, FluidForces& f, CellGrid& grid, Mirrored& points, double largest) {
    points.build(b, largest);
    grid.build(points.place(0), points.place(1), points.place(2), points.size(), largest, largest, b.z_low, b.period);
    return {view(b), f.spacing.data(), f.modulus.data(), {f.fx.data(), f.fy.data(), f.fz.data()}, grid.view(), points.view()};
}

/// What a particle of one side feels of the other.
struct NodeKernel {
    Side me, other;
    double largest;
    ContactOptions o;
    BRISANCE_HD Touched operator()(std::int64_t i) const {
        const FluidView &p = me.body, &q = other.body;
        Touched local;
        double f[3] = {0, 0, 0};
        other.grid.ranges(p.x[0][i], p.x[1][i], p.x[2][i], largest, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const std::int64_t point = other.grid.index[k], j = other.points.particle(point);
                const double dx = p.x[0][i] - other.points.place[0][point], dy = p.x[1][i] - other.points.place[1][point],
                             dz = p.x[2][i] - other.points.place[2][point] - other.grid.shift[k];
                const double r2 = dx * dx + dy * dy + dz * dz, d = 0.5 * (me.spacing[i] + other.spacing[j]);
                if (r2 >= d * d || r2 < 1e-24) continue;
                const double r = std::sqrt(r2), overlap = d - r, deep = overlap / d;
                const double m_star = series(p.mass[i], q.mass[j]);
                const double stiffness = o.stiffness * std::max(4 * series(me.modulus[i], other.modulus[j]) * d, hardest(m_star, o));
                // progressive: k (1 + 3 (overlap/d)^2)
                const double spring = stiffness * overlap * (1 + 3 * deep * deep);
                const auto velocity = [&](int axis) { return p.v_now[axis][i] - other.points.sign(point, axis) * q.v_now[axis][j]; };
                const double vn = (velocity(0) * dx + velocity(1) * dy + velocity(2) * dz) / r;
                const double force = std::max(spring - 2 * o.damping * std::sqrt(stiffness * m_star) * vn, 0.0) / r;
                f[0] += force * dx;
                f[1] += force * dy;
                f[2] += force * dz;
                local.stored += 0.5 * stiffness * overlap * overlap * (1 + 1.5 * deep * deep);
                local.overlap = std::max(local.overlap, overlap);
                ++local.touching;
            }
        });
        for (int a = 0; a < 3; ++a) me.f[a][i] += f[a];
        return local;
    }
};

}  // namespace

ContactReport node_contact(const FluidBody& a, const FluidBody& b, const ContactOptions& o, FluidForces& fa, FluidForces& fb) {
    static CellGrid grids[2];  // kept for their memory; contact is not re-entrant
    static Mirrored points[2];
    const double largest = std::max(fa.largest_spacing, fb.largest_spacing);
    const Side sides[2] = {side(a, fa, grids[0], points[0], largest), side(b, fb, grids[1], points[1], largest)};
    ContactReport report;
    for (int m = 0; m < 2; ++m) {
        const Touched t = exec::launch_sum(sides[m].body.n, Touched{}, NodeKernel{sides[m], sides[1 - m], largest, o});
        report.stored += 0.5 * t.stored;
        report.penetration = std::max(report.penetration, t.overlap);
        report.touching = t.touching;
    }
    return report;
}

}  // namespace brisance
