// SPDX-License-Identifier: Apache-2.0
// One time step, top to bottom as the physics happens. Leapfrog: v lives at half steps, everything else at whole ones.
//
//   v_n+1/2 = v_n-1/2 + (dt_n-1 + dt_n)/2 a_n,   x_n+1 = x_n + dt_n v_n+1/2
#include "base/error.h"
#include "integrate/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace brisance {

namespace {

/// Adds the wall time of a stretch of work to a part's account.
template <class R, class F>
void timed(World<R>& w, const std::string& who, F&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (auto& [name, seconds] : w.seconds)
        if (name == who) {
            seconds += spent;
            return;
        }
    w.seconds.emplace_back(who, spent);
}

/// Contact, platens and loads at t_n, from positions at t_n and velocities at t_n-1/2.
template <class R>
void outer_forces(World<R>& w) {
    for (FluidPart& f : w.fluids) f.forces.clear(f.body.mass.size());
    for (SolidPart<R>& s : w.solids) follow(s.surface, s.body, s.pairs);

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
    for (FluidPart& f : w.fluids)
        for (const Platen& p : f.platens) add(press(p, f.body, f.forces), f.body.name, "platen");
    for (SolidPart<R>& s : w.solids) {
        for (SolidPlaten& p : s.platens) add(press(p, s.body), s.body.name, "platen");
        s.load_force.resize(s.loads.size());
        for (std::size_t i = 0; i < s.loads.size(); ++i) press(s.loads[i], w.time, s.body, s.pairs, s.surface, s.load_force[i]);
    }
    w.contact_report = total;
}

/// Half of the kick's work of the outer forces, with the velocity as it stands: called before and after the kick it makes f.(v- + v+)/2.
template <class R>
void book_outer_work(World<R>& w, double kick) {
    const double half = 0.5 * kick;
    for (const FluidPart& f : w.fluids) {
        const FluidBody& b = f.body;
        w.ledger.contact_work += half * exec::sum(b.size(), [&](std::int64_t k) {
            const auto i = static_cast<std::size_t>(k);
            return f.forces.fx[i] * b.v[0][i] + f.forces.fy[i] * b.v[1][i] + f.forces.fz[i] * b.v[2][i];
        });
    }
    for (const SolidPart<R>& s : w.solids) {
        const SolidBody<R>& b = s.body;
        const auto power = [&](std::int64_t slot, double fx, double fy, double fz) {
            const auto i = static_cast<std::size_t>(slot);
            return fx * static_cast<double>(b.v[0][i]) + fy * static_cast<double>(b.v[1][i]) + fz * static_cast<double>(b.v[2][i]);
        };
        double all = 0, loads = 0;
        for (std::size_t p = 0; p < s.surface.size(); ++p) all += power(s.surface.slot[p], s.surface.fx[p], s.surface.fy[p], s.surface.fz[p]);
        for (std::size_t l = 0; l < s.loads.size(); ++l)
            for (std::size_t n = 0; n < s.loads[l].points.size(); ++n) {
                const Vec3<double>& f = s.load_force[l][n];
                loads += power(s.surface.slot[s.loads[l].points[n]], f.x, f.y, f.z);
            }
        for (const SolidPlaten& p : s.platens)
            for (std::size_t n = 0; n < p.slots.size(); ++n) all += power(p.slots[n], p.fx[n], p.fy[n], p.fz[n]);
        w.ledger.contact_work += half * (all - loads);
        w.ledger.boundary_work += half * loads;
    }
}

/// Impulse of everything that is not between parts: platens and loads.
template <class R>
void book_impulse(World<R>& w, double kick) {
    // Forces between parts cancel in the sum over all, so the sum is what came from outside.
    double* j = w.ledger.impulse;
    for (const FluidPart& f : w.fluids)
        for (std::size_t i = 0; i < f.forces.fx.size(); ++i) {
            j[0] += kick * f.forces.fx[i];
            j[1] += kick * f.forces.fy[i];
            j[2] += kick * f.forces.fz[i];
        }
    for (const SolidPart<R>& s : w.solids) {
        for (std::size_t p = 0; p < s.surface.size(); ++p) {
            j[0] += kick * s.surface.fx[p];
            j[1] += kick * s.surface.fy[p];
            j[2] += kick * s.surface.fz[p];
        }
        for (const SolidPlaten& p : s.platens)
            for (std::size_t n = 0; n < p.slots.size(); ++n) {
                j[0] += kick * p.fx[n];
                j[1] += kick * p.fy[n];
                j[2] += kick * p.fz[n];
            }
    }
}

/// Outer forces join the fluid's own acceleration.
void accelerate(FluidPart& f) {
    FluidBody& b = f.body;
    for (std::size_t i = 0; i < b.mass.size(); ++i) {
        b.acceleration[0][i] += f.forces.fx[i] / b.mass[i];
        b.acceleration[1][i] += f.forces.fy[i] / b.mass[i];
        b.acceleration[2][i] += f.forces.fz[i] / b.mass[i];
    }
}

/// The next step: the least of what each part bears, grown slowly, ending exactly at `until`.
template <class R>
double next_step(World<R>& w, double until) {
    double dt = 1e300;
    const auto bound = [&](double limit, std::string who) {
        if (limit < dt) {
            dt = limit;
            w.limiter = std::move(who);
        }
    };
    for (const SolidPart<R>& s : w.solids) {
        double rate = s.report.rate;
        if (rate == 0) {  // before the first stress pass
            double least = s.body.layout.dz;
            for (const Column& c : s.body.layout.columns) least = std::min(least, c.spacing);
            rate = s.body.material.sound_speed() / least;
        }
        bound(w.options.courant_solid * stencil_tau / rate, s.body.name + ": wave");
    }
    for (const FluidPart& f : w.fluids) {
        std::int64_t worst;
        const double rate = f.solver.stable_rate(f.body, worst);
        if (rate > 0) bound(w.options.courant_fluid / rate, f.body.name + ": wave");
        if (f.body.material.burn) bound(0.25 * f.body.spacing / f.body.material.burn->speed, f.body.name + ": burn");
    }
    if (w.dt_free > 0 && dt > w.options.growth * w.dt_free) {
        dt = w.options.growth * w.dt_free;
        w.limiter = "growth";
    }
    if (dt < w.options.minimum)
        throw PhysicsStop(fmt::format("the step fell to {:.3g} us (limit {:.3g} us) at t = {:.4f} us, held by {}; usual causes: a particle crushed "
                                      "in a contact, or a law outside of its range. Look at the last snapshot of that part, or lower step.minimum",
                                      dt, w.options.minimum, w.time, w.limiter));
    w.dt_free = dt;
    // Output times are met exactly, without a splinter of a step before them.
    const double left = until - w.time;
    return left <= dt ? left : (left < 2 * dt ? 0.5 * left : dt);
}

}  // namespace

