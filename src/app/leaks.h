// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "integrate/watchdog.h"

namespace brisance {

/// Fluid particles that stand inside a solid: its mass fraction around them, sum V W, exceeds 0.6 (it is a half on a wall), or that of all solids 0.85.
template <class R> Leaks find_leaks(const World<R>& w);

}  // namespace brisance
