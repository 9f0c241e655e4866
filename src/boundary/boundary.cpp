// SPDX-License-Identifier: Apache-2.0
#include "boundary/boundary.h"

#include "neighbours/deformation.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

/// Calls f(slot, column) for the particles of a body within one spacing of a plane, measured along its normal.
template <class R, class F>
void near_plane(const SolidBody<R>& b, Point point, Point normal, F&& f) {
    const double length = norm(normal);
    const Point n = (1 / length) * normal;
    for (const Column& c : b.layout.columns)
        for (int k = 0; k < c.layers; ++k) {
            const std::int64_t slot = c.start + k;
            const auto flags = b.layout.flags[static_cast<std::size_t>(slot)];
            if (!(flags & slot_own)) continue;
            const Point p{c.x, c.y, c.z0 + k * b.layout.dz};
            const double inside = dot(point - p, n);
            const double spacing = std::abs(n.z) > 0.7 ? b.layout.dz : c.spacing;
            // along z each column has its own phase: exactly its last particle is meant
            const bool end = std::abs(n.z) > 0.7 ? (flags & (n.z > 0 ? slot_high : slot_low)) != 0 && inside < 1.5 * spacing : inside < spacing;
            if (end) f(slot, c);
        }
}

}  // namespace

template <class R>
FixedPlane make_fixed_plane(const SolidBody<R>& body, Point point, Point normal, const bool axis[3]) {
    FixedPlane plane;
    for (int k = 0; k < 3; ++k) plane.axis[k] = axis[k];
    near_plane(body, point, normal, [&](std::int64_t slot, const Column& c) {
        plane.slots.push_back(slot);
        plane.mass.push_back(body.mass(c));
    });
    return plane;
}

template <class R>
FixedPlane make_fixed_region(const SolidBody<R>& body, const Shape& on, const bool axis[3]) {
    FixedPlane region;
    for (int k = 0; k < 3; ++k) region.axis[k] = axis[k];
    for (const Column& c : body.layout.columns)
        for (int k = 0; k < c.layers; ++k) {
            const std::int64_t slot = c.start + k;
            if (!(body.layout.flags[static_cast<std::size_t>(slot)] & slot_own) || !on.contains({c.x, c.y, c.z0 + k * body.layout.dz})) continue;
            region.slots.push_back(slot);
            region.mass.push_back(body.mass(c));
        }
    return region;
}

template <class R>
void hold(const FixedPlane& plane, SolidBody<R>& body, double impulse[3]) {
    const exec::HostAccess host;
    for (std::size_t i = 0; i < plane.slots.size(); ++i) {
        const auto slot = static_cast<std::size_t>(plane.slots[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            if (!plane.axis[k]) continue;
            impulse[k] -= plane.mass[i] * static_cast<double>(body.v[k][slot]);
            body.v[k][slot] = R(0);
            if (body.options.pairwise) body.acceleration[k][slot] = R(0);
        }
    }
}

ContactReport press(const Platen& platen, const FluidBody& b, FluidForces& f) {
    const exec::HostAccess host;
    const Point n = (1 / norm(platen.normal)) * platen.normal;
    ContactReport report;
    const FluidView fluid = view(b);
    const auto inside = [&](const std::array<Array<double>, 3>& at, std::size_t i) { return dot(platen.point - Point{at[0][i], at[1][i], at[2][i]}, n); };
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
        const double kappa = f.spacing[i], gap = inside(b.x, i);
        if (!(gap < 0.5 * kappa)) continue;
        const double at_rest = std::cbrt(b.mass[i] / fluid.initial_density(static_cast<std::int64_t>(i)));
        const double overlap = kappa * std::clamp(inside(b.reference, i) / at_rest, 0.0, 0.5) - gap;
        if (!(overlap > 0)) continue;
        const double k = 8 * f.modulus[i] * kappa;
        f.fx[i] -= k * overlap * n.x;
        f.fy[i] -= k * overlap * n.y;
        f.fz[i] -= k * overlap * n.z;
        report.stored += 0.5 * k * overlap * overlap;
        report.penetration = std::max(report.penetration, overlap);
        ++report.touching;
    }
    return report;
}

template <class R>
SolidPlaten make_solid_platen(const SolidBody<R>& body, const Platen& platen) {
    SolidPlaten p;
    p.platen = platen;
    near_plane(body, platen.point, platen.normal, [&](std::int64_t slot, const Column& c) {
        p.slots.push_back(slot);
        p.mass.push_back(body.mass(c));
        p.stiffness.push_back(body.material.longitudinal_modulus() * c.area / body.layout.dz);
    });
    for (auto* a : {&p.fx, &p.fy, &p.fz}) a->assign(p.slots.size(), 0);
    return p;
}

