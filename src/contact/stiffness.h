// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/contact.h"

#include <algorithm>

namespace brisance {

/// Two springs in a row.
BRISANCE_HD inline double series(double a, double b) { return a * b / std::max(a + b, 1e-12); }

/// The hardest spring that the step bears, for a reduced mass; GPa mm.
BRISANCE_HD inline double hardest(double m_star, const ContactOptions& o) { return o.dt > 0 ? 0.1 * m_star / (o.dt * o.dt) : 0.0; }

/// Damping ratio between a node and what it touches, from their densities. What is ten times lighter, gas between liquids and metals, is
/// damped five times as much, but by no more than a quarter. Thrown to and fro between heavy things that move with u, it would reach
/// (1 + e)/(1 - e) u, e its restitution: 12 u with a ratio of 0.05, as no gas behind a shock does; 2.6 u with 0.25. More is not stable where
/// a dozen heavy nodes surround it: what damps a velocity extrapolated over half a step wants rate x step < 1, and each of the hardest
/// springs brings 2 ratio sqrt(0.1).
BRISANCE_HD inline double damping_ratio(double rho, double other, const ContactOptions& o) {
    const double ratio = std::min(rho, other) / std::max(rho, other), light = std::max(1 - 10 * ratio, 0.0);
    return o.damping + light * std::min(4 * o.damping, std::max(0.25 - o.damping, 0.0));
}

}  // namespace brisance
