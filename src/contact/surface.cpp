// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include "exec/launch.h"
#include "neighbours/deformation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brisance {

template <class R>
Surface make_surface(const SolidBody<R>& b) {
    Surface s;
    s.density = b.material.density;
    const double dz = b.layout.dz;
    const auto add = [&](std::size_t c, int k, double face, double area, double offset, double depth) {
        const Column& column = b.layout.columns[c];
        s.slot.push_back(column.start + k);
        s.column.push_back(static_cast<std::int32_t>(c));
        s.mass.push_back(b.mass(column));
        s.area.push_back(area);
        s.spacing.push_back(column.spacing);
        s.dz.push_back(dz);
        s.offset.push_back(offset);
        s.depth.push_back(depth);
        s.face.push_back(face);
        s.up.push_back(0);
        s.down.push_back(0);
        s.modulus.push_back(b.material.longitudinal_modulus());
        s.z_reference.push_back(column.z0 + k * dz);
    };
    // every particle of a kind, with the layer it is in
    const auto each = [&](std::uint8_t kind, auto&& use) {
        for (std::size_t c = 0; c < b.layout.columns.size(); ++c)
            for (int k = 0; k < b.layout.columns[c].layers; ++k)
                if (b.layout.flags[static_cast<std::size_t>(b.layout.columns[c].start + k)] & kind) use(c, b.layout.columns[c], k);
    };
    // where in the layer that it stands for a column's particle is
    const auto below = [&](const Column& column) { return std::clamp(column.z0 - b.layout.z_low, 0.0, dz); };
    std::vector<int> first(b.layout.columns.size()), last(first);
    each(slot_low, [&](std::size_t c, const Column&, int k) { first[c] = k; });
    each(slot_high, [&](std::size_t c, const Column&, int k) { last[c] = k; });
    each(slot_own, [&](std::size_t c, const Column& column, int k) {
        if (column.wall_layer != 0) return;
        add(c, k, 0, column.wall_length * dz, column.wall_distance, 3 * column.wall_distance);
        s.up.back() = b.layout.periodic ? 1e30 : (last[c] + 1 - k) * dz - below(column);
        s.down.back() = b.layout.periodic ? 1e30 : (k - first[c]) * dz + below(column);
    });
    s.sides = s.upper = s.size();
    if (!b.layout.periodic) {
        each(slot_high, [&](std::size_t c, const Column& column, int k) { add(c, k, 1, column.area, dz - below(column), 1.5 * dz); });
        s.upper = s.size();
        each(slot_low, [&](std::size_t c, const Column& column, int k) { add(c, k, -1, column.area, below(column), 1.5 * dz); });
    }
    for (std::size_t i = 0; i < s.size(); ++i) s.coarsest = std::max({s.coarsest, s.spacing[i], s.dz[i]});
    // Points of a column stand one after the other, and so do columns that are near each other.
    const auto apart = [&](std::size_t p, std::size_t q) {
        const Column &a = b.layout.columns[static_cast<std::size_t>(s.column[p])], &c = b.layout.columns[static_cast<std::size_t>(s.column[q])];
        return std::max(std::hypot(a.x - c.x, a.y - c.y) / s.spacing[p], std::abs(s.z_reference[p] - s.z_reference[q]) / s.dz[p]);
    };
    constexpr std::size_t most_of_a_group = 8;
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (i == s.sides) s.side_groups = s.group.size();
        const bool first = i == 0 || i == s.sides || i == s.upper;
        if (first || i - static_cast<std::size_t>(s.group.back()) == most_of_a_group || apart(static_cast<std::size_t>(s.group.back()), i) > most_of_a_group)
            s.group.push_back(static_cast<std::int64_t>(i));
    }
    if (s.sides == s.size()) s.side_groups = s.group.size();
    s.group.push_back(static_cast<std::int64_t>(s.size()));
    for (auto* a : {&s.x, &s.y, &s.z, &s.nx, &s.ny, &s.nz, &s.vx, &s.vy, &s.vz, &s.fx, &s.fy, &s.fz, &s.ix, &s.iy, &s.iz, &s.jx, &s.jy, &s.jz}) a->assign(s.size(), 0);
    return s;
}

