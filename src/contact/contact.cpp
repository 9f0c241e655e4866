// SPDX-License-Identifier: Apache-2.0
#include "contact/contact.h"

#include <algorithm>
#include <cmath>

namespace brisance {

void FluidForces::begin(const FluidBody& body) {
    const std::size_t n = body.mass.size();
    for (auto* a : {&fx, &fy, &fz}) a->assign(n, 0);
    spacing.resize(n);
    modulus.resize(n);
    exec::for_each(body.size(), [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        spacing[i] = body.current_spacing(i);
        modulus[i] = std::max(body.rho_now[i] * body.sound[i] * body.sound[i], 1e-9);
    }, 1024);
    largest_spacing = 0;
    for (double s : spacing) largest_spacing = std::max(largest_spacing, s);
}

double clearance(const double* ax, const double* ay, const double* az, std::int64_t na, const double* bx, const double* by, const double* bz,
                 std::int64_t nb, double range, double horizon, double z_low, double period) {
    const double reach = range + horizon;
    static CellGrid grid;
    grid.build(bx, by, bz, nb, 0.5 * reach, reach, z_low, period);
    const double nearest = -exec::max(na, -reach, [&](std::int64_t n) {
        double least = reach * reach;
        grid.ranges(ax[n], ay[n], az[n], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last; ++k) {
                const std::int64_t j = grid.index(k);
                const double dx = ax[n] - bx[j], dy = ay[n] - by[j], dz = az[n] - bz[j] - grid.shift(k);
                least = std::min(least, dx * dx + dy * dy + dz * dz);
            }
        });
        return -std::sqrt(least);
    });
    return std::max(0.0, nearest - range);
}

}  // namespace brisance
