// SPDX-License-Identifier: Apache-2.0
#include "contact/chosen_points.h"
#include "contact/gathered.h"
#include "contact/stiffness.h"
#include "exec/launch.h"
#include "math/kernel.h"
#include "math/pack.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

using V = Pack<double>;
constexpr int width = lanes<double>;

/// The nodes of one side: particles of a fluid, or points of another wall.
struct Nodes {
    const double *x[3], *v[3], *mass, *modulus;
    const double* rho;              ///< of a fluid's particles; null for a wall
    const double* kappa;            ///< spacing of a fluid's particles; null for a wall
    const double *wall_area, *wall_spacing;
    const double* normal[3];        ///< points of a wall have normals, and touch only walls that face them
    double* f[3];
    NodeGroupsView groups;
    std::int64_t n;
    double largest_radius;

    BRISANCE_HD double radius(std::int64_t i) const { return kappa ? 0.5 * kappa[i] : 0.0; }
    /// Area and length of the spring. A fluid's is so stiff that a gas does not gain volume: overlap = kappa/8 P/(rho c^2).
    BRISANCE_HD double area(std::int64_t i) const { return kappa ? kappa[i] * kappa[i] : wall_area[i]; }
    BRISANCE_HD double length(std::int64_t i) const { return kappa ? 0.125 * kappa[i] : wall_spacing[i]; }
    BRISANCE_HD double hard(std::int64_t i, const ContactOptions& o) const { return kappa ? hardest(mass[i], o) : 0.0; }
};

/// What node i feels of the wall: force, the normaliser of its weights, and the kind of points that they belong to.
struct Touch {
    double fx, fy, fz, weights, face, stored, overlap;
};

/// A point of the wall, or a pack of them: place, normal, shape of its kernel, and how far behind it a node is still pushed back.
struct WallPoint {
    Vec3<V> at, normal;
    V spacing, dz, depth, area;
};

/// omega_ij, 0 out of reach; `gap` is set. `facing`: the product of the two normals, where a node has one.
BRISANCE_HD inline V weight(const WallPoint& s, const Vec3<V>& node, V radius, V facing, V& gap) {
    const Vec3<V> d = node - s.at;
    gap = dot(d, s.normal);
    const Vec3<V> t = d - gap * s.normal;
    const V q2 = (t.x * t.x + t.y * t.y) / (s.spacing * s.spacing) + t.z * t.z / (s.dz * s.dz);
    const auto on = (gap < radius + s.spacing) & (gap > -s.depth) & (q2 < 4.0) & (facing < -0.3);
    return on ? s.area * kernel::shape(vsqrt(q2)) : V{};
}

/// Of the points of the wall that nodes can meet.
struct Extent {
    double coarsest = 0, deepest = 0;
    /// How far a node can be from the nearest point of a wall that it touches, and from all that its plane is made of.
    BRISANCE_HD double near(double radius) const { return diagonal(coarsest, std::max(deepest, radius)); }
    BRISANCE_HD double reach(double radius) const { return diagonal(2 * coarsest, std::max(deepest, radius + coarsest)); }
    BRISANCE_HD static double diagonal(double along, double across) { return std::sqrt(along * along + across * across); }
    BRISANCE_HD Extent& operator+=(const Extent& o) {
        coarsest = std::max(coarsest, o.coarsest);
        deepest = std::max(deepest, o.deepest);
        return *this;
    }
};

/// Row k of the wall's columns: place 0-2, normal 3-5, spacing, dz, depth, area 6-9, velocity 10-12, modulus 13, face 14, how far the wall goes on
/// upwards and downwards 15-16.
struct WallRows {
    SurfaceView wall;
    const std::int32_t* active;
    CellGridView grid;
    SortedView<17> rows;
    BRISANCE_HD void operator()(std::int64_t k) const {
        if (k >= grid.entries) return rows.put(k, {0});
        const std::int32_t j = active[grid.index[k]];
        rows.put(k, {wall.x[j],  wall.y[j],     wall.z[j] + grid.shift[k], wall.n[0][j], wall.n[1][j], wall.n[2][j], wall.spacing[j],
                     wall.dz[j], wall.depth[j], wall.area[j],              wall.v[0][j], wall.v[1][j], wall.v[2][j], wall.modulus[j], wall.face[j], wall.up[j], wall.down[j]});
    }
};

