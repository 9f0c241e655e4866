// SPDX-License-Identifier: Apache-2.0
#include "integrate/watchdog.h"

#include "integrate/census.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

/// A particle by its part (solids first, then fluids, as in World) and slot.
struct Place {
    bool solid = true;
    std::size_t part = 0, slot = 0;
};

template <class R>
std::string row_of(const World<R>& w, const Place& at) {
    const std::size_t i = at.slot;
    if (at.solid) {
        const SolidBody<R>& b = w.solids[at.part].body;
        const auto column = std::upper_bound(b.layout.columns.begin(), b.layout.columns.end(), static_cast<std::int64_t>(i),
                                             [](std::int64_t slot, const Column& c) { return slot < c.start; }) - 1;
        const double z = column->z0 + static_cast<double>(static_cast<std::int64_t>(i) - column->start) * b.layout.dz;
        return fmt::format("part {}, particle {} of column {}, at rest at ({:.3f}, {:.3f}, {:.3f}) mm: u = ({:.4g}, {:.4g}, {:.4g}) mm, v = ({:.4g}, {:.4g}, {:.4g}) km/s, "
                           "P = {:.4g} GPa, energy = {:.4g} GPa, damage = {:.3g}, material {}",
                           b.name, static_cast<std::int64_t>(i) - column->start, column - b.layout.columns.begin(), column->x, column->y, z, b.u[0][i], b.u[1][i], b.u[2][i], b.v[0][i],
                           b.v[1][i], b.v[2][i], b.pressure[i], b.energy[i], b.damage(i), b.material.name);
    }
    const FluidBody& b = w.fluids[at.part].body;
    return fmt::format("part {}, particle {}, at ({:.4g}, {:.4g}, {:.4g}) mm, at the start at ({:.3f}, {:.3f}, {:.3f}) mm: v = ({:.4g}, {:.4g}, {:.4g}) km/s, rho = {:.4g} g/cm3, "
                       "e = {:.4g} kJ/g, P = {:.4g} GPa, h = {:.4g} mm, material {}",
                       b.name, i, b.x[0][i], b.x[1][i], b.x[2][i], b.reference[0][i], b.reference[1][i], b.reference[2][i], b.v[0][i], b.v[1][i], b.v[2][i], b.rho[i], b.e[i],
                       b.pressure[i], b.h[i], b.material.name);
}

template <class R>
PhysicsStop stop(const World<R>& w, const std::string& what, const std::string& who, const std::string& row, const std::string& causes, const std::string& change) {
    return PhysicsStop(fmt::format("{} at t = {:.4f} us, step {}, dt = {:.3g} us ({})\n  {}: {}\n  usual causes: {}\n  change: {}", what, w.time, w.steps, w.dt, w.limiter, who, row,
                                   causes, change));
}

}  // namespace

