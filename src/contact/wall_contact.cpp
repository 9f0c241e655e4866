// SPDX-License-Identifier: Apache-2.0
#include "contact/stiffness.h"
#include "math/kernel.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

using V = Pack<double>;
constexpr int width = lanes<double>;
alignas(64) constexpr double lane_number[8] = {0, 1, 2, 3, 4, 5, 6, 7};

/// The nodes of one side, whatever they belong to.
struct Nodes {
    const double *x, *y, *z, *vx, *vy, *vz;
    std::int64_t n;
    // per node
    std::vector<double> radius, area, length, modulus, mass, hard;
    const double *nx = nullptr, *ny = nullptr, *nz = nullptr;  ///< surface points have normals, and touch only walls that face them
    double *fx, *fy, *fz;
};

/// What node i feels of the wall: force and the normaliser of its weights.
struct Touch {
    double fx = 0, fy = 0, fz = 0, weights = 0, stored = 0, overlap = 0;
};

/// Columns of numbers in the order of a grid's entries, with a pack of room behind the last.
template <int n>
class Sorted {
public:
    /// column c of entry k: value(c, k)
    template <class F>
    void fill(const CellGrid& grid, F&& value) {
        const auto entries = static_cast<std::size_t>(grid.entries());
        for (Array<double>& a : columns_) a.assign(entries + static_cast<std::size_t>(width), 0.0);
        for (std::size_t k = 0; k < entries; ++k)
            for (int c = 0; c < n; ++c) columns_[static_cast<std::size_t>(c)][k] = value(c, static_cast<std::int64_t>(k));
    }
    V operator()(int c, std::int64_t k) const { return load<V>(&columns_[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)]); }

private:
    std::array<Array<double>, n> columns_;
};

/// A point of the wall, or a pack of them: place, normal, shape of its kernel, and how far behind it a node is still pushed back.
struct WallPoint {
    Vec3<V> at, normal;
    V spacing, dz, depth, area;
};

