// SPDX-License-Identifier: Apache-2.0
#include "integrate/outer_forces.h"

#include "exec/launch.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace brisance {

namespace {

struct Total {
    Vec3<double> v;
    BRISANCE_HD Total& operator+=(const Total& o) {
        v = v + o.v;
        return *this;
    }
};
Total total(const double* x, const double* y, const double* z, std::int64_t n) {
    return exec::launch_sum(n, Total{}, BRISANCE_KERNEL(std::int64_t i) { return Total{{x[i], y[i], z[i]}}; });
}

/// Sum of the forces on fluids and on walls of solids as they stand.
template <class R>
Vec3<double> total_force(const World<R>& w) {
    Total sum;
    for (const FluidPart& f : w.fluids) sum += total(f.forces.fx.data(), f.forces.fy.data(), f.forces.fz.data(), f.body.size());
    for (const SolidPart<R>& s : w.solids) {
        const SurfaceView v = view(s.surface);
        sum += total(v.f[0], v.f[1], v.f[2], v.size);
    }
    return sum.v;
}

double fastest(const double* x, const double* y, const double* z, std::int64_t n) {
    return std::sqrt(exec::launch_max(n, 0.0, BRISANCE_KERNEL(std::int64_t i) { return x[i] * x[i] + y[i] * y[i] + z[i] * z[i]; }));
}

}  // namespace

template <class R>
void outer_forces(World<R>& w) {
    for (FluidPart& f : w.fluids) f.forces.begin(f.body);
    for (SolidPart<R>& s : w.solids) follow(s.surface, s.body, s.pairs, s.slow ? w.time - s.time : 0.0);

    ContactReport total;
    const auto add = [&](const ContactReport& r, const std::string& a, const std::string& b) {
        total.stored += r.stored;
        total.touching += r.touching;
        if (r.penetration > total.penetration) {
            total.penetration = r.penetration;
            total.where = a + "-" + b;
        }
    };
    ContactOptions options = w.contact;
    options.dt = w.contact_dt;
    // fastest particle of each part: pairs that are far apart need no search until they can have met
    std::vector<double> fluid_speed, solid_speed;
    for (const FluidPart& f : w.fluids) fluid_speed.push_back(fastest(f.body.v[0].data(), f.body.v[1].data(), f.body.v[2].data(), f.body.size()));
    for (const SolidPart<R>& s : w.solids)
        solid_speed.push_back(fastest(s.surface.vx.data(), s.surface.vy.data(), s.surface.vz.data(), static_cast<std::int64_t>(s.surface.size())));
    for (ContactPair& c : w.contacts) {
        const double speed = (c.kind == ContactPair::solid_solid ? solid_speed[c.a] : fluid_speed[c.a]) +
                             (c.kind == ContactPair::fluid_fluid ? fluid_speed[c.b] : solid_speed[c.b]);
        c.clear -= w.dt * speed;
        if (c.clear > 0) continue;
        ContactReport r;
        Places places_a{}, places_b{};
        double range = 0;
        if (c.kind == ContactPair::fluid_fluid) {
            FluidPart &a = w.fluids[c.a], &b = w.fluids[c.b];
            r = node_contact(a.body, b.body, options, a.forces, b.forces);
            add(r, a.body.name, b.body.name);
            places_a = places(a.body);
            places_b = places(b.body);
            range = 1.2 * std::max(a.forces.largest_spacing, b.forces.largest_spacing);
        } else if (c.kind == ContactPair::fluid_solid) {
            FluidPart& a = w.fluids[c.a];
            SolidPart<R>& b = w.solids[c.b];
            r = wall_contact(a.body, b.surface, options, w.z_low, w.period, a.forces);
            add(r, a.body.name, b.body.name);
            places_a = places(a.body);
            places_b = places(b.surface);
            range = 0.6 * a.forces.largest_spacing + b.surface.coarsest;
        } else {
            SolidPart<R>&a = w.solids[c.a], &b = w.solids[c.b];
            r = surface_contact(a.surface, b.surface, options, w.z_low, w.period);
            add(r, a.body.name, b.body.name);
            places_a = places(a.surface);
            places_b = places(b.surface);
            range = std::max(a.surface.coarsest, b.surface.coarsest);
        }
        // after a pass in which nothing touched: how far can the two move before something does?
        if (r.touching > 0 || --c.patience > 0) continue;
        constexpr double horizon = 0.5;  // mm
        c.clear = clearance(places_a, places_b, range, horizon, w.z_low, w.period);
        c.patience = c.clear > 0 ? 0 : 16;
    }
    // What comes from here on comes from outside, and its impulse is booked; contact has cancelled, but for what came through mirrors.
    const bool mirrored = std::any_of(w.fluids.begin(), w.fluids.end(), [](const FluidPart& f) { return !f.body.mirrors.empty(); });
    const Vec3<double> inner = mirrored ? Vec3<double>{} : total_force(w);
    for (FluidPart& f : w.fluids)
        for (const Platen& p : f.platens) add(press(p, f.body, f.forces), f.body.name, "platen");
    for (SolidPart<R>& s : w.solids) {
        s.load_force.resize(s.loads.size());
        for (std::size_t i = 0; i < s.loads.size(); ++i) press(s.loads[i], w.time, s.body, s.pairs, s.surface, s.load_force[i]);
    }
    w.force_from_outside = total_force(w) - inner;
    for (FluidPart& f : w.fluids) f.forces.heat = f.solver.equalise(f.body, f.forces.press.data(), f.forces.near.data(), w.dt);
    for (const FluidPart& f : w.fluids) {
        if (f.body.mirrors.empty()) continue;
        const FluidView b = view(f.body);  // pairs within the part cancel; what is left came through the mirrors
        const Total p = exec::launch_sum(b.n, Total{}, BRISANCE_KERNEL(std::int64_t i) {
            return Total{{b.mass[i] * b.acceleration[0][i], b.mass[i] * b.acceleration[1][i], b.mass[i] * b.acceleration[2][i]}};
        });
        w.force_from_outside = w.force_from_outside + p.v;
    }
    for (SolidPart<R>& s : w.solids)
        for (SolidPlaten& p : s.platens) add(press(p, s.body), s.body.name, "platen");
    w.contact_report = total;
}

