// SPDX-License-Identifier: Apache-2.0
// The ledger of energy and momentum.
//
//   kinetic + internal + zero-energy control + contact = start + released by the burn + work of loads
//
// Each term is summed from its own source, so the residual is a check and not a definition.
#include "integrate/world.h"

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
        a.zero_energy += control_energy(s.body, s.pairs, s.dt);
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
    const double reference = std::max({a.burn_released + std::abs(a.boundary_work), w.start.kinetic, a.kinetic, 1e-12});
    a.residual_relative = a.residual / reference;
    double off = 0;
    for (int k = 0; k < 3; ++k) {
        const double d = a.momentum[k] - w.start.momentum[k] - w.ledger.impulse[k];
        off += d * d;
    }
    a.momentum_residual = scale > 0 ? std::sqrt(off) / scale : 0;
    return a;
}

template Audit audit(const World<double>&);
template Audit audit(const World<float>&);

}  // namespace brisance
