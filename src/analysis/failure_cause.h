// SPDX-License-Identifier: Apache-2.0
// Why a particle failed: a label from the largest stresses that it saw up to its failure. It steers nothing; damage does.
#pragma once

#include "base/hd.h"

#include <cstdint>

namespace brisance::analysis {

enum class Cause : std::uint8_t { none = 0, tensile = 1, shear = 2, mixed = 3 };

/// The cause of a failure. Tension is positive.
///   sigma_1  largest principal stress reached before failure, GPa
///   tau_max  largest shear stress, (sigma_1 - sigma_3) / 2, reached before failure, GPa
///   tensile_strength, shear_strength  0.100 and 0.265 GPa for the granite of the paper
/// Exactly one strength passed: that one is the cause. Both: mixed. Neither: the one that came nearer, as in a spall, where tension from
/// all sides fails the rock before one principal stress reaches the uniaxial strength. A strength that is not positive counts as not
/// given, and is never passed; without any the cause is mixed.
BRISANCE_HD constexpr Cause cause_of_failure(double sigma_1, double tau_max, double tensile_strength, double shear_strength) {
    const double tension = tensile_strength > 0 ? sigma_1 / tensile_strength : 0, shear = shear_strength > 0 ? tau_max / shear_strength : 0;
    if ((tension > 1 && shear > 1) || tension == shear) return Cause::mixed;
    return tension > shear ? Cause::tensile : Cause::shear;
}

}  // namespace brisance::analysis
