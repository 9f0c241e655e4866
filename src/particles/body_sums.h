// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/hd.h"

#include <cstdint>

namespace brisance {

/// What the audit wants of a body, of any formulation: energies in J, momentum in mg mm/us.
struct BodySums {
    double kinetic = 0;   ///< sum m v^2/2, of v as it stands
    double internal = 0;
    double unburnt = 0;   ///< of `internal`: chemical energy not yet released
    double px = 0, py = 0, pz = 0;
    double mass = 0;      ///< mg
    std::int64_t damaged = 0;
    BRISANCE_HD BodySums& operator+=(const BodySums& o) {
        kinetic += o.kinetic;
        internal += o.internal;
        unburnt += o.unburnt;
        px += o.px;
        py += o.py;
        pz += o.pz;
        mass += o.mass;
        damaged += o.damaged;
        return *this;
    }
};

}  // namespace brisance
