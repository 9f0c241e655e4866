// SPDX-License-Identifier: Apache-2.0
// A material at work: density, equation of state, and where it has them a strength law and a burn law.
#pragma once

#include "laws/eos.h"
#include "laws/strength.h"

namespace brisance {

/// Programmed burn: the detonation speed, and the CJ volume from P_CJ.
struct BurnLaw {
    double speed = 0;        ///< D, mm/us
    double cj_pressure = 0;  ///< GPa
    double cj_volume = 0;    ///< V_CJ = 1 - P_CJ/(rho_0 D^2)
};

struct Material {
    std::string name;
    double density = 0;  ///< rho_0, g/cm3
    EosPtr eos;
    StrengthPtr strength;               ///< null: a fluid
    std::shared_ptr<const BurnLaw> burn;  ///< null: inert
    std::vector<std::string> remarks;   ///< what the consistency checks found

    double bulk_modulus() const { return eos->bulk_modulus(); }
    /// rho_0 c_L^2 at rest, GPa.
    double longitudinal_modulus() const { return bulk_modulus() + (strength ? 4.0 / 3.0 * strength->shear_modulus() : 0); }
    double sound_speed() const { return std::sqrt(longitudinal_modulus() / density); }
};

/// Builds a material from its data. Throws InputError naming file, line, parameter, value and what is allowed for: an unknown law, an
/// unknown, missing or out-of-range parameter, a wrong dimension, c^2 < 0 in the working range. Fills `remarks` from the checks.
Material make_material(const MaterialData& data);

/// The laws that exist, for listings and for the reference pages.
const std::vector<EosEntry>& eos_entries();
const std::vector<StrengthEntry>& strength_entries();
const std::vector<ParameterInfo>& burn_parameters();

/// The Chapman-Jouguet state of an explosive: where the Rayleigh line touches the Hugoniot of the products.
struct CjState {
    double speed, pressure, volume;
};
CjState chapman_jouguet(const Eos& products, double density);

}  // namespace brisance
