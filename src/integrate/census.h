// SPDX-License-Identifier: Apache-2.0
// What the watchdog wants to know of every particle, counted where the particles are.
#pragma once

#include "base/hd.h"
#include "integrate/world.h"

namespace brisance {

struct Census {
    std::int64_t lost = 0, first_lost = -1;  ///< particles that hold a value which is no number, and the first of them
    double most = -1;                        ///< km/s, speed of the fastest of the others
    std::int64_t fastest = -1;
    BRISANCE_HD Census& operator+=(const Census& o) {
        if (lost == 0) first_lost = o.first_lost;
        lost += o.lost;
        if (o.most > most) {
            most = o.most;
            fastest = o.fastest;
        }
        return *this;
    }
};

template <class R> Census census(const SolidBody<R>& body);
Census census(const FluidBody& body);

}  // namespace brisance
