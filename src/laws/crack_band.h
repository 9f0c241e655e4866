// SPDX-License-Identifier: Apache-2.0
// Crack band (Bazant & Oh 1983): tensile failure that dissipates a given energy per area of crack, whatever the spacing.
//
// A crack is smeared over a band of width w. Its opening over w is a strain kappa, and damage is its share of the strain at which the crack
// bears nothing:
//   f = sigma_t (1 - D),  dD = d kappa / kappa_u,  kappa_u = 2 G_f / (sigma_t w)          ->  w int f d kappa = G_f
// Where a principal stress exceeds f the crack opens along its direction n,
//   d kappa = (sigma - f)/(M - sigma_t/kappa_u),   sigma -= d kappa (lambda I + 2 G n n),   M = lambda + 2 G
// the other tensile directions follow in turn. The volume of the crack is remembered, for the pressure of the next step is that of the
// equation of state plus K times it. Where all principal stresses press, it closes as far as none of them becomes tension, so failed rock,
// which bears no shear without pressure, closes its cracks before it is compressed.
// Softening must not outrun unloading: w < 2 E G_f/sigma_t^2 (else the element snaps back and dissipates more than G_f).
#pragma once

#include "math/axes.h"

#include <algorithm>

namespace brisance {

/// Width of the band over which particles smear a crack, in spacings: two layers break, and what is damaged beside them dissipates the rest
/// (tests/unit/physics/crack_band_test.cpp).
inline constexpr double crack_band_spacings = 2.2;

struct CrackBand {
    double strength;      ///< sigma_t of the place, GPa
    double full_strain;   ///< kappa_u
    double bulk, shear;   ///< K, G, GPa
};

/// The widest band that does not snap back: 2 E G_f / sigma_t^2, mm. E, sigma_t in GPa, G_f in J/mm2 (= GPa mm).
BRISANCE_HD inline double widest_band(double young, double fracture_energy, double strength) { return 2 * young * fracture_energy / (strength * strength); }

/// kappa_u of a place; no less than what keeps the softening 5 % off snap-back.
BRISANCE_HD inline double full_strain(double fracture_energy, double strength, double width, double young) {
    return std::max(2 * fracture_energy / (strength * width), 1.05 * strength / young);
}

/// s: deviator; damage and opening (volume strain of the crack) are those of the point.
BRISANCE_HD inline void open_crack(const CrackBand& band, Sym3<double>& s, double& pressure, double& damage, double& opening) {
    if (opening > 0) {  // closing
        const double all_round = std::max(pressure - principal_axes(s).value[0], 0.0), closed = std::min(opening, all_round / band.bulk);
        opening -= closed;
        pressure -= band.bulk * closed;
    }
    const double lambda = band.bulk - 2.0 / 3 * band.shear, axial = lambda + 2 * band.shear, softening = band.strength / band.full_strain;
    for (int turn = 0; turn < 3; ++turn) {
        const double bears = band.strength * (1 - damage);
        const PrincipalAxes now = principal_axes(s);
        const double stress = now.value[0] - pressure;
        if (stress <= bears + 1e-14 * band.bulk) break;
        double grown = (stress - bears) / (axial - softening);
        double d = damage + grown / band.full_strain;
        if (d >= 1) {
            d = 1;
            grown = stress / axial;
        }
        const Vec3<double>& n = now.axis[0];
        const double f = 2 * band.shear * grown;
        s = {s.xx - f * (n.x * n.x - 1.0 / 3), s.yy - f * (n.y * n.y - 1.0 / 3), s.zz - f * (n.z * n.z - 1.0 / 3),
             s.xy - f * n.x * n.y, s.xz - f * n.x * n.z, s.yz - f * n.y * n.z};
        pressure += band.bulk * grown;
        opening += grown;
        damage = d;
    }
}

}  // namespace brisance
