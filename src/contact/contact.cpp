// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include "math/kernel.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

double series(double a, double b) { return a * b / std::max(a + b, 1e-12); }

/// The hardest spring that the step bears, for a reduced mass; GPa mm.
double hardest(double m_star, const ContactOptions& o) { return o.dt > 0 ? 0.1 * m_star / (o.dt * o.dt) : 0.0; }

/// The nodes of one side, whatever they belong to.
struct Nodes {
    const double *x, *y, *z, *vx, *vy, *vz;
    std::int64_t n;
    // per node
    std::vector<double> radius, area, length, modulus, mass, hard;
    bool oriented = false;                    ///< surface points: they have normals, and touch only walls that face them
    const double *nx = nullptr, *ny = nullptr, *nz = nullptr;
    double *fx, *fy, *fz;
};

/// What node i feels of the wall: force and the normaliser of its weights.
struct Touch {
    double fx = 0, fy = 0, fz = 0, weights = 0, stored = 0, overlap = 0;
};

/// omega_ij, 0 out of reach; `gap` is set.
inline double weight(const Surface& s, std::size_t j, double px, double py, double pz, double radius, double& gap) {
    const double dx = px - s.x[j], dy = py - s.y[j], dz = pz - s.z[j];
    gap = dx * s.nx[j] + dy * s.ny[j] + dz * s.nz[j];
    if (gap > radius + s.spacing[j] || gap < -s.depth[j]) return 0;
    const double tx = dx - gap * s.nx[j], ty = dy - gap * s.ny[j], tz = dz - gap * s.nz[j];
    const double q2 = (tx * tx + ty * ty) / (s.spacing[j] * s.spacing[j]) + tz * tz / (s.dz[j] * s.dz[j]);
    return q2 < 4 ? s.area[j] * kernel::shape(std::sqrt(q2)) : 0.0;
}

/// The points of a wall inside the box of the nodes, widened by what they reach.
std::vector<std::int32_t> points_near(const Nodes& nodes, const Surface& wall, double radius) {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (std::int64_t i = 0; i < nodes.n; ++i)
        for (int k = 0; k < 2; ++k) {
            const double p = k == 0 ? nodes.x[i] : nodes.y[i];
            low[k] = std::min(low[k], p);
            high[k] = std::max(high[k], p);
        }
    std::vector<std::int32_t> active;
    for (std::size_t j = 0; j < wall.size(); ++j) {
        const double margin = radius + wall.depth[j] + 2 * wall.spacing[j];
        if (wall.x[j] > low[0] - margin && wall.x[j] < high[0] + margin && wall.y[j] > low[1] - margin && wall.y[j] < high[1] + margin)
            active.push_back(static_cast<std::int32_t>(j));
    }
    return active;
}

