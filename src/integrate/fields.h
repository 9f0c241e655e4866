// SPDX-License-Identifier: Apache-2.0
// Every quantity that a step reads from the step before, by name: what a checkpoint holds and a state hash covers. A world that is
// assembled from the same case, begun, and then given these, goes on with the same bits. What is not here is constant, or made anew in
// each step.
#pragma once

#include "integrate/world.h"

#include <fmt/format.h>

namespace brisance {

/// visit(name, x) for numbers, strings and vectors of numbers.
template <class R, class V>
void each_field(World<R>& w, V&& visit) {
    visit("time", w.time);
    visit("dt", w.dt);
    visit("dt_free", w.dt_free);
    visit("contact_dt", w.contact_dt);
    visit("short_steps", w.short_steps);
    visit("steps", w.steps);
    visit("limiter", w.limiter);
    visit("torn", w.torn);
    visit("ledger.zero_energy_lost", w.ledger.zero_energy_lost);
    visit("ledger.viscous", w.ledger.viscous);
    visit("ledger.artificial", w.ledger.artificial);
    visit("ledger.contact_work", w.ledger.contact_work);
    visit("ledger.boundary_work", w.ledger.boundary_work);
    for (int k = 0; k < 3; ++k) visit(fmt::format("ledger.impulse.{}", k), w.ledger.impulse[k]);
    visit("contact.stored", w.contact_report.stored);
    visit("contact.penetration", w.contact_report.penetration);
    visit("contact.where", w.contact_report.where);
    visit("contact.touching", w.contact_report.touching);
    visit("outside.x", w.force_from_outside.x);
    visit("outside.y", w.force_from_outside.y);
    visit("outside.z", w.force_from_outside.z);
    for (std::size_t k = 0; k < w.contacts.size(); ++k) {
        visit(fmt::format("clear.{}", k), w.contacts[k].clear);
        visit(fmt::format("patience.{}", k), w.contacts[k].patience);
    }

    const auto columns = [&](const std::string& name, auto& arrays) {
        for (std::size_t k = 0; k < arrays.size(); ++k) visit(fmt::format("{}.{}", name, k), arrays[k]);
    };
    for (SolidPart<R>& s : w.solids) {
        const std::string at = s.body.name + ".";
        visit(at + "dt", s.dt);
        visit(at + "time", s.time);
        visit(at + "rate", s.report.rate);
        SolidBody<R>& b = s.body;
        columns(at + "u", b.u);
        columns(at + "v", b.v);
        columns(at + "v_now", b.v_now);
        columns(at + "acceleration", b.acceleration);
        columns(at + "viscous_force", b.viscous_force);
        columns(at + "R_sum", b.R_sum);
        columns(at + "T", b.T);
        columns(at + "state", b.state);
        visit(at + "pressure", b.pressure);
        visit(at + "energy", b.energy);
        visit(at + "power", b.power);
        visit(at + "stiffness", b.stiffness);
        visit(at + "live", b.live);
        if (b.options.failure.fracture_energy > 0) visit(at + "opening", b.opening);
        visit(at + "flags", b.layout.flags);  // which particles are torn,
        std::vector<std::uint8_t> masked;     // and whose sums ask for it
        for (const Tile& t : b.layout.tiles) masked.push_back(t.masked);
        visit(at + "masked", masked);
        for (std::size_t t = 0; t < masked.size(); ++t) b.layout.tiles[t].masked = masked[t] != 0;
        visit(at + "peak_pressure", b.peak_pressure);
        visit(at + "peak_radial", b.peak_radial);
        visit(at + "sigma_1", b.sigma_1);
        visit(at + "tau_max", b.tau_max);
        visit(at + "failure_time", b.failure_time);
        visit(at + "yield", b.yield);
        Surface& f = s.surface;
        std::size_t k = 0;
        for (auto* a : {&f.x, &f.y, &f.z, &f.nx, &f.ny, &f.nz, &f.vx, &f.vy, &f.vz, &f.fx, &f.fy, &f.fz, &f.ix, &f.iy, &f.iz, &f.jx, &f.jy, &f.jz})
            visit(fmt::format("{}surface.{}", at, k++), *a);
        for (std::size_t p = 0; p < s.platens.size(); ++p) {
            visit(fmt::format("{}platen.{}.x", at, p), s.platens[p].fx);
            visit(fmt::format("{}platen.{}.y", at, p), s.platens[p].fy);
            visit(fmt::format("{}platen.{}.z", at, p), s.platens[p].fz);
        }
        for (std::size_t p = 0; p < s.load_force.size(); ++p) {
            std::vector<double> flat;  // x, y, z of one point after the other
            for (const Vec3<double>& force : s.load_force[p]) flat.insert(flat.end(), {force.x, force.y, force.z});
            visit(fmt::format("{}load.{}", at, p), flat);
            for (std::size_t i = 0; i < s.load_force[p].size(); ++i) s.load_force[p][i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
        }
    }
    for (FluidPart& f : w.fluids) {
        const std::string at = f.body.name + ".";
        visit(at + "rate", f.rate);
        FluidBody& b = f.body;
        columns(at + "x", b.x);
        columns(at + "v", b.v);
        columns(at + "v_now", b.v_now);
        columns(at + "acceleration", b.acceleration);
        for (auto [name, a] : {std::pair{"rho", &b.rho}, {"rho_now", &b.rho_now}, {"rho_rate", &b.rho_rate}, {"e", &b.e}, {"e_now", &b.e_now},
                               {"e_rate", &b.e_rate}, {"pressure", &b.pressure}, {"sound", &b.sound}, {"h", &b.h}, {"burnt", &b.burnt},
                               {"peak_pressure", &b.peak_pressure}})
            visit(at + name, *a);
        visit(at + "force.x", f.forces.fx);
        visit(at + "force.y", f.forces.fy);
        visit(at + "force.z", f.forces.fz);
        visit(at + "heat", f.forces.heat);
    }
}

}  // namespace brisance
