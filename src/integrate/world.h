// SPDX-License-Identifier: Apache-2.0
// Everything that is stepped: parts, what acts between them and from outside, the clock and the ledger.
#pragma once

#include "boundary/boundary.h"
#include "contact/contact.h"
#include "formulations/total_lagrangian/total_lagrangian.h"
#include "formulations/updated_lagrangian/updated_lagrangian.h"

#include <memory>
#include <string>
#include <vector>

namespace brisance {

template <class R>
struct SolidPart {
    SolidBody<R> body;
    ColumnPairs<R> pairs;
    Surface surface;
    std::vector<FixedPlane> fixed;
    std::vector<SolidPlaten> platens;
    std::vector<WallPressure> loads;
    std::vector<std::vector<Vec3<double>>> load_force;
    StressReport report;
    double dt = 0;       ///< its last drift, us
    bool slow = false;   ///< takes one long step while the others take several short ones
    double time = 0;     ///< us, at which its displacements stand (ahead of the world's within a long step)
};

struct FluidPart {
    FluidBody body;
    FluidSolver solver;
    FluidForces forces;
    std::vector<Platen> platens;
    double rate = 0;  ///< 1/us, largest stable rate of the present state
};

/// A pair of parts in contact: indices into solids or fluids.
struct ContactPair {
    enum Kind { fluid_fluid, fluid_solid, solid_solid } kind;
    std::size_t a, b;
    double clear = 0;  ///< mm that the two can still close before they must be looked at again
    std::int64_t patience = 0;  ///< passes until that is asked anew, after an answer of 0
};

struct StepOptions {
    double courant_solid = 0.8, courant_fluid = 0.4, growth = 1.02;
    double minimum = 0;  ///< us
    // what the watchdog bears (integrate/watchdog.h)
    double residual_limit = 0.05;   ///< of the supplied energy
    double velocity_limit = 30;     ///< km/s
    double torn_limit = 0.01;       ///< of the particles of a solid
    double leak_limit = 0.01;       ///< of the particles of a fluid
};

/// Running totals since the start, J, and impulses, mg mm/us.
struct Ledger {
    double zero_energy_lost = 0, viscous = 0, artificial = 0;
    double contact_work = 0;     ///< done by contact on the particles
    double boundary_work = 0;    ///< done by prescribed loads on the particles
    double impulse[3] = {0, 0, 0};  ///< of supports and loads
};

/// One row of the audit: where the energy is at a time.
struct Audit {
    std::int64_t step = 0;
    double time = 0, dt = 0;
    std::string limiter;
    double kinetic = 0;
    std::vector<double> internal;  ///< per part, solids then fluids; without what is still unburnt
    double burn_released = 0;
    double viscous = 0, artificial = 0;
    double zero_energy = 0, zero_energy_dissipated = 0;
    double contact_stored = 0, contact_dissipated = 0;
    double boundary_work = 0;
    double residual = 0, residual_relative = 0;
    double momentum[3] = {0, 0, 0};
    double momentum_residual = 0;  ///< |change of momentum - impulses| over sum of |m v|-like scale
    double penetration = 0;
    std::string penetration_where;
    std::int64_t torn = 0, damaged = 0;
};

template <class R>
struct World {
    std::vector<SolidPart<R>> solids;
    std::vector<FluidPart> fluids;
    std::vector<ContactPair> contacts;
    ContactOptions contact;
    StepOptions options;
    double z_low = 0, period = 0;  ///< plane strain: periodic in z when period > 0

    double time = 0;               ///< us
    double dt = 0;                 ///< last drift of the fast parts, us
    double dt_free = 0;            ///< the last step before it was cut to meet an output time
    double contact_dt = 0;         ///< longest step so far: contact springs are as hard as it bears, and never harden again
    std::int64_t short_steps = 0;  ///< steps of the fast parts
    std::int64_t steps = 0;
    std::string limiter;
    Ledger ledger;
    ContactReport contact_report;
    Vec3<double> force_from_outside{};  ///< platens and loads, mN
    Audit start;                   ///< the balance is held against this
    bool begun = false;            ///< `start` stands
    std::int64_t torn = 0;
    std::vector<std::pair<std::string, double>> seconds;  ///< wall time by part, and of contact
};

/// Fills derived state at t = 0: pressures, rates, forces, the first step, the reference of the audit.
template <class R> void begin(World<R>& w);
/// One step: the slow parts once, the fast ones as often as they need. Ends at `until` at the latest.
template <class R> void step(World<R>& w, double until);
/// The audit of the present state.
template <class R> Audit audit(const World<R>& w);

}  // namespace brisance
