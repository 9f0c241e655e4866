// SPDX-License-Identifier: Apache-2.0
// Why a particle failed: a label from the largest stresses that it saw up to its failure. It steers nothing; damage does.
#pragma once

#include "math/hd.h"

#include <cstdint>

namespace brisance::analysis {

enum class Cause : std::uint8_t { none = 0, tensile = 1, shear = 2, mixed = 3 };

/// The cause of a failure. Tension is positive.
///   sigma_1  largest principal stress reached before failure, GPa
///   tau_max  largest shear stress, (sigma_1 - sigma_3) / 2, reached before failure, GPa
///   tensile_strength, shear_strength  0.100 and 0.265 GPa for the granite of the paper
/// Exactly one strength passed: that one is the cause. Both or neither passed: mixed. Neither happens where a particle is worn
/// down by plastic work below both strengths. A strength that is not positive counts as not given, and is never passed.
BRISANCE_HD constexpr Cause cause_of_failure(double sigma_1, double tau_max, double tensile_strength, double shear_strength) {
    const bool tensile = tensile_strength > 0 && sigma_1 > tensile_strength;
    const bool shear = shear_strength > 0 && tau_max > shear_strength;
    if (tensile == shear) return Cause::mixed;
    return tensile ? Cause::tensile : Cause::shear;
}

}  // namespace brisance::analysis
