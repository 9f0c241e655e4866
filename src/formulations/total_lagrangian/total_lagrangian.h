// SPDX-License-Identifier: Apache-2.0
// Total-Lagrangian SPH on columns. A step is: stress (F, law, T) -> forces and kick -> drift.
//
//   g_ij = w_ij xi_ij                                    corrected gradient, K_i = sum w xi (x) xi
//   F_i  = I + [sum w (u_j - u_i) (x) xi] K_i^-1
//   f_i  = V_i { sum w (T_i + T_j) xi + sum w (a_i + a_j) (u_j - u_i) },   T = P K^-1 - a (F - I)
//
// Zero-energy control. The potential  E = sum_i V_i a_i/2 sum_j w_ij |x_ij - F_i xi_ij|^2  measures what F_i does not see. F_i is
// its own least-squares fit, dE/dF_i = 0, so the gradient of E is exactly the a-terms above: the control conserves energy, linear and
// angular momentum, vanishes for linear fields, and costs no square root and no division per bond.
#pragma once

#include "neighbours/column_pairs.h"
#include "particles/body_sums.h"
#include "particles/solid_body.h"

namespace brisance {

/// What a stress pass reports.
struct StressReport {
    double rate = 0;             ///< 1/us; the largest c/(spacing stretch): the step must stay below courant * tau / rate
    double zero_energy_lost = 0; ///< J, set free this step where damage softened the control
    double bulk_viscous = 0;     ///< J, part of the internal energy made by bulk viscosity this step
    std::int64_t torn = 0;       ///< particles taken out this step
    std::int64_t fastest = -1;   ///< first slot of the tile with that rate, for messages
};

/// Gives the periodic images of a new body what its particles have.
template <class R>
void complete(SolidBody<R>& body);

/// Pass 1: deformation, law, stress at t_n+1. `dt` is the drift that led here, `kick` the mean of that drift and the one before:
/// with them the energy of every particle follows the kicks exactly, for any sequence of steps (docs/theory/integration-and-energy.md).
template <class R>
StressReport stress(SolidBody<R>& body, const ColumnPairs<R>& pairs, double time, double dt, double kick);

/// Pass 2: v += kick f/m from stress, zero-energy control and, where asked, pairwise viscosity, whose heat goes into `energy`.
/// Returns the viscous heat in J.
template <class R>
double kick(SolidBody<R>& body, const ColumnPairs<R>& pairs, double kick);

/// x += dt v, `kick` being the kick just done. With pairwise viscosity the heat was taken with velocities extrapolated to t_n, while the
/// force worked with the mean of before and after the kick: the difference goes into `energy` here, so the balance is exact.
template <class R>
void drift(SolidBody<R>& body, double dt, double kick);

/// The energy that the zero-energy control has stored, J, after a drift of `dt`: sum V a/2 sum w e_n.e_n-1 with e = x_ij - F xi_ij. This
/// product, and not e_n^2, is what leapfrog exchanges with the kinetic energy of v_n-1/2: for a linear force and equal steps the sum of
/// the two stays to round-off. With dt = 0 it is the potential at rest.
template <class R>
double control_energy(const SolidBody<R>& body, const ColumnPairs<R>& pairs, double dt);

/// Cauchy deviators of a tile's particles at the t_n of its last stress pass, GPa: s[l] is that of slot base + l; layout.width of them.
template <class R>
void deviators(const SolidBody<R>& body, const ColumnPairs<R>& pairs, const Tile& tile, Sym3<double>* s);

/// Of v as it stands.
template <class R>
BodySums sums(const SolidBody<R>& body);

/// The stable step of the stencil is tau spacing/c, with h in spacings and the stiffness a of the control over the longitudinal modulus
/// (up to 1). A fit from below to free corners and edges, where K^-1 is largest; inside a body the limit is up to 1.7 times as long
/// (tests/unit/total_lagrangian_test.cpp, StableStepOfBodiesWithWalls).
inline double stencil_tau(double smoothing, double zero_energy) { return 1.08 * smoothing - 0.27 * zero_energy; }

}  // namespace brisance