template <class R>
void begin(World<R>& w) {
    for (FluidPart& f : w.fluids) {
        FluidBody& b = f.body;
        b.v_now = b.v;
        b.rho_now = b.rho;
        b.e_now = b.e;
        f.solver.state(b, w.time);
        f.solver.rates(b);
    }
    for (SolidPart<R>& s : w.solids)
        if (s.body.options.pairwise) s.body.v_now = s.body.v;
    outer_forces(w);
    w.start = audit(w);
}

template <class R>
void step(World<R>& w, double until) {
    const double dt = next_step(w, until), kick_time = 0.5 * (w.dt + dt);

    // kick: v_n-1/2 -> v_n+1/2
    book_outer_work(w, kick_time);
    book_impulse(w, kick_time);
    for (SolidPart<R>& s : w.solids)
        timed(w, s.body.name, [&] {
            w.ledger.viscous += kick(s.body, s.pairs, kick_time);
            push(s.surface, s.body, kick_time);
            for (const SolidPlaten& p : s.platens) push(p, s.body, kick_time);
            for (const FixedPlane& p : s.fixed) hold(p, s.body, w.ledger.impulse);
        });
    for (FluidPart& f : w.fluids) {
        accelerate(f);
        f.solver.kick(f.body, kick_time);
    }
    book_outer_work(w, kick_time);

    // drift: x_n -> x_n+1
    for (SolidPart<R>& s : w.solids) timed(w, s.body.name, [&] { drift(s.body, dt); });
    for (FluidPart& f : w.fluids) f.solver.drift(f.body, dt);
    w.time += dt;
    w.dt = dt;
    ++w.steps;

    // stress and rates at t_n+1
    for (SolidPart<R>& s : w.solids)
        timed(w, s.body.name, [&] {
            s.report = stress(s.body, s.pairs, w.time, dt, kick_time);
            w.ledger.zero_energy_lost += s.report.zero_energy_lost;
            w.ledger.viscous += s.report.bulk_viscous;
            w.torn += s.report.torn;
        });
    for (FluidPart& f : w.fluids)
        timed(w, f.body.name, [&] {
            f.solver.state(f.body, w.time);
            const FluidSolver::Powers p = f.solver.rates(f.body);
            w.ledger.viscous += p.viscous * dt;
            w.ledger.artificial += p.artificial * dt;
        });
    timed(w, "contact", [&] { outer_forces(w); });
}

template void begin(World<double>&);
template void begin(World<float>&);
template void step(World<double>&, double);
template void step(World<float>&, double);

}  // namespace brisance
