// SPDX-License-Identifier: Apache-2.0
// From a case as data to a world that can be stepped.
#pragma once

#include "integrate/world.h"
#include "io/case.h"

#include <functional>
#include <string>

namespace brisance {

/// What a case will need, before anything is computed.
struct Estimate {
    struct Part {
        std::string name, material, formulation;
        double spacing = 0, spacing_far = 0, spacing_z = 0, mass = 0;   ///< mm, mg
        double particles = 0, bytes = 0, dt = 0;                        ///< dt: stable step at rest, us
        double lanes = 0;                                               ///< particles, and what fills the packs at the ends of columns
        bool burns = false;
    };
    std::vector<Part> parts;
    double particles = 0, bytes = 0;
    double dt = 0;            ///< the first step, us: a charge that burns is the fastest
    double burn = 0;          ///< us, when the last of the charge is lit
    double steps = 0;         ///< short steps
    double solid_steps = 0, fluid_steps = 0;  ///< particle-steps; solids take longer steps (integrate/step.cpp), and their particles are counted with the lanes beside them
};

/// The z-range of a slice, or of the whole case.
struct Extent {
    double low = 0, high = 0;
    bool periodic = false;
};
Extent slice_extent(const Case& c);

/// Counts by areas and spacings, without placing anything: works for cases that would not fit.
Estimate estimate(const Case& c);

/// Places all parts and wires contacts, boundaries and detonations. `say` gets one line per part.
template <class R> World<R> assemble(const Case& c, const std::function<void(const std::string&)>& say);

}  // namespace brisance