ContactReport against_wall(Nodes& nodes, Surface& wall, const ContactOptions& o, double z_low, double period) {
    double radius = 0;
    for (double r : nodes.radius) radius = std::max(radius, r);
    // only the part of the wall that the nodes can meet: a rim far away has coarser points and would widen the search
    const std::vector<std::int32_t> active = points_near(nodes, wall, radius);
    if (active.empty()) return {};
    double coarsest = 0, deepest = 0;
    std::vector<double> wx, wy, wz;
    for (std::int32_t j : active) {
        const auto p = static_cast<std::size_t>(j);
        coarsest = std::max({coarsest, wall.spacing[p], wall.dz[p]});
        deepest = std::max(deepest, wall.depth[p]);
        wx.push_back(wall.x[p]);
        wy.push_back(wall.y[p]);
        wz.push_back(wall.z[p]);
    }
    // tangential reach, and how far in front of or behind the wall a node can be
    const double reach = 2 * coarsest + std::max(deepest, radius + coarsest);
    const double near = std::max(deepest, radius) + coarsest;
    static CellGrid walls, points;  // kept between steps for their memory; contact is not re-entrant
    walls.build(wx.data(), wy.data(), wz.data(), static_cast<std::int64_t>(active.size()), coarsest, reach, z_low, period);
    std::vector<Touch> touch(static_cast<std::size_t>(nodes.n));
    // omega_ij of node i, moved by `shift` along z, and point j: both passes below take it
    const auto omega = [&](std::size_t i, std::size_t j, double shift, double& gap) {
        const bool away = nodes.oriented && nodes.nx[i] * wall.nx[j] + nodes.ny[i] * wall.ny[j] + nodes.nz[i] * wall.nz[j] > -0.3;
        return away ? 0.0 : weight(wall, j, nodes.x[i], nodes.y[i], nodes.z[i] + shift, nodes.radius[i], gap);
    };

    exec::for_each(nodes.n, [&](std::int64_t n) {
        const auto i = static_cast<std::size_t>(n);
        Touch& t = touch[i];
        // most nodes are far from the wall: is any point of it near, with the node not well in front?
        bool close = false;
        walls.ranges(nodes.x[i], nodes.y[i], nodes.z[i], near, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last && !close; ++k) {
                const auto j = static_cast<std::size_t>(active[static_cast<std::size_t>(walls.index(k))]);
                const double dx = nodes.x[i] - wall.x[j], dy = nodes.y[i] - wall.y[j], dz = nodes.z[i] - walls.shift(k) - wall.z[j];
                close = dx * dx + dy * dy + dz * dz < near * near && dx * wall.nx[j] + dy * wall.ny[j] + dz * wall.nz[j] < 1.5 * nodes.radius[i] + 0.25 * wall.spacing[j];
            }
        });
        if (!close) return;
        double gap_sum = 0, nx = 0, ny = 0, nz = 0, vx = 0, vy = 0, vz = 0, modulus = 0;
        walls.ranges(nodes.x[i], nodes.y[i], nodes.z[i], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const auto j = static_cast<std::size_t>(active[static_cast<std::size_t>(walls.index(k))]);
                double gap;
                const double w = omega(i, j, -walls.shift(k), gap);
                if (w == 0) continue;
                t.weights += w;
                gap_sum += w * gap;
                nx += w * wall.nx[j];
                ny += w * wall.ny[j];
                nz += w * wall.nz[j];
                vx += w * wall.vx[j];
                vy += w * wall.vy[j];
                vz += w * wall.vz[j];
                modulus += w * wall.modulus[j];
            }
        });
        if (!(t.weights > 0)) return;
        const double overlap = nodes.radius[i] - gap_sum / t.weights;
        if (!(overlap > 0)) {
            t.weights = 0;
            return;
        }
        const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
        nx /= length;
        ny /= length;
        nz /= length;
        const double wx = nodes.vx[i] - vx / t.weights, wy = nodes.vy[i] - vy / t.weights, wz = nodes.vz[i] - vz / t.weights;
        const double approach = wx * nx + wy * ny + wz * nz;
        const double k = o.stiffness * std::max(series(nodes.modulus[i], modulus / t.weights) * nodes.area[i] / nodes.length[i], nodes.hard[i]);
        const double damping = 2 * o.damping * std::sqrt(k * nodes.mass[i]);
        // progressive up to where the node stands on the wall: k (1 + (overlap/radius)^2), then 2 k
        const double deep = nodes.radius[i] > 0 ? std::min(overlap / nodes.radius[i], 1.0) : 0.0, spring = k * overlap * (1 + deep * deep);
        const double force = std::max(spring - damping * approach, 0.0);
        t.fx = force * nx;
        t.fy = force * ny;
        t.fz = force * nz;
        if (o.friction > 0) {
            // Coulomb, regularised over a slip speed of 1 m/s
            const double sx = wx - approach * nx, sy = wy - approach * ny, sz = wz - approach * nz;
            const double slip = std::sqrt(sx * sx + sy * sy + sz * sz), grip = o.friction * force / std::max(slip, 1e-3);
            t.fx -= grip * sx;
            t.fy -= grip * sy;
            t.fz -= grip * sz;
        }
        const double bent = std::min(overlap, nodes.radius[i]);
        t.stored = 0.5 * k * (overlap * overlap * (1 + deep * deep) - 0.5 * deep * deep * bent * bent);
        t.overlap = overlap;
        nodes.fx[i] += t.fx;
        nodes.fy[i] += t.fy;
        nodes.fz[i] += t.fz;
    });

    ContactReport report;
    std::vector<std::int32_t> touching;
    for (std::int64_t n = 0; n < nodes.n; ++n)
        if (touch[static_cast<std::size_t>(n)].weights > 0) touching.push_back(static_cast<std::int32_t>(n));
    for (std::int32_t n : touching) {
        const Touch& t = touch[static_cast<std::size_t>(n)];
        report.stored += t.stored;
        report.penetration = std::max(report.penetration, t.overlap);
    }
    report.touching = static_cast<std::int64_t>(touching.size());
    if (touching.empty()) return report;

    // Reactions, gathered by the wall's points with the same weights, from the nodes that touch.
    std::vector<double> x, y, z;
    for (std::int32_t n : touching) {
        x.push_back(nodes.x[n]);
        y.push_back(nodes.y[n]);
        z.push_back(nodes.z[n]);
    }
    points.build(x.data(), y.data(), z.data(), static_cast<std::int64_t>(touching.size()), coarsest, reach, z_low, period);
    exec::for_each(static_cast<std::int64_t>(active.size()), [&](std::int64_t m) {
        const auto j = static_cast<std::size_t>(active[static_cast<std::size_t>(m)]);
        points.ranges(wall.x[j], wall.y[j], wall.z[j], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const auto i = static_cast<std::size_t>(touching[static_cast<std::size_t>(points.index(k))]);
                const Touch& t = touch[i];
                double gap;
                const double w = omega(i, j, points.shift(k), gap);
                if (w == 0) continue;
                wall.fx[j] -= w / t.weights * t.fx;
                wall.fy[j] -= w / t.weights * t.fy;
                wall.fz[j] -= w / t.weights * t.fz;
            }
        });
    });

    return report;
}

}  // namespace

