// SPDX-License-Identifier: Apache-2.0
#include "integrate/outer_forces.h"

namespace brisance {

namespace {

/// Sum of the forces on fluids and on walls of solids as they stand.
template <class R>
Vec3<double> total_force(const World<R>& w) {
    Vec3<double> sum;
    for (const FluidPart& f : w.fluids)
        for (std::size_t i = 0; i < f.forces.fx.size(); ++i) sum = sum + Vec3<double>{f.forces.fx[i], f.forces.fy[i], f.forces.fz[i]};
    for (const SolidPart<R>& s : w.solids)
        for (std::size_t p = 0; p < s.surface.size(); ++p) sum = sum + Vec3<double>{s.surface.fx[p], s.surface.fy[p], s.surface.fz[p]};
    return sum;
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
    for (const ContactPair& c : w.contacts) {
        if (c.kind == ContactPair::fluid_fluid) {
            FluidPart &a = w.fluids[c.a], &b = w.fluids[c.b];
            add(node_contact(a.body, b.body, w.contact, a.forces, b.forces), a.body.name, b.body.name);
        } else if (c.kind == ContactPair::fluid_solid) {
            FluidPart& a = w.fluids[c.a];
            SolidPart<R>& b = w.solids[c.b];
            add(wall_contact(a.body, b.surface, w.contact, w.z_low, w.period, a.forces), a.body.name, b.body.name);
        } else {
            SolidPart<R>&a = w.solids[c.a], &b = w.solids[c.b];
            add(surface_contact(a.surface, b.surface, w.contact, w.z_low, w.period), a.body.name, b.body.name);
        }
    }
    // What comes from here on comes from outside, and its impulse is booked; contact has cancelled.
    const Vec3<double> inner = total_force(w);
    for (FluidPart& f : w.fluids)
        for (const Platen& p : f.platens) add(press(p, f.body, f.forces), f.body.name, "platen");
    for (SolidPart<R>& s : w.solids) {
        s.load_force.resize(s.loads.size());
        for (std::size_t i = 0; i < s.loads.size(); ++i) press(s.loads[i], w.time, s.body, s.pairs, s.surface, s.load_force[i]);
    }
    w.force_from_outside = total_force(w) - inner;
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
    for (std::size_t l = 0; l < s.loads.size(); ++l)
        for (std::size_t n = 0; n < s.loads[l].points.size(); ++n) {
            const Vec3<double>& f = s.load_force[l][n];
            loads += power(s.surface.slot[s.loads[l].points[n]], f.x, f.y, f.z);
        }
    for (const SolidPlaten& p : s.platens)
        for (std::size_t n = 0; n < p.slots.size(); ++n) platens += power(p.slots[n], p.fx[n], p.fy[n], p.fz[n]);
    w.ledger.contact_work += half_work(s.surface, b) + half * (platens - loads);
    w.ledger.boundary_work += half * loads;
}

void book_outer_work(Ledger& ledger, const FluidPart& f, double kick) {
    const FluidBody& b = f.body;
    ledger.contact_work += 0.5 * kick * exec::sum(b.size(), [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        return f.forces.fx[i] * b.v[0][i] + f.forces.fy[i] * b.v[1][i] + f.forces.fz[i] * b.v[2][i];
    });
}

template void outer_forces(World<double>&);
template void outer_forces(World<float>&);
template void book_outer_work(World<double>&, const SolidPart<double>&, double);
template void book_outer_work(World<float>&, const SolidPart<float>&, double);

}  // namespace brisance
