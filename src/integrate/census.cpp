// SPDX-License-Identifier: Apache-2.0
#include "integrate/census.h"

#include "exec/launch.h"

#include <cmath>

namespace brisance {

namespace {

BRISANCE_HD Census one(std::int64_t i, double speed, bool finite) {
    Census c;
    if (finite) {
        c.most = speed;
        c.fastest = i;
    } else {
        c.lost = 1;
        c.first_lost = i;
    }
    return c;
}

template <class T>
BRISANCE_HD double size_of(T* const (&a)[3], std::int64_t i) {
    const double x = static_cast<double>(a[0][i]), y = static_cast<double>(a[1][i]), z = static_cast<double>(a[2][i]);
    return std::sqrt(x * x + y * y + z * z);
}

template <class R>
struct SolidCensus {
    SolidView<R> b;
    BRISANCE_HD Census operator()(std::int64_t i) const {
        if (!(b.flags[i] & slot_own)) return {};
        const double v = size_of(b.v, i);
        return one(i, v, std::isfinite(v + size_of(b.u, i) + static_cast<double>(b.energy[i]) + static_cast<double>(b.pressure[i])));
    }
};

struct FluidCensus {
    FluidView b;
    BRISANCE_HD Census operator()(std::int64_t i) const {
        const double v = size_of(b.v, i);
        return one(i, v, std::isfinite(v + size_of(b.x, i) + b.e[i] + b.rho[i] + b.pressure[i]));
    }
};

}  // namespace

template <class R>
Census census(const SolidBody<R>& body) { return exec::launch_sum(body.layout.slots, Census{}, SolidCensus<R>{view(body)}); }
Census census(const FluidBody& body) { return exec::launch_sum(body.size(), Census{}, FluidCensus{view(body)}); }

template Census census(const SolidBody<double>&);
template Census census(const SolidBody<float>&);

}  // namespace brisance
