// SPDX-License-Identifier: Apache-2.0
#include "contact/stiffness.h"

#include <algorithm>
#include <cmath>

namespace brisance {

ContactReport node_contact(const FluidBody& a, const FluidBody& b, const ContactOptions& o, FluidForces& fa, FluidForces& fb) {
    struct Side {
        const FluidBody& body;
        FluidForces& f;
        CellGrid grid;
        Mirrored points;
    };
    static CellGrid kept[2];
    static Mirrored kept_points[2];
    Side sides[2] = {{a, fa, std::move(kept[0]), std::move(kept_points[0])}, {b, fb, std::move(kept[1]), std::move(kept_points[1])}};
    const double largest = std::max(fa.largest_spacing, fb.largest_spacing);
    for (Side& s : sides) {
        s.points.build(s.body, largest);
        s.grid.build(s.points.place(0), s.points.place(1), s.points.place(2), s.points.size(), largest, largest, s.body.z_low, s.body.period);
    }

    struct Acc {
        double stored = 0, overlap = 0;
        std::int64_t touching = 0;
        Acc& operator+=(const Acc& o2) {
            stored += o2.stored;
            overlap = std::max(overlap, o2.overlap);
            touching += o2.touching;
            return *this;
        }
    };
    ContactReport report;
    for (int m = 0; m < 2; ++m) {
        Side &me = sides[m], &other = sides[1 - m];
        const Acc acc = exec::sum(me.body.size(), Acc{}, [&](std::int64_t n) {
            const auto i = static_cast<std::size_t>(n);
            const FluidBody &p = me.body, &q = other.body;
            Acc local;
            double fx = 0, fy = 0, fz = 0;
            other.grid.ranges(p.x[0][i], p.x[1][i], p.x[2][i], largest, [&](std::int64_t first, std::int64_t last) {
                for (std::int64_t k = first; k < last; ++k) {
                    const auto point = static_cast<std::size_t>(other.grid.index(k)), j = other.points.particle(point);
                    const double dx = p.x[0][i] - other.points.place(0)[point], dy = p.x[1][i] - other.points.place(1)[point],
                                 dz = p.x[2][i] - other.points.place(2)[point] - other.grid.shift(k);
                    const double r2 = dx * dx + dy * dy + dz * dz, d = 0.5 * (me.f.spacing[i] + other.f.spacing[j]);
                    if (r2 >= d * d || r2 < 1e-24) continue;
                    const double r = std::sqrt(r2), overlap = d - r, deep = overlap / d;
                    const double m_star = series(p.mass[i], q.mass[j]);
                    const double stiffness = o.stiffness * std::max(4 * series(me.f.modulus[i], other.f.modulus[j]) * d, hardest(m_star, o));
                    // progressive: k (1 + 3 (overlap/d)^2)
                    const double spring = stiffness * overlap * (1 + 3 * deep * deep);
                    const auto velocity = [&](std::size_t axis) { return p.v_now[axis][i] - other.points.sign(point, axis) * q.v_now[axis][j]; };
                    const double vn = (velocity(0) * dx + velocity(1) * dy + velocity(2) * dz) / r;
                    const double force = std::max(spring - 2 * o.damping * std::sqrt(stiffness * m_star) * vn, 0.0) / r;
                    fx += force * dx;
                    fy += force * dy;
                    fz += force * dz;
                    local.stored += 0.5 * stiffness * overlap * overlap * (1 + 1.5 * deep * deep);
                    local.overlap = std::max(local.overlap, overlap);
                    ++local.touching;
                }
            });
            me.f.fx[i] += fx;
            me.f.fy[i] += fy;
            me.f.fz[i] += fz;
            return local;
        });
        report.stored += 0.5 * acc.stored;
        report.penetration = std::max(report.penetration, acc.overlap);
        report.touching = acc.touching;
    }
    for (int m = 0; m < 2; ++m) {
        kept[m] = std::move(sides[m].grid);
        kept_points[m] = std::move(sides[m].points);
    }
    return report;
}

}  // namespace brisance
