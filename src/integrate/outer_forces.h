// SPDX-License-Identifier: Apache-2.0
// Contact between parts, platens and loads, and the work they do.
#pragma once

#include "integrate/world.h"

namespace brisance {

/// Forces at the world's time, from positions of that time and velocities half a step before. Sets contact_report, force_from_outside.
template <class R> void outer_forces(World<R>& w);

/// Half of a kick's work of these forces, with the velocity as it stands: called before and after the kick it makes f.(v- + v+)/2.
template <class R> void book_outer_work(World<R>& w, const SolidPart<R>& s, double kick);
void book_outer_work(Ledger& ledger, const FluidPart& f, double kick);

}  // namespace brisance
