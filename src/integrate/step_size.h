// SPDX-License-Identifier: Apache-2.0
// How long a step may be, who holds it, and which parts take long ones.
#pragma once

#include "integrate/world.h"

namespace brisance {

/// Longest run of short steps within a long one: contact forces foreseen for half of it must stay honest.
constexpr double most_short_steps = 16;

/// Decides which solids are slow, and the length of the coming step: that of the slow solids, or a short one where there are none.
/// Throws PhysicsStop when the step of the fast parts falls below the limit.
template <class R> double choose_step(World<R>& w, double until);
/// The next short step on the way to `end`, which it divides without a splinter.
template <class R> double choose_short_step(World<R>& w, double end);

}  // namespace brisance
