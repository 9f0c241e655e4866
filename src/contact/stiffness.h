// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/contact.h"

#include <algorithm>

namespace brisance {

/// Two springs in a row.
BRISANCE_HD inline double series(double a, double b) { return a * b / std::max(a + b, 1e-12); }

/// The hardest spring that the step bears, for a reduced mass; GPa mm.
BRISANCE_HD inline double hardest(double m_star, const ContactOptions& o) { return o.dt > 0 ? 0.1 * m_star / (o.dt * o.dt) : 0.0; }

}  // namespace brisance
