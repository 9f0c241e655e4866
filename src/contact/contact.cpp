// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include "exec/launch.h"

#include <algorithm>
#include <cmath>

namespace brisance {

void FluidForces::begin(const FluidBody& body) {
    const auto n = static_cast<std::size_t>(body.size());
    for (auto* a : {&fx, &fy, &fz, &spacing, &modulus})
        if (a->size() != n) {
            const exec::HostAccess host;
            a->resize(n);
        }
    const FluidView b = view(body);
    double *const x = fx.data(), *const y = fy.data(), *const z = fz.data(), *const s = spacing.data(), *const m = modulus.data();
    largest_spacing = exec::launch_max(b.n, 0.0, BRISANCE_KERNEL(std::int64_t i) {
        x[i] = y[i] = z[i] = 0;
        s[i] = b.current_spacing(i);
        m[i] = std::max(b.rho_now[i] * b.sound[i] * b.sound[i], 1e-9);
        return s[i];
    });
}

double clearance(const double* ax, const double* ay, const double* az, std::int64_t na, const double* bx, const double* by, const double* bz,
                 std::int64_t nb, double range, double horizon, double z_low, double period) {
    const double reach = range + horizon;
    static CellGrid kept;  // for its memory; contact is not re-entrant
    kept.build(bx, by, bz, nb, 0.5 * reach, reach, z_low, period);
    const CellGridView grid = kept.view();
    const double nearest = -exec::launch_max(na, -reach, BRISANCE_KERNEL(std::int64_t n) {
        double least = reach * reach;
        grid.ranges(ax[n], ay[n], az[n], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const std::int64_t j = grid.index[k];
                const double dx = ax[n] - bx[j], dy = ay[n] - by[j], dz = az[n] - bz[j] - grid.shift[k];
                least = std::min(least, dx * dx + dy * dy + dz * dz);
            }
        });
        return -std::sqrt(least);
    });
    return std::max(0.0, nearest - range);
}

}  // namespace brisance
