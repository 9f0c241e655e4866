// SPDX-License-Identifier: Apache-2.0
// What a fracture energy asks of a part, looked at before a run starts (laws/crack_band.h has the equations).
#pragma once

#include "base/error.h"
#include "io/case.h"
#include "laws/crack_band.h"
#include "laws/point_path.h"
#include "particles/solid_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brisance {

/// Throws InputError for a law that has no damage or that fails by itself below the tensile strength,
/// and for spacings at which the band would snap back.
template <class R>
void check_crack_band(SolidBody<R>& b, const FailureData& failure) {
    const Material& m = b.material;
    const std::string at = failure.fracture_energy_where + ": fracture_energy: ";
    const std::vector<StateInfo> columns = m.strength->state();
    if (columns.empty() || columns[0].name != "damage") throw InputError(fmt::format("{}the law {} of {} has no damage that a crack could add to", at, m.strength->law(), m.name));
    PathLeg pull;
    pull.kind = PathLeg::Kind::axial;
    pull.strain.z = 3 * b.options.failure.tensile / m.bulk_modulus();
    double strongest = 0;
    for (const PathPoint& r : drive(m, {"uniaxial tension", {pull}, 1})) strongest = std::max(strongest, r.stress.zz);
    const double strength = b.options.failure.tensile, energy = b.options.failure.fracture_energy;
    if (strongest < 1.05 * strength)
        throw InputError(fmt::format("{}{} fails by itself at {:.1f} MPa in uniaxial tension, before cracks begin at tensile_strength = {:.1f} MPa; allowed: a tensile_strength below {:.1f} MPa",
                                     at, m.name, 1e3 * strongest, 1e3 * strength, 1e3 * strongest / 1.05));
    const double k = m.bulk_modulus(), g = m.strength->shear_modulus(), young = 9 * k * g / (3 * k + g);
    double widest = 0;
    for (const Column& c : b.layout.columns) widest = std::max(widest, crack_band_spacings * std::cbrt(b.volume(c)));
    const double limit = widest_band(young, energy, strength);
    if (widest > limit)
        throw InputError(fmt::format("{}a crack band of {:.3g} mm ({:g} spacings) snaps back: it would dissipate more than {:.3g} J/m2. Allowed: a spacing up to {:.3g} mm, "
                                     "a tensile_strength up to {:.3g} MPa, or a fracture_energy from {:.3g} J/m2 on",
                                     at, widest, crack_band_spacings, 1e6 * energy, limit / crack_band_spacings, 1e3 * std::sqrt(2 * young * energy / widest),
                                     1e6 * widest * strength * strength / (2 * young)));
    // with a strength field: the share of the rock too strong for its spacing
    double brittle = 0, all = 0;
    for (const Column& c : b.layout.columns)
        for (int layer = 0; layer < c.layers; ++layer) {
            const double here = strength * b.strength_scale(static_cast<std::size_t>(c.start + layer));
            brittle += crack_band_spacings * std::cbrt(b.volume(c)) > widest_band(young, energy, here) / 1.05;
            ++all;
        }
    b.material.remarks.push_back(fmt::format("cracks dissipate {:.3g} J/m2 over a band of {:.3g} mm, from {:.3g} MPa on (snap-back from {:.3g} mm on)", 1e6 * energy, widest, 1e3 * strength, limit));
    if (brittle > 0)
        b.material.remarks.push_back(fmt::format("warning: {:.2g} % of the places are so strong that their band is at snap-back: they dissipate more than that", 100 * brittle / all));
}

}  // namespace brisance
