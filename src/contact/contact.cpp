// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include "contact/chosen_points.h"
#include "neighbours/box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brisance {

void FluidForces::begin(const FluidBody& body) {
    const auto n = static_cast<std::size_t>(body.size());
    for (auto* a : {&fx, &fy, &fz, &spacing, &modulus, &press, &near})
        if (a->size() != n) {
            const exec::HostAccess host;
            a->resize(n);
        }
    const FluidView b = view(body);
    double *const x = fx.data(), *const y = fy.data(), *const z = fz.data(), *const s = spacing.data(), *const m = modulus.data(), *const p = press.data(), *const w = near.data();
    const double widest = body.options.h_max * body.spacing, narrowest = body.options.h_min * body.spacing;
    largest_spacing = exec::launch_max(b.n, 0.0, BRISANCE_KERNEL(std::int64_t i) {
        x[i] = y[i] = z[i] = p[i] = w[i] = 0;
        s[i] = std::min(b.current_spacing(i), widest);
        // The step counts on supports, which do not fall below h_min. What is crushed further would ring: K d/m = (c/kappa)^2 d/kappa.
        const double crushed = std::min(s[i] / narrowest, 1.0);
        m[i] = std::max(b.rho_now[i] * b.sound[i] * b.sound[i] * crushed * crushed * crushed, 1e-9);
        return s[i];
    });
    grouped = false;
}

NodeGroupsView FluidForces::group(const FluidBody& body) {
    if (!grouped) groups.build(body.x[0].data(), body.x[1].data(), body.x[2].data(), body.size(), 3 * body.spacing);
    grouped = true;
    return groups.view();
}

double clearance(const Places& a, const Places& b, double range, double horizon, double z_low, double period) {
    constexpr int depth = 5;
    const double reach = range + horizon;
    static ChosenPoints beside;  // kept for its memory; contact is not re-entrant
    const PointBox box = box_of(a.x, a.y, a.z, a.n);
    std::int32_t* const list = beside.list(b.n);
    const std::int64_t count = exec::select(b.n, BRISANCE_KERNEL(std::int64_t i) { return box.beside(b.x[i], b.y[i], reach); },
                                            BRISANCE_KERNEL(std::int64_t i, std::int64_t k) { list[k] = static_cast<std::int32_t>(i); });
    beside.build(b.x, b.y, b.z, count, reach / depth, reach, z_low, period, std::numeric_limits<std::int64_t>::max(), depth, true);
    const RingMapView rings = beside.view();
    const double nearest = -exec::launch_max(a.n, -reach, BRISANCE_KERNEL(std::int64_t i) { return -rings.bound({a.x[i], a.y[i], a.z[i]}); });
    return std::max(0.0, nearest - range);
}

}  // namespace brisance