template <class R>
void watch(const World<R>& w, const Audit& a, const Leaks& leaks) {
    const StepOptions& o = w.options;
    Place lost, fastest;
    std::int64_t lost_count = 0;
    double most = -1;
    const auto add = [&](const Census& c, bool solid, std::size_t part) {
        if (c.lost > 0 && lost_count == 0) lost = {solid, part, static_cast<std::size_t>(c.first_lost)};
        lost_count += c.lost;
        if (c.most > most) {
            most = c.most;
            fastest = {solid, part, static_cast<std::size_t>(c.fastest)};
        }
    };
    for (std::size_t p = 0; p < w.solids.size(); ++p) add(census(w.solids[p].body), true, p);
    for (std::size_t p = 0; p < w.fluids.size(); ++p) add(census(w.fluids[p].body), false, p);
    const std::string overlap = "parts that overlap at the start, a part thinner than three of its spacings";
    if (lost_count > 0)
        throw stop(w, fmt::format("{} particles hold a value that is no number (NaN or infinite)", lost_count), "first", row_of(w, lost),
                   "a step too long for a contact or a law, a material outside of the range of its law, " + overlap,
                   "lower step.courant_fluid and step.courant_solid to two thirds; look at this part in the snapshot before; check its material (brisance materials)");
    if (most > o.velocity_limit)
        throw stop(w, fmt::format("a particle runs away with {:.4g} km/s (step.velocity_limit = {:g} km/s)", most, o.velocity_limit), "fastest", row_of(w, fastest),
                   "a contact that lets go of what it pressed too hard, a light particle between heavy ones, " + overlap,
                   "lower step.courant_fluid and step.courant_solid; refine the thin part; raise step.velocity_limit only where such a speed is meant");
    for (std::size_t p = 0; p < w.solids.size(); ++p) {
        const auto& flags = w.solids[p].body.layout.flags;
        const auto torn = [](std::uint8_t f) { return (f & slot_torn) != 0; };
        const std::int64_t count = std::count_if(flags.begin(), flags.end(), torn);
        if (static_cast<double>(count) <= o.torn_limit * static_cast<double>(w.solids[p].body.layout.particles)) continue;
        const auto first = static_cast<std::size_t>(std::find_if(flags.begin(), flags.end(), torn) - flags.begin());
        throw stop(w, fmt::format("{} of {} particles of part {} are torn: crushed flat, turned inside out, stretched beyond any meaning, or alone (step.torn_limit = {:g})", count,
                                  w.solids[p].body.layout.particles, w.solids[p].body.name, o.torn_limit),
                   "first", row_of(w, Place{true, p, first}),
                   "a load that no solid bears as one (then the part flows), a part of a single layer of particles, a velocity given at the start that folds it, a spacing too coarse for what crushes it",
                   "make the part updated_lagrangian if it flows; refine it; raise step.torn_limit if the loss is meant, as at the wall of a borehole");
    }
    std::int64_t fluid = 0;
    for (const FluidPart& f : w.fluids) fluid += f.body.size();
    if (static_cast<double>(leaks.count) > o.leak_limit * static_cast<double>(fluid))
        throw stop(w, fmt::format("{} of {} fluid particles stand inside a solid (step.leak_limit = {:g})", leaks.count, fluid, o.leak_limit), "first leaked",
                   row_of(w, Place{false, leaks.part, leaks.particle}),
                   "a wall coarser than the fluid that presses on it, contact.pairs that leaves the two parts out, parts that overlap at the start",
                   "give wall and fluid spacings within a factor of three; name the pair in contact.pairs; raise contact.stiffness");
    if (!(std::abs(a.residual_relative) <= o.residual_limit))
        throw stop(w, fmt::format("the energy balance broke: its residual is {:.3g} of the supplied energy (step.energy_residual_limit = {:g})", a.residual_relative, o.residual_limit),
                   "fastest", row_of(w, fastest), "a step too long for a contact or a law, a spacing too coarse for the thickness of a part, " + overlap,
                   "lower step.courant_fluid or step.courant_solid to two thirds; if the residual falls with the step, the step was the cause");
}

template <class R>
PhysicsStop collapsed_step(const World<R>& w, double dt) {
    const exec::HostAccess host;  // the step is under way
    const std::string part = w.limiter.substr(0, w.limiter.find(':'));
    std::string row = "the step of the start";
    for (std::size_t p = 0; p < w.solids.size(); ++p) {
        const SolidPart<R>& s = w.solids[p];
        if (s.body.name != part || s.report.fastest < 0) continue;
        // the stress pass knows the tile; in it the one under the highest pressure
        auto slot = static_cast<std::size_t>(s.report.fastest);
        for (std::size_t i = slot; i < slot + static_cast<std::size_t>(s.body.layout.width); ++i)
            if ((s.body.layout.flags[i] & slot_own) && (!(s.body.layout.flags[slot] & slot_own) || s.body.pressure[i] > s.body.pressure[slot])) slot = i;
        row = row_of(w, Place{true, p, slot});
    }
    for (std::size_t p = 0; p < w.fluids.size(); ++p) {
        const FluidPart& f = w.fluids[p];
        if (f.body.name != part) continue;
        row = row_of(w, Place{false, p, f.solver.fastest(f.body, f.forces.fx.data(), f.forces.fy.data(), f.forces.fz.data())});
    }
    return stop(w, fmt::format("the step fell to {:.3g} us (step.minimum = {:.3g} us), held by {},", dt, w.options.minimum, w.limiter), "who holds it", row,
                "a particle crushed in a contact, a gas layer squeezed to nothing, a law outside of its range",
                "look at this part in the last snapshot; give it a coarser spacing or contact a smaller stiffness; lower step.minimum if the step is meant");
}

template void watch(const World<double>&, const Audit&, const Leaks&);
template void watch(const World<float>&, const Audit&, const Leaks&);
template PhysicsStop collapsed_step(const World<double>&, double);
template PhysicsStop collapsed_step(const World<float>&, double);

}  // namespace brisance