namespace {

template <class R>
struct FollowKernel {
    SurfaceView s;
    SolidView<R> b;
    PairsView<R> pairs;
    double ahead;
    BRISANCE_HD void operator()(std::int64_t p) const {
        const std::int64_t slot = s.slot[p];
        const Column& column = b.columns[s.column[p]];
        const bool live = b.live[slot] != 0;
        const Mat3<double> f = deformation_gradient(b, pairs, s.column[p], slot);
        const double face = s.face[p];
        const Vec3<double> normal = face == 0 ? Vec3<double>{column.wall_normal_x, column.wall_normal_y, 0} : Vec3<double>{0, 0, face};
        Vec3<double> n = cofactor(f) * normal;
        double length = norm(n), jacobian = det(f);
        if (!live || !(length > 0.2 && length < 5 && jacobian > 0.2 && jacobian < 5) || dot(n, normal) < 0.3 * length) {
            n = normal;  // a crushed particle's gradient says nothing of the wall any more
            length = jacobian = 1;
        }
        // A torn particle is no wall: debris in the midst of gas would be pushed from one side only. Its neighbours on the wall cover its place.
        s.area[p] = !live ? 0.0 : face == 0 ? column.wall_length * b.dz : column.area;
        const double delta = s.offset[p] * std::clamp(jacobian / length, 0.5, 1.5);
        const double normal_now[3] = {n.x / length, n.y / length, n.z / length}, at_rest[3] = {column.x, column.y, s.z_reference[p]};
        double* const place[3] = {s.x, s.y, s.z};
        for (int k = 0; k < 3; ++k) {
            s.n[k][p] = normal_now[k];
            s.v[k][p] = static_cast<double>(b.v[k][slot]);
            place[k][p] = at_rest[k] + static_cast<double>(b.u[k][slot]) + ahead * s.v[k][p] + delta * normal_now[k];
            s.f[k][p] = 0;
        }
    }
};

}  // namespace

template <class R>
void follow(Surface& s, const SolidBody<R>& b, const ColumnPairs<R>& pairs, double ahead) {
    exec::launch(static_cast<std::int64_t>(s.size()), FollowKernel<R>{view(s), view(b), view(pairs), ahead}, 256);
}

void plan(Surface& surface, double kick) {
    const SurfaceView s = view(surface);
    exec::launch(s.size, BRISANCE_KERNEL(std::int64_t p) {
        for (int k = 0; k < 3; ++k) {
            s.i[k][p] = kick * s.f[k][p] - s.j[k][p];  // what a long step had foreseen and contact never gave is taken back
            s.j[k][p] = 0;
        }
    }, 1024);
}

void plan_ahead(Surface& surface, double step) {
    const SurfaceView s = view(surface);
    exec::launch(s.size, BRISANCE_KERNEL(std::int64_t p) {
        for (int k = 0; k < 3; ++k) {
            const double foreseen = 0.5 * step * s.f[k][p];
            s.i[k][p] = foreseen - s.j[k][p];
            s.j[k][p] = foreseen;
        }
    }, 1024);
}

void give(Surface& surface, double kick) {
    const SurfaceView s = view(surface);
    exec::launch(s.size, BRISANCE_KERNEL(std::int64_t p) {
        for (int k = 0; k < 3; ++k) s.j[k][p] -= kick * s.f[k][p];
    }, 1024);
}

template <class R>
void push(const Surface& surface, SolidBody<R>& body, double kick) {
    const SurfaceView s = view(surface);
    const SolidView<R> b = view(body);
    const bool pairwise = body.options.pairwise;
    // a particle at an edge has a point on each of its walls: one kind after the other
    const std::int64_t kinds[] = {0, s.sides, s.upper, s.size};
    for (int kind = 0; kind < 3; ++kind) {
        const std::int64_t first = kinds[kind];
        exec::launch(kinds[kind + 1] - first, BRISANCE_KERNEL(std::int64_t n) {
            const std::int64_t p = first + n, slot = s.slot[p];
            for (int k = 0; k < 3; ++k) {
                const double gained = s.i[k][p] / s.mass[p];
                b.v[k][slot] += static_cast<R>(gained);
                if (pairwise) b.acceleration[k][slot] += static_cast<R>(gained / kick);
            }
        }, 1024);
    }
}

template <class R>
double half_work(const Surface& surface, const SolidBody<R>& body) {
    const SurfaceView s = view(surface);
    const SolidView<R> b = view(body);
    return 0.5 * exec::launch_sum(s.size, BRISANCE_KERNEL(std::int64_t p) {
        const std::int64_t slot = s.slot[p];
        return s.i[0][p] * static_cast<double>(b.v[0][slot]) + s.i[1][p] * static_cast<double>(b.v[1][slot]) + s.i[2][p] * static_cast<double>(b.v[2][slot]);
    });
}

template Surface make_surface(const SolidBody<double>&);
template Surface make_surface(const SolidBody<float>&);
template void follow(Surface&, const SolidBody<double>&, const ColumnPairs<double>&, double);
template void follow(Surface&, const SolidBody<float>&, const ColumnPairs<float>&, double);
template void push(const Surface&, SolidBody<double>&, double);
template void push(const Surface&, SolidBody<float>&, double);
template double half_work(const Surface&, const SolidBody<double>&);
template double half_work(const Surface&, const SolidBody<float>&);

}  // namespace brisance