/// The force of the wall on a node.
struct WallKernel {
    Nodes nodes;
    RingMapView map;
    SortedView<17> w;
    Extent extent;
    double density;   ///< of the wall, g/cm3
    ContactOptions o;
    Touch* touch;

    BRISANCE_HD void operator()(std::int64_t g) const {
        PointBox box;
        double radius = 0;
        nodes.groups.each(g, [&](std::int64_t i) {
            touch[i] = {};
            box += box_of(nodes.x[0][i], nodes.x[1][i], nodes.x[2][i]);
            radius = std::max(radius, nodes.radius(i));
        });
        if (!close(box, radius)) return;
        Gathered<17> near;
        near.take_near(box, extent.reach(radius), map.grid, w);
        const SortedView<17> v = near.view();
        nodes.groups.each(g, [&](std::int64_t i) {
            if (near.all) feel(i, [&](double, auto&& f) { f(v, 0, near.count); });
            else feel(i, [&](double r, auto&& f) {
                map.grid.ranges(nodes.x[0][i], nodes.x[1][i], nodes.x[2][i], r, [&](std::int64_t first, std::int64_t last) { f(w, first, last); });
            });
        });
    }

private:
    /// Most nodes are far from the wall: is any point of it near the box of some, with none of them well in front?
    BRISANCE_HD bool close(const PointBox& box, double radius) const {
        const double near = extent.near(radius);
        const Vec3<double> middle = box.middle(), half = box.half();
        if (map.bound(middle) >= near + norm(half)) return false;
        bool any = false;
        ranges(map.grid, box, near, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last && !any; q += width) {
                const V nx = w(3, q), ny = w(4, q), nz = w(5, q);
                const V ahead = (middle.x - w(0, q)) * nx + (middle.y - w(1, q)) * ny + (middle.z - w(2, q)) * nz - half.x * vabs(nx) - half.y * vabs(ny) - half.z * vabs(nz);
                any = any_lane((apart2(box, w(0, q), w(1, q), w(2, q)) < near * near) & (ahead < 1.5 * radius + 0.25 * w(6, q)) & lanes_before<V>(q, last));
            }
        });
        return any;
    }
    /// The weighted plane of the points of one kind; without weights where the node is beside it.
    struct Plane {
        double weights = 0, gap = 0, modulus = 0, face = 0;
        Vec3<double> normal, velocity;
    };
    /// `points`: calls its function for the columns and ranges of them that hold the points in reach; `others`: set where some are of another kind.
    template <class Points>
    BRISANCE_HD Plane seen(std::int64_t i, const Vec3<V>& at, double face, const Points& points, bool& others) const {
        const double reached = nodes.radius(i);
        V weights{}, gaps{}, modulus{}, beside{}, x{}, y{};
        Vec3<V> normals, velocities;
        points(extent.reach(reached), [&](const SortedView<17>& w, std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const WallPoint s{{w(0, q), w(1, q), w(2, q)}, {w(3, q), w(4, q), w(5, q)}, w(6, q), w(7, q), w(8, q), w(9, q)};
                const V facing = nodes.normal[0] ? nodes.normal[0][i] * s.normal.x + nodes.normal[1][i] * s.normal.y + nodes.normal[2][i] * s.normal.z : broadcast<V>(-1.0);
                V gap;
                const V all = weight(s, at, broadcast<V>(reached), facing, gap), any = lanes_before<V>(q, last) ? all : V{};
                const V omega = w(14, q) == face ? any : V{};
                others = others || any_lane(any > omega);
                weights += omega;
                gaps += omega * gap;
                normals = normals + omega * s.normal;
                velocities = velocities + omega * Vec3<V>{w(10, q), w(11, q), w(12, q)};
                modulus += omega * w(13, q);
                if (face == 0) {
                    const V dz = at.z - s.at.z;
                    beside += omega * vmax(dz - w(15, q), -dz - w(16, q));
                } else {
                    beside -= omega * (0.75 * s.spacing);
                    x += omega * (at.x - s.at.x);
                    y += omega * (at.y - s.at.y);
                }
            }
        });
        Plane plane;
        plane.weights = hsum(weights);
        if (!(plane.weights > 0)) return plane;
        const double per = 1 / plane.weights;
        // A side is beside the node above and below its ends; an end where the points that are seen have their middle far to one side. The last
        // columns stand half a spacing from the edge: from there it is half a spacing away.
        const double sx = hsum(x), sy = hsum(y);
        if (std::sqrt(sx * sx + sy * sy) + hsum(beside) > 0) return {};
        const Vec3<double> normal{hsum(normals.x), hsum(normals.y), hsum(normals.z)};
        plane.gap = per * hsum(gaps);
        plane.modulus = per * hsum(modulus);
        plane.face = face;
        plane.normal = (1 / norm(normal)) * normal;
        plane.velocity = per * Vec3<double>{hsum(velocities.x), hsum(velocities.y), hsum(velocities.z)};
        return plane;
    }
    template <class Points>
    BRISANCE_HD void feel(std::int64_t i, const Points& points) const {
        const double x = nodes.x[0][i], y = nodes.x[1][i], z = nodes.x[2][i], reached = nodes.radius(i);
        const Vec3<V> at{broadcast<V>(x), broadcast<V>(y), broadcast<V>(z)};
        const double near = extent.near(reached);
        bool close = false;
        points(near, [&](const SortedView<17>& w, std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last && !close; q += width) {
                const Vec3<V> d{at.x - w(0, q), at.y - w(1, q), at.z - w(2, q)};
                const V ahead = d.x * w(3, q) + d.y * w(4, q) + d.z * w(5, q);
                close = any_lane((dot(d, d) < near * near) & (ahead < 1.5 * reached + 0.25 * w(6, q)) & lanes_before<V>(q, last));
            }
        });
        if (!close) return;
        // at an edge, as the rim of a borehole, a node is outside of the face that it is farther in front of
        bool ends = false;
        Plane plane = seen(i, at, 0, points, ends);
        if (ends)
            for (const double face : {1.0, -1.0}) {
                const Plane end = seen(i, at, face, points, ends);
                if (end.weights > 0 && (!(plane.weights > 0) || end.gap > plane.gap)) plane = end;
            }
        const double overlap = reached - plane.gap;
        if (!(plane.weights > 0 && overlap > 0)) return;
        Touch& t = touch[i];
        t.weights = plane.weights;
        t.face = plane.face;
        const Vec3<double> normal = plane.normal, relative = Vec3<double>{nodes.v[0][i], nodes.v[1][i], nodes.v[2][i]} - plane.velocity;
        const double approach = dot(relative, normal);
        const double k = o.stiffness * std::max(series(nodes.modulus[i], plane.modulus) * nodes.area(i) / nodes.length(i), nodes.hard(i, o));
        const double ratio = nodes.rho ? damping_ratio(nodes.rho[i], density, o) : o.damping, damping = 2 * ratio * std::sqrt(k * nodes.mass[i]);
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
        nodes.f[0][i] += f.x;
        nodes.f[1][i] += f.y;
        nodes.f[2][i] += f.z;
    }
};

