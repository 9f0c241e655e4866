// SPDX-License-Identifier: Apache-2.0
// The ledger of energy and momentum, and the watchdog.
//
//   kinetic + internal + zero-energy control + contact = start + released by the burn + work of loads
//
// Each term is summed from its own source, so the residual is a check and not a definition.
#include "base/error.h"
#include "integrate/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brisance {

template <class R>
Audit audit(const World<R>& w) {
    Audit a;
    a.step = w.steps;
    a.time = w.time;
    a.dt = w.dt;
    a.limiter = w.limiter;
    double scale = 0;
    const auto add = [&](const BodySums& b) {
        a.kinetic += b.kinetic;
        a.internal.push_back(b.internal - b.unburnt);
        a.burn_released -= b.unburnt;
        a.momentum[0] += b.px;
        a.momentum[1] += b.py;
        a.momentum[2] += b.pz;
        a.damaged += b.damaged;
        scale += std::sqrt(2 * b.kinetic * b.mass);
    };
    for (const SolidPart<R>& s : w.solids) {
        add(sums(s.body));
        a.zero_energy += s.report.zero_energy;
        for (std::size_t p = 0; p < s.surface.size(); ++p) {  // impulse that the other side has not given yet
            a.momentum[0] -= s.surface.jx[p];
            a.momentum[1] -= s.surface.jy[p];
            a.momentum[2] -= s.surface.jz[p];
        }
    }
    for (const FluidPart& f : w.fluids) add(f.solver.sums(f.body));
    if (w.begun) a.burn_released -= w.start.burn_released;
    a.viscous = w.ledger.viscous;
    a.artificial = w.ledger.artificial;
    a.zero_energy_dissipated = w.ledger.zero_energy_lost;
    a.contact_stored = w.contact_report.stored;
    a.contact_dissipated = -w.ledger.contact_work - (w.contact_report.stored - w.start.contact_stored);
    a.boundary_work = w.ledger.boundary_work;
    a.torn = w.torn;
    a.penetration = w.contact_report.penetration;
    a.penetration_where = w.contact_report.where;
    if (w.steps == 0) {
        a.contact_dissipated = 0;
        return a;
    }
    double held = a.kinetic - w.start.kinetic + a.zero_energy - w.start.zero_energy + a.zero_energy_dissipated + (-w.ledger.contact_work);
    for (std::size_t i = 0; i < a.internal.size(); ++i) held += a.internal[i] - w.start.internal[i];
    a.residual = held - a.burn_released - a.boundary_work;
    const double reference = std::max({a.burn_released + std::abs(a.boundary_work), w.start.kinetic, 1e-12});
    a.residual_relative = a.residual / reference;
    double off = 0;
    for (int k = 0; k < 3; ++k) {
        const double d = a.momentum[k] - w.start.momentum[k] - w.ledger.impulse[k];
        off += d * d;
    }
    a.momentum_residual = scale > 0 ? std::sqrt(off) / scale : 0;
    return a;
}

template <class R>
void watch(const World<R>& w, const Audit& a) {
    const bool finite = std::isfinite(a.kinetic) && std::isfinite(a.residual);
    if (finite && std::abs(a.residual_relative) <= w.options.residual_limit) return;
    // the fastest particle, or the first that is no number
    std::string row = "no particle stands out";
    double worst = -1;
    for (const SolidPart<R>& s : w.solids)
        for (const Column& c : s.body.layout.columns)
            for (int k = 0; k < c.layers; ++k) {
                const auto i = static_cast<std::size_t>(c.start + k);
                if (!(s.body.layout.flags[i] & slot_own)) continue;
                const double vx = static_cast<double>(s.body.v[0][i]), vy = static_cast<double>(s.body.v[1][i]), vz = static_cast<double>(s.body.v[2][i]);
                double v = std::sqrt(vx * vx + vy * vy + vz * vz);
                if (!std::isfinite(v) || !std::isfinite(static_cast<double>(s.body.energy[i]))) v = 1e300;
                if (v <= worst) continue;
                worst = v;
                row = fmt::format("part {}, reference ({:.3f}, {:.3f}, {:.3f}) mm, u = ({:.4g}, {:.4g}, {:.4g}) mm, v = ({:.4g}, {:.4g}, {:.4g}) km/s, "
                                  "P = {:.4g} GPa, energy = {:.4g} GPa, damage = {:.3g}",
                                  s.body.name, c.x, c.y, c.z0 + k * s.body.layout.dz, s.body.u[0][i], s.body.u[1][i], s.body.u[2][i], vx, vy, vz,
                                  s.body.pressure[i], s.body.energy[i], s.body.damage(i));
            }
    for (const FluidPart& f : w.fluids)
        for (std::size_t i = 0; i < f.body.mass.size(); ++i) {
            const FluidBody& b = f.body;
            double v = std::sqrt(b.v[0][i] * b.v[0][i] + b.v[1][i] * b.v[1][i] + b.v[2][i] * b.v[2][i]);
            if (!std::isfinite(v) || !std::isfinite(b.e[i])) v = 1e300;
            if (v <= worst) continue;
            worst = v;
            row = fmt::format("part {}, particle {}, x = ({:.4g}, {:.4g}, {:.4g}) mm, v = ({:.4g}, {:.4g}, {:.4g}) km/s, rho = {:.4g} g/cm3, "
                              "e = {:.4g} kJ/g, P = {:.4g} GPa, h = {:.4g} mm",
                              b.name, i, b.x[0][i], b.x[1][i], b.x[2][i], b.v[0][i], b.v[1][i], b.v[2][i], b.rho[i], b.e[i], b.pressure[i], b.h[i]);
        }
    throw PhysicsStop(fmt::format("{} at t = {:.4f} us, step {}, dt = {:.3g} us ({}): energy residual {:.3g} of the supplied energy (limit {:g}).\n"
                                  "  {} particle: {}\n"
                                  "  usual causes: a step too long for a contact or a law (lower step.courant_fluid or step.courant_solid), parts that overlap at "
                                  "the start, a spacing too coarse for the thickness of a part",
                                  finite ? "the energy balance broke" : "a number was lost (NaN)", w.time, w.steps, w.dt, w.limiter,
                                  a.residual_relative, w.options.residual_limit, finite ? "fastest" : "first lost", row));
}

template Audit audit(const World<double>&);
template Audit audit(const World<float>&);
template void watch(const World<double>&, const Audit&);
template void watch(const World<float>&, const Audit&);

}  // namespace brisance