template <class R>
void book_outer_work(World<R>& w, const SolidPart<R>& s, double kick) {
    const double half = 0.5 * kick;
    const SolidBody<R>& b = s.body;
    const auto power = [&](std::int64_t slot, double fx, double fy, double fz) {
        const auto i = static_cast<std::size_t>(slot);
        return fx * static_cast<double>(b.v[0][i]) + fy * static_cast<double>(b.v[1][i]) + fz * static_cast<double>(b.v[2][i]);
    };
    double platens = 0, loads = 0;
    std::optional<exec::HostAccess> host;
    if (!s.loads.empty() || !s.platens.empty()) host.emplace();
    for (std::size_t l = 0; l < s.loads.size(); ++l)
        for (std::size_t n = 0; n < s.loads[l].points.size(); ++n) {
            const Vec3<double>& f = s.load_force[l][n];
            loads += power(s.surface.slot[s.loads[l].points[n]], f.x, f.y, f.z);
        }
    for (const SolidPlaten& p : s.platens)
        for (std::size_t n = 0; n < p.slots.size(); ++n) platens += power(p.slots[n], p.fx[n], p.fy[n], p.fz[n]);
    host.reset();
    w.ledger.contact_work += half_work(s.surface, b) + half * (platens - loads);
    w.ledger.boundary_work += half * loads;
}

void book_outer_work(Ledger& ledger, const FluidPart& f, double kick) {
    const FluidView b = view(f.body);
    const double *const fx = f.forces.fx.data(), *const fy = f.forces.fy.data(), *const fz = f.forces.fz.data();
    ledger.contact_work += 0.5 * kick * exec::launch_sum(b.n, BRISANCE_KERNEL(std::int64_t i) { return fx[i] * b.v[0][i] + fy[i] * b.v[1][i] + fz[i] * b.v[2][i]; });
}

template void outer_forces(World<double>&);
template void outer_forces(World<float>&);
template void book_outer_work(World<double>&, const SolidPart<double>&, double);
template void book_outer_work(World<float>&, const SolidPart<float>&, double);

}  // namespace brisance