struct Touched {
    double stored = 0, overlap = 0, radius = 0;
    BRISANCE_HD Touched& operator+=(const Touched& other) {
        stored += other.stored;
        overlap = std::max(overlap, other.overlap);
        radius = std::max(radius, other.radius);
        return *this;
    }
};

/// Row k of the touching nodes' columns: place 0-2, radius 3, normal 4-6, force over the sum of weights 7-9, face 10.
struct NodeRows {
    Nodes nodes;
    const std::int32_t* touching;
    const Touch* touch;
    CellGridView grid;
    SortedView<11> rows;
    BRISANCE_HD void operator()(std::int64_t k) const {
        if (k >= grid.entries) return rows.put(k, {0});
        const std::int32_t i = touching[grid.index[k]];
        const Touch& t = touch[i];
        const bool faces = nodes.normal[0] != nullptr;
        rows.put(k, {nodes.x[0][i], nodes.x[1][i], nodes.x[2][i] + grid.shift[k], nodes.radius(i), faces ? nodes.normal[0][i] : 0.0, faces ? nodes.normal[1][i] : 0.0,
                     faces ? nodes.normal[2][i] : 0.0, t.fx / t.weights, t.fy / t.weights, t.fz / t.weights, t.face});
    }
};

/// The reaction on a group of points of the wall, with the weights of the action.
struct ReactionKernel {
    SurfaceView wall;
    NodeGroupsView groups;
    RingMapView map;
    SortedView<11> p;
    double reach;
    bool faces;
    BRISANCE_HD void operator()(std::int64_t g) const {
        PointBox box;
        groups.each(g, [&](std::int64_t j) { box += box_of(wall.x[j], wall.y[j], wall.z[j]); });
        if (map.bound(box.middle()) >= reach + norm(box.half())) return;
        Gathered<11> near;
        near.take_near(box, reach, map.grid, p);
        if (near.all && near.count == 0) return;
        const SortedView<11> v = near.view();
        groups.each(g, [&](std::int64_t j) {
            if (near.all) react(j, [&](auto&& f) { f(v, 0, near.count); });
            else react(j, [&](auto&& f) { map.grid.ranges(wall.x[j], wall.y[j], wall.z[j], reach, [&](std::int64_t first, std::int64_t last) { f(p, first, last); }); });
        });
    }

private:
    template <class Points>
    BRISANCE_HD void react(std::int64_t j, const Points& points) const {
        const WallPoint s{{broadcast<V>(wall.x[j]), broadcast<V>(wall.y[j]), broadcast<V>(wall.z[j])},
                          {broadcast<V>(wall.n[0][j]), broadcast<V>(wall.n[1][j]), broadcast<V>(wall.n[2][j])},
                          broadcast<V>(wall.spacing[j]), broadcast<V>(wall.dz[j]), broadcast<V>(wall.depth[j]), broadcast<V>(wall.area[j])};
        Vec3<V> f;
        points([&](const SortedView<11>& p, std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const V facing = faces ? p(4, q) * s.normal.x + p(5, q) * s.normal.y + p(6, q) * s.normal.z : broadcast<V>(-1.0);
                V gap;
                const V all = weight(s, {p(0, q), p(1, q), p(2, q)}, p(3, q), facing, gap), omega = lanes_before<V>(q, last) & (p(10, q) == wall.face[j]) ? all : V{};
                f = f + omega * Vec3<V>{p(7, q), p(8, q), p(9, q)};
            }
        });
        wall.f[0][j] -= hsum(f.x);
        wall.f[1][j] -= hsum(f.y);
        wall.f[2][j] -= hsum(f.z);
    }
};