void FluidForces::begin(const FluidBody& body) {
    const std::size_t n = body.mass.size();
    for (auto* a : {&fx, &fy, &fz}) a->assign(n, 0);
    spacing.resize(n);
    modulus.resize(n);
    exec::for_each(body.size(), [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        spacing[i] = body.current_spacing(i);
        modulus[i] = std::max(body.rho_now[i] * body.sound[i] * body.sound[i], 1e-9);
    }, 1024);
    largest_spacing = 0;
    for (double s : spacing) largest_spacing = std::max(largest_spacing, s);
}

ContactReport wall_contact(const FluidBody& a, Surface& s, const ContactOptions& o, double z_low, double period, FluidForces& fa) {
    Nodes n{a.x[0].data(), a.x[1].data(), a.x[2].data(), a.v_now[0].data(), a.v_now[1].data(), a.v_now[2].data(), a.size(), {}, {}, {}, {}, {}, {},
            false, nullptr, nullptr, nullptr, fa.fx.data(), fa.fy.data(), fa.fz.data()};
    for (double kappa : fa.spacing) {
        n.radius.push_back(0.5 * kappa);
        n.area.push_back(kappa * kappa);
        n.length.push_back(0.125 * kappa);  // stiff enough that a gas does not gain volume: overlap = kappa/8 P/(rho c^2)
    }
    n.modulus = fa.modulus;
    n.mass.assign(a.mass.begin(), a.mass.end());
    for (double m : a.mass) n.hard.push_back(hardest(m, o));
    return against_wall(n, s, o, z_low, period);
}

ContactReport surface_contact(Surface& nodes, Surface& wall, const ContactOptions& o, double z_low, double period) {
    Nodes n{nodes.x.data(), nodes.y.data(), nodes.z.data(), nodes.vx.data(), nodes.vy.data(), nodes.vz.data(), static_cast<std::int64_t>(nodes.size()),
            std::vector<double>(nodes.size(), 0.0), nodes.area, nodes.spacing, nodes.modulus, nodes.mass, std::vector<double>(nodes.size(), 0.0),
            true, nodes.nx.data(), nodes.ny.data(), nodes.nz.data(), nodes.fx.data(), nodes.fy.data(), nodes.fz.data()};
    return against_wall(n, wall, o, z_low, period);
}

double clearance(const double* ax, const double* ay, const double* az, std::int64_t na, const double* bx, const double* by, const double* bz,
                 std::int64_t nb, double range, double horizon, double z_low, double period) {
    const double reach = range + horizon;
    static CellGrid grid;
    grid.build(bx, by, bz, nb, 0.5 * reach, reach, z_low, period);
    const double nearest = -exec::max(na, -reach, [&](std::int64_t n) {
        double least = reach * reach;
        grid.ranges(ax[n], ay[n], az[n], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const std::int64_t j = grid.index(k);
                const double dx = ax[n] - bx[j], dy = ay[n] - by[j], dz = az[n] - bz[j] - grid.shift(k);
                least = std::min(least, dx * dx + dy * dy + dz * dz);
            }
        });
        return -std::sqrt(least);
    });
    return std::max(0.0, nearest - range);
}

ContactReport node_contact(const FluidBody& a, const FluidBody& b, const ContactOptions& o, FluidForces& fa, FluidForces& fb) {
    struct Side {
        const FluidBody& body;
        FluidForces& f;
        CellGrid grid;
    };
    static CellGrid kept[2];
    Side sides[2] = {{a, fa, std::move(kept[0])}, {b, fb, std::move(kept[1])}};
    const double largest = std::max(fa.largest_spacing, fb.largest_spacing);
    for (Side& s : sides)
        s.grid.build(s.body.x[0].data(), s.body.x[1].data(), s.body.x[2].data(), s.body.size(), largest, largest, s.body.z_low, s.body.period);

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
                    const auto j = static_cast<std::size_t>(other.grid.index(k));
                    const double dx = p.x[0][i] - q.x[0][j], dy = p.x[1][i] - q.x[1][j], dz = p.x[2][i] - q.x[2][j] - other.grid.shift(k);
                    const double r2 = dx * dx + dy * dy + dz * dz, d = 0.5 * (me.f.spacing[i] + other.f.spacing[j]);
                    if (r2 >= d * d || r2 < 1e-24) continue;
                    const double r = std::sqrt(r2), overlap = d - r, deep = overlap / d;
                    const double m_star = series(p.mass[i], q.mass[j]);
                    const double stiffness = o.stiffness * std::max(4 * series(me.f.modulus[i], other.f.modulus[j]) * d, hardest(m_star, o));
                    // progressive: k (1 + 3 (overlap/d)^2)
                    const double spring = stiffness * overlap * (1 + 3 * deep * deep);
                    const double vn = ((p.v_now[0][i] - q.v_now[0][j]) * dx + (p.v_now[1][i] - q.v_now[1][j]) * dy +
                                       (p.v_now[2][i] - q.v_now[2][j]) * dz) / r;
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
    for (int m = 0; m < 2; ++m) kept[m] = std::move(sides[m].grid);
    return report;
}

}  // namespace brisance