/// omega_ij, 0 out of reach; `gap` is set. `facing`: the product of the two normals, where a node has one.
inline V weight(const WallPoint& s, const Vec3<V>& node, V radius, V facing, V& gap) {
    const Vec3<V> d = node - s.at;
    gap = dot(d, s.normal);
    const Vec3<V> t = d - gap * s.normal;
    const V q2 = (t.x * t.x + t.y * t.y) / (s.spacing * s.spacing) + t.z * t.z / (s.dz * s.dz);
    const auto on = (gap < radius + s.spacing) & (gap > -s.depth) & (q2 < 4.0) & (facing < -0.3);
    return on ? s.area * kernel::shape(vsqrt(q2)) : V{};
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
    std::vector<double> x, y, z;
    for (std::int32_t j : active) {
        const auto p = static_cast<std::size_t>(j);
        coarsest = std::max({coarsest, wall.spacing[p], wall.dz[p]});
        deepest = std::max(deepest, wall.depth[p]);
        x.push_back(wall.x[p]);
        y.push_back(wall.y[p]);
        z.push_back(wall.z[p]);
    }
    // tangential reach, and how far in front of or behind the wall a node can be
    const double reach = 2 * coarsest + std::max(deepest, radius + coarsest);
    const double near = std::max(deepest, radius) + coarsest;
    // kept between steps for their memory; contact is not re-entrant
    static CellGrid walls, points;
    static Sorted<14> w;
    static Sorted<10> p;
    walls.build(x.data(), y.data(), z.data(), static_cast<std::int64_t>(active.size()), 0.5 * reach, reach, z_low, period);
    const std::vector<double>* const of_wall[14] = {&wall.x,     &wall.y,  &wall.z,     &wall.nx,   &wall.ny, &wall.nz, &wall.spacing,
                                                    &wall.dz,    &wall.depth, &wall.area, &wall.vx,   &wall.vy, &wall.vz, &wall.modulus};
    w.fill(walls, [&](int c, std::int64_t k) {
        return (*of_wall[c])[static_cast<std::size_t>(active[static_cast<std::size_t>(walls.index(k))])] + (c == 2 ? walls.shift(k) : 0.0);
    });
    const auto before = [](std::int64_t q, std::int64_t last) { return static_cast<double>(q) + load<V>(lane_number) < static_cast<double>(last); };

    std::vector<Touch> touch(static_cast<std::size_t>(nodes.n));
    exec::for_each(nodes.n, [&](std::int64_t n) {
        const auto i = static_cast<std::size_t>(n);
        Touch& t = touch[i];
        const Vec3<V> at{broadcast<V>(nodes.x[i]), broadcast<V>(nodes.y[i]), broadcast<V>(nodes.z[i])};
        const double reached = nodes.radius[i];
        // most nodes are far from the wall: is any point of it near, with the node not well in front?
        bool close = false;
        walls.ranges(nodes.x[i], nodes.y[i], nodes.z[i], near, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last && !close; q += width) {
                const Vec3<V> d{at.x - w(0, q), at.y - w(1, q), at.z - w(2, q)};
                const V ahead = d.x * w(3, q) + d.y * w(4, q) + d.z * w(5, q);
                close = any_lane((dot(d, d) < near * near) & (ahead < 1.5 * reached + 0.25 * w(6, q)) & before(q, last));
            }
        });
        if (!close) return;
        V weights{}, gaps{}, modulus{};
        Vec3<V> normals, velocities;
        walls.ranges(nodes.x[i], nodes.y[i], nodes.z[i], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const WallPoint s{{w(0, q), w(1, q), w(2, q)}, {w(3, q), w(4, q), w(5, q)}, w(6, q), w(7, q), w(8, q), w(9, q)};
                const V facing = nodes.nx ? nodes.nx[i] * s.normal.x + nodes.ny[i] * s.normal.y + nodes.nz[i] * s.normal.z : broadcast<V>(-1.0);
                V gap;
                const V omega = before(q, last) ? weight(s, at, broadcast<V>(reached), facing, gap) : V{};
                weights += omega;
                gaps += omega * gap;
                normals = normals + omega * s.normal;
                velocities = velocities + omega * Vec3<V>{w(10, q), w(11, q), w(12, q)};
                modulus += omega * w(13, q);
            }
        });
        t.weights = hsum(weights);
        if (!(t.weights > 0)) return;
        const double overlap = reached - hsum(gaps) / t.weights;
        if (!(overlap > 0)) {
            t.weights = 0;
            return;
        }
        const Vec3<double> sum{hsum(normals.x), hsum(normals.y), hsum(normals.z)}, normal = (1 / norm(sum)) * sum;
        const Vec3<double> wall_velocity = (1 / t.weights) * Vec3<double>{hsum(velocities.x), hsum(velocities.y), hsum(velocities.z)};
        const Vec3<double> relative = Vec3<double>{nodes.vx[i], nodes.vy[i], nodes.vz[i]} - wall_velocity;
        const double approach = dot(relative, normal);
        const double k = o.stiffness * std::max(series(nodes.modulus[i], hsum(modulus) / t.weights) * nodes.area[i] / nodes.length[i], nodes.hard[i]);
        const double damping = 2 * o.damping * std::sqrt(k * nodes.mass[i]);
        // progressive up to where the node stands on the wall: k (1 + (overlap/radius)^2), then 2 k
        const double deep = reached > 0 ? std::min(overlap / reached, 1.0) : 0.0, spring = k * overlap * (1 + deep * deep);
        const double force = std::max(spring - damping * approach, 0.0);
        Vec3<double> f = force * normal;
        if (o.friction > 0) {
            // Coulomb, regularised over a slip speed of 1 m/s
            const Vec3<double> slip = relative - approach * normal;
            f = f - (o.friction * force / std::max(norm(slip), 1e-3)) * slip;
        }
        t.fx = f.x;
        t.fy = f.y;
        t.fz = f.z;
        const double bent = std::min(overlap, reached);
        t.stored = 0.5 * k * (overlap * overlap * (1 + deep * deep) - 0.5 * deep * deep * bent * bent);
        t.overlap = overlap;
        nodes.fx[i] += f.x;
        nodes.fy[i] += f.y;
        nodes.fz[i] += f.z;
    });

    ContactReport report;
    std::vector<std::size_t> touching;
    for (std::size_t i = 0; i < touch.size(); ++i) {
        const Touch& t = touch[i];
        if (!(t.weights > 0)) continue;
        touching.push_back(i);
        report.stored += t.stored;
        report.penetration = std::max(report.penetration, t.overlap);
    }
    report.touching = static_cast<std::int64_t>(touching.size());
    if (touching.empty()) return report;

    // Reactions, gathered by the wall's points with the same weights, from the nodes that touch.
    x.clear();
    y.clear();
    z.clear();
    for (std::size_t i : touching) {
        x.push_back(nodes.x[i]);
        y.push_back(nodes.y[i]);
        z.push_back(nodes.z[i]);
    }
    points.build(x.data(), y.data(), z.data(), static_cast<std::int64_t>(touching.size()), 0.5 * reach, reach, z_low, period);
    p.fill(points, [&](int c, std::int64_t k) {
        const std::size_t i = touching[static_cast<std::size_t>(points.index(k))];
        const Touch& t = touch[i];
        const bool faces = nodes.nx != nullptr;
        const double row[10] = {nodes.x[i],          nodes.y[i],          nodes.z[i] + points.shift(k), nodes.radius[i],     faces ? nodes.nx[i] : 0.0,
                                faces ? nodes.ny[i] : 0.0, faces ? nodes.nz[i] : 0.0, t.fx / t.weights,            t.fy / t.weights, t.fz / t.weights};
        return row[c];
    });
    exec::for_each(static_cast<std::int64_t>(active.size()), [&](std::int64_t m) {
        const auto j = static_cast<std::size_t>(active[static_cast<std::size_t>(m)]);
        const WallPoint s{{broadcast<V>(wall.x[j]), broadcast<V>(wall.y[j]), broadcast<V>(wall.z[j])},
                          {broadcast<V>(wall.nx[j]), broadcast<V>(wall.ny[j]), broadcast<V>(wall.nz[j])},
                          broadcast<V>(wall.spacing[j]), broadcast<V>(wall.dz[j]), broadcast<V>(wall.depth[j]), broadcast<V>(wall.area[j])};
        Vec3<V> f;
        points.ranges(wall.x[j], wall.y[j], wall.z[j], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const V facing = nodes.nx ? p(4, q) * s.normal.x + p(5, q) * s.normal.y + p(6, q) * s.normal.z : broadcast<V>(-1.0);
                V gap;
                const V omega = before(q, last) ? weight(s, {p(0, q), p(1, q), p(2, q)}, p(3, q), facing, gap) : V{};
                f = f + omega * Vec3<V>{p(7, q), p(8, q), p(9, q)};
            }
        });
        wall.fx[j] -= hsum(f.x);
        wall.fy[j] -= hsum(f.y);
        wall.fz[j] -= hsum(f.z);
    });

    return report;
}

}  // namespace

ContactReport wall_contact(const FluidBody& a, Surface& s, const ContactOptions& o, double z_low, double period, FluidForces& fa) {
    Nodes n{a.x[0].data(), a.x[1].data(), a.x[2].data(), a.v_now[0].data(), a.v_now[1].data(), a.v_now[2].data(), a.size(), {}, {}, {}, {}, {}, {},
            nullptr, nullptr, nullptr, fa.fx.data(), fa.fy.data(), fa.fz.data()};
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
            nodes.nx.data(), nodes.ny.data(), nodes.nz.data(), nodes.fx.data(), nodes.fy.data(), nodes.fz.data()};
    return against_wall(n, wall, o, z_low, period);
}

}  // namespace brisance