ContactReport against_wall(const Nodes& nodes, Surface& surface, const ContactOptions& o, double z_low, double period) {
    // kept between steps for their memory; contact is not re-entrant
    static ChosenPoints active_points, touching_nodes;
    static SortedColumns<17> wall_columns;
    static SortedColumns<11> node_columns;
    static Array<Touch> touches;

    const SurfaceView wall = view(surface);
    const double radius = nodes.largest_radius;
    // only the part of the wall that the nodes can meet: a rim far away has coarser points and would widen the search
    const PointBox box = box_of(nodes.x[0], nodes.x[1], nodes.x[2], nodes.n);
    std::int32_t* const active = active_points.list(wall.size);
    const std::int64_t count = exec::select(nodes.kappa ? wall.size : wall.sides, BRISANCE_KERNEL(std::int64_t j) {
        return box.beside(wall.x[j], wall.y[j], radius + wall.depth[j] + 2 * wall.spacing[j]);
    }, BRISANCE_KERNEL(std::int64_t j, std::int64_t k) { active[k] = static_cast<std::int32_t>(j); });
    if (count == 0) return {};
    const Extent extent = exec::launch_sum(count, Extent{}, BRISANCE_KERNEL(std::int64_t k) {
        const std::int32_t j = active[k];
        return Extent{std::max(wall.spacing[j], wall.dz[j]), wall.depth[j]};
    });
    // Cells for nodes of usual size; few gas particles have expanded far, and they look into more cells. Small cells make short rows of points,
    // and packs that are not full.
    active_points.build(wall.x, wall.y, wall.z, count, extent.reach(0), extent.reach(radius), z_low, period, nodes.n);
    const CellGridView walls = active_points.view().grid;
    const SortedView<17> w = wall_columns.room(walls.entries);
    exec::launch(walls.entries + width, WallRows{wall, active, walls, w}, 1024);

    make_room(touches, static_cast<std::size_t>(nodes.n));
    Touch* const touch = touches.data();
    exec::launch(nodes.groups.size, WallKernel{nodes, active_points.view(), w, extent, surface.density, o, touch}, few_groups);

    std::int32_t* const touching = touching_nodes.list(nodes.n);
    ContactReport report;
    report.touching = exec::select(nodes.n, BRISANCE_KERNEL(std::int64_t i) { return touch[i].weights > 0; },
                                   BRISANCE_KERNEL(std::int64_t i, std::int64_t k) { touching[k] = static_cast<std::int32_t>(i); });
    if (report.touching == 0) return report;
    const Touched touched = exec::launch_sum(report.touching, Touched{}, BRISANCE_KERNEL(std::int64_t k) {
        const Touch& t = touch[touching[k]];
        return Touched{t.stored, t.overlap, nodes.radius(touching[k])};
    });
    report.stored = touched.stored;
    report.penetration = touched.overlap;

    const double reach = extent.reach(touched.radius);
    touching_nodes.build(nodes.x[0], nodes.x[1], nodes.x[2], report.touching, 0.5 * reach, reach, z_low, period, count);
    const CellGridView points = touching_nodes.view().grid;
    const SortedView<11> p = node_columns.room(points.entries);
    exec::launch(points.entries + width, NodeRows{nodes, touching, touch, points, p}, 1024);
    const NodeGroupsView groups{surface.group.data(), nullptr, static_cast<std::int64_t>(nodes.kappa ? surface.group.size() - 1 : surface.side_groups)};
    exec::launch(groups.size, ReactionKernel{wall, groups, touching_nodes.view(), p, reach, nodes.normal[0] != nullptr}, few_groups);
    return report;
}

}  // namespace

ContactReport wall_contact(const FluidBody& a, Surface& s, const ContactOptions& o, double z_low, double period, FluidForces& fa) {
    const FluidView b = view(a);
    const Nodes n{{b.x[0], b.x[1], b.x[2]}, {b.v_now[0], b.v_now[1], b.v_now[2]}, b.mass, fa.modulus.data(), b.rho_now, fa.spacing.data(), nullptr, nullptr, {},
                  {fa.fx.data(), fa.fy.data(), fa.fz.data()}, fa.group(a), b.n, 0.5 * fa.largest_spacing};
    return against_wall(n, s, o, z_low, period);
}

ContactReport surface_contact(Surface& nodes, Surface& wall, const ContactOptions& o, double z_low, double period) {
    const SurfaceView s = view(nodes);
    const Nodes n{{s.x, s.y, s.z}, {s.v[0], s.v[1], s.v[2]}, s.mass, s.modulus, nullptr, nullptr, s.area, s.spacing, {s.n[0], s.n[1], s.n[2]}, {s.f[0], s.f[1], s.f[2]}, {nodes.group.data(), nullptr, static_cast<std::int64_t>(nodes.side_groups)}, s.sides, 0};
    return against_wall(n, wall, o, z_low, period);
}

}  // namespace brisance
