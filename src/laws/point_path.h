// SPDX-License-Identifier: Apache-2.0
// A material driven at one point: along strains, with lateral stresses held, to a pressure, along the Hugoniot, along an isentrope.
// Internal units; stresses positive in tension, pressures in compression.
#pragma once

#include "laws/material.h"

namespace brisance {

/// One leg of a path: `steps` equal steps to a target.
struct PathLeg {
    enum class Kind {
        strain,    ///< engineering strains x, y, z (equal steps of their logarithms) and the simple shear gamma in xy
        axial,     ///< engineering strain z, while the stresses x and y stay at -lateral
        pressure,  ///< equal strains x = y = z to a pressure
        shock,     ///< along the Hugoniot in z to a particle velocity: jump conditions from the state at rest
        volume,    ///< equal strains to V/V_0 (equal steps of the logarithm), adiabatic: an isentrope where nothing dissipates
        cj         ///< to the Chapman-Jouguet state of an explosive, in one step
    };
    Kind kind = Kind::strain;
    Vec3<double> strain{};  ///< of `strain`; z also of `axial`
    double shear = 0;       ///< gamma
    double lateral = 0;     ///< GPa
    double target = 0;      ///< GPa, mm/us or V/V_0
    int steps = 1000;
    double rate = 1e-3;     ///< 1/us, of the largest strain component; it gives the steps their time
};

struct PointPath {
    std::string name;
    std::vector<PathLeg> legs;
    double scale = 1;   ///< strength scale of the place
    double damage = 0;  ///< at the start, of laws that have it as their first column
};

/// The state after one step.
struct PathPoint {
    int leg = 0;
    double time = 0;                ///< us
    Vec3<double> strain{};          ///< engineering strains
    double shear = 0;
    double volume = 1;              ///< V/V_0
    double density = 0;             ///< g/cm3
    Sym3<double> stress{};          ///< GPa
    double pressure = 0, mises = 0, yield = 0;  ///< GPa
    double energy = 0;              ///< internal energy per initial volume, GPa
    double sound_speed = 0;         ///< mm/us: c^2 = c_eos^2 + (4/3 G)/rho
    double particle_velocity = 0, shock_speed = 0;  ///< mm/us, of shock legs
    std::vector<double> state;      ///< the law's columns
};

/// The first row is the state at rest. Throws InputError for a damage that the law has no column for and for a leg that the material cannot go (a CJ leg without a burn law, a Hugoniot
/// state that does not exist), PhysicsStop where a number is not finite.
std::vector<PathPoint> drive(const Material& material, const PointPath& path);

}  // namespace brisance
