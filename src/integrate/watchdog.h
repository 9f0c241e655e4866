// SPDX-License-Identifier: Apache-2.0
// Stops a run whose numbers have lost their meaning, and says which particle, where, in which state, what usually leads there, and what
// to change.
#pragma once

#include "base/error.h"
#include "integrate/world.h"

namespace brisance {

/// Fluid particles that stand inside a solid; the first of them by its place in World::fluids.
struct Leaks {
    std::int64_t count = 0;
    std::size_t part = 0, particle = 0;
};

/// Throws PhysicsStop for, in this order: a value that is no number; a particle faster than `velocity_limit`; more torn particles of a
/// solid than `torn_limit`; more leaked fluid than `leak_limit`; an energy residual above `residual_limit`.
template <class R> void watch(const World<R>& w, const Audit& a, const Leaks& leaks = {});

/// What to throw when the step `dt` (us) of w.limiter lies below `minimum`.
template <class R> PhysicsStop collapsed_step(const World<R>& w, double dt);

}  // namespace brisance