template <class R>
ContactReport press(SolidPlaten& p, const SolidBody<R>& body) {
    const exec::HostAccess host;
    const Point n = (1 / norm(p.platen.normal)) * p.platen.normal;
    ContactReport report;
    for (std::size_t i = 0; i < p.slots.size(); ++i) {
        const auto slot = static_cast<std::size_t>(p.slots[i]);
        const double overlap = static_cast<double>(body.u[0][slot]) * n.x + static_cast<double>(body.u[1][slot]) * n.y +
                               static_cast<double>(body.u[2][slot]) * n.z;
        const double force = overlap > 0 ? p.stiffness[i] * overlap : 0;
        p.fx[i] = -force * n.x;
        p.fy[i] = -force * n.y;
        p.fz[i] = -force * n.z;
        if (overlap > 0) {
            report.stored += 0.5 * force * overlap;
            report.penetration = std::max(report.penetration, overlap);
            ++report.touching;
        }
    }
    return report;
}

template <class R>
void push(const SolidPlaten& p, SolidBody<R>& body, double kick) {
    const exec::HostAccess host;
    for (std::size_t i = 0; i < p.slots.size(); ++i) {
        const auto slot = static_cast<std::size_t>(p.slots[i]);
        const double f[3] = {p.fx[i], p.fy[i], p.fz[i]};
        for (std::size_t k = 0; k < 3; ++k) {
            body.v[k][slot] += static_cast<R>(kick * f[k] / p.mass[i]);
            if (body.options.pairwise) body.acceleration[k][slot] += static_cast<R>(f[k] / p.mass[i]);
        }
    }
}

double WallPressure::at(double time) const {
    if (time <= times.front()) return values.front();
    for (std::size_t i = 1; i < times.size(); ++i)
        if (time <= times[i]) return values[i - 1] + (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1]);
    return values.back();
}

template <class R>
WallPressure make_wall_pressure(const SolidBody<R>& body, const Surface& s, const Shape& on, std::vector<double> times, std::vector<double> values) {
    WallPressure p;
    p.times = std::move(times);
    p.values = std::move(values);
    for (std::size_t i = 0; i < s.sides; ++i) {
        const Column& c = body.layout.columns[static_cast<std::size_t>(s.column[i])];
        if (on.contains({c.x + c.wall_distance * c.wall_normal_x, c.y + c.wall_distance * c.wall_normal_y, s.z_reference[i]})) p.points.push_back(i);
    }
    return p;
}

template <class R>
void press(const WallPressure& w, double time, const SolidBody<R>& b, const ColumnPairs<R>& pairs, Surface& s, std::vector<Vec3<double>>& load) {
    const exec::HostAccess host;
    const double pressure = w.at(time);
    const SolidView<R> body = view(b);
    const PairsView<R> bonds = view(pairs);
    load.assign(w.points.size(), {});
    for (std::size_t n = 0; n < w.points.size(); ++n) {
        const std::size_t i = w.points[n];
        const auto c = static_cast<std::size_t>(s.column[i]), slot = static_cast<std::size_t>(s.slot[i]);
        const Mat3<double> f = deformation_gradient(body, bonds, s.column[i], s.slot[i]);
        const double jacobian = det(f);
        const Vec3<double> normal{b.layout.columns[c].wall_normal_x, b.layout.columns[c].wall_normal_y, 0};
        Vec3<double> area = cofactor(f) * normal;
        if (b.live[slot] == 0 || !(jacobian > 0.2 && jacobian < 5) || !(norm(area) < 3)) area = normal;  // torn or crushed: the area it had
        load[n] = (-pressure * s.area[i]) * area;
        s.fx[i] += load[n].x;
        s.fy[i] += load[n].y;
        s.fz[i] += load[n].z;
    }
}

#define BRISANCE_INSTANTIATE(R)                                                                                                       \
    template FixedPlane make_fixed_plane(const SolidBody<R>&, Point, Point, const bool*);                                             \
    template FixedPlane make_fixed_region(const SolidBody<R>&, const Shape&, const bool*);                                            \
    template void hold(const FixedPlane&, SolidBody<R>&, double*);                                                                    \
    template SolidPlaten make_solid_platen(const SolidBody<R>&, const Platen&);                                                       \
    template ContactReport press(SolidPlaten&, const SolidBody<R>&);                                                                  \
    template void push(const SolidPlaten&, SolidBody<R>&, double);                                                                     \
    template WallPressure make_wall_pressure(const SolidBody<R>&, const Surface&, const Shape&, std::vector<double>, std::vector<double>); \
    template void press(const WallPressure&, double, const SolidBody<R>&, const ColumnPairs<R>&, Surface&, std::vector<Vec3<double>>&);
BRISANCE_INSTANTIATE(double)
BRISANCE_INSTANTIATE(float)

}  // namespace brisance
