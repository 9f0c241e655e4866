// SPDX-License-Identifier: Apache-2.0
// One time step, top to bottom as the physics happens. Leapfrog: v lives at half steps, everything else at whole ones.
//
//   v_n+1/2 = v_n-1/2 + (dt_n-1 + dt_n)/2 a_n,   x_n+1 = x_n + dt_n v_n+1/2
//
// Parts whose stable step is long (the rock) take one step while the others take several; between, their walls drift with their
// velocity, and contact is handed over as impulse (contact/contact.h: plan_ahead, give).
#include "integrate/outer_forces.h"
#include "integrate/step_size.h"
#include "integrate/world.h"

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

/// v_n-1/2 -> v_n+1/2 -> x_n+1 of a solid.
template <class R>
void advance(World<R>& w, SolidPart<R>& s, double dt) {
    const double kick_time = 0.5 * (s.dt + dt);
    for (const SolidPlaten& p : s.platens) {
        for (std::size_t n = 0; n < p.slots.size(); ++n) {
            w.ledger.impulse[0] += kick_time * p.fx[n];
            w.ledger.impulse[1] += kick_time * p.fy[n];
            w.ledger.impulse[2] += kick_time * p.fz[n];
        }
    }
    if (s.slow) plan_ahead(s.surface, dt);
    else plan(s.surface, 0.5 * (w.dt + dt));  // as the other side is kicked: s.dt is longer where the last step was a long one
    book_outer_work(w, s, kick_time);  // the same before and after the kick: f.(v- + v+)/2
    w.ledger.viscous += kick(s.body, s.pairs, kick_time);
    push(s.surface, s.body, kick_time);
    for (const SolidPlaten& p : s.platens) push(p, s.body, kick_time);
    for (const FixedPlane& p : s.fixed) hold(p, s.body, w.ledger.impulse);
    book_outer_work(w, s, kick_time);
    drift(s.body, dt, kick_time);
    s.time += dt;
}

/// Stress at t_n+1.
template <class R>
void respond(World<R>& w, SolidPart<R>& s, double dt) {
    s.report = stress(s.body, s.pairs, s.time, dt, 0.5 * (s.dt + dt));
    s.dt = dt;
    w.ledger.zero_energy_lost += s.report.zero_energy_lost;
    w.ledger.viscous += s.report.bulk_viscous;
    w.torn += s.report.torn;
}

void advance(Ledger& ledger, FluidPart& f, double kick_time, double dt) {
    book_outer_work(ledger, f, kick_time);
    ledger.contact_work += kick_time * f.forces.heat;
    f.solver.kick(f.body, kick_time, f.forces.fx.data(), f.forces.fy.data(), f.forces.fz.data());
    book_outer_work(ledger, f, kick_time);
    f.solver.drift(f.body, dt);
}

void respond(Ledger& ledger, FluidPart& f, double time, double dt) {
    f.solver.state(f.body, time);
    const FluidSolver::Powers p = f.solver.rates(f.body);
    f.rate = f.solver.stable_rate(f.body, f.forces.fx.data(), f.forces.fy.data(), f.forces.fz.data());
    ledger.viscous += p.viscous * dt;
    ledger.artificial += p.artificial * dt;
}

/// One short step of the fast parts.
template <class R>
void short_step(World<R>& w, double dt) {
    const double kick_time = 0.5 * (w.dt + dt);
    w.ledger.impulse[0] += kick_time * w.force_from_outside.x;
    w.ledger.impulse[1] += kick_time * w.force_from_outside.y;
    w.ledger.impulse[2] += kick_time * w.force_from_outside.z;
    for (SolidPart<R>& s : w.solids) {
        if (s.slow) give(s.surface, kick_time);
        else timed(w, s.body.name, [&] { advance(w, s, dt); });
    }
    for (FluidPart& f : w.fluids) timed(w, f.body.name, [&] { advance(w.ledger, f, kick_time, dt); });
    w.time += dt;
    w.dt = dt;
    ++w.short_steps;
    for (SolidPart<R>& s : w.solids)
        if (!s.slow) timed(w, s.body.name, [&] { respond(w, s, dt); });
    for (FluidPart& f : w.fluids) timed(w, f.body.name, [&] { respond(w.ledger, f, w.time, dt); });
}

}  // namespace

template <class R>
void begin(World<R>& w) {
    for (FluidPart& f : w.fluids) {
        FluidBody& b = f.body;
        b.v_now = b.v;
        b.rho_now = b.rho;
        b.e_now = b.e;
        respond(w.ledger, f, w.time, 0);
    }
    for (SolidPart<R>& s : w.solids) {
        double before_the_start[3] = {0, 0, 0};
        for (const FixedPlane& p : s.fixed) hold(p, s.body, before_the_start);  // what is fixed has no initial velocity either
        complete(s.body);  // neighbours beyond the period move too
        if (s.body.options.pairwise) s.body.v_now = s.body.v;
    }
    outer_forces(w);
    w.start = audit(w);
    w.begun = true;
}

template <class R>
void step(World<R>& w, double until) {
    const exec::DevicePhase device;
    const double end = w.time + choose_step(w, until);
    const double start = w.time;
    for (SolidPart<R>& s : w.solids)
        if (s.slow) timed(w, s.body.name, [&] { advance(w, s, end - start); });
    const bool alone = std::none_of(w.solids.begin(), w.solids.end(), [](const SolidPart<R>& s) { return s.slow; });
    while (w.time < end) {
        const double dt = alone ? end - w.time : choose_short_step(w, end);
        short_step(w, dt);
        if (end - w.time < 1e-9 * dt) w.time = end;
        if (w.time < end) timed(w, "contact", [&] { outer_forces(w); });
    }
    for (SolidPart<R>& s : w.solids) {
        s.time = end;
        if (s.slow) timed(w, s.body.name, [&] { respond(w, s, end - start); });
    }
    timed(w, "contact", [&] { outer_forces(w); });
    ++w.steps;
}

template void begin(World<double>&);
template void begin(World<float>&);
template void step(World<double>&, double);
template void step(World<float>&, double);

}  // namespace brisance
