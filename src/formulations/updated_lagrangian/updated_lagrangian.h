// SPDX-License-Identifier: Apache-2.0
// Updated-Lagrangian SPH for fluids (P only), with r = x_i - x_j, v = v_i - v_j, h = (h_i + h_j)/2, V = m/rho:
//   d rho_i/dt = rho_i sum V_j v . L_i grad_i W                                                    Eq. 4, its sign made explicit
//   dv_i/dt    = -1/rho_i sum V_j ((P + q)_i L_i + (P + q)_j L_j) grad_i W - sum m_j (Pi_ij - (R_i + R_j) f^n) grad_i W       Eq. 5
//   de_i/dt    = (P + q)_i/rho_i^2 d rho_i/dt + 1/2 sum m_j (Pi_ij - (R_i + R_j) f^n) v . grad_i W        Eq. 6 as it must read
//   q = rho e (C_q e - C_l c) where e = h div v < 0; it resists compression alone. Pi resists shear as well: in the sheath of a cord, which
//   thins as it widens, that costs a tenth of the blast.
//   Pi_ij = (-alpha c mu + beta mu^2)/rho, mu = h v.r/(r^2 + 0.01 h^2) where v.r < 0
//   R_i = -eps sigma_i/rho_i^2 in tension (a fluid: sigma = -P), f = W(r, h)/W(spacing, h)         Eq. 7
// L_i = M_i^-1, M_i = -sum V_j r (x) grad_i W, makes div v exact for a velocity that is linear in space, at a free surface too (Randles &
// Libersky 1996); the force is the partner of that divergence (Bonet & Lok 1999): what it does is -P dV of each particle, so energy and
// linear momentum are exact and smooth flow makes no entropy. The paper's equations are those with L = 1: a charge of four particles'
// radius is then mostly surface, believes to expand by half of what it does, and keeps energy that the rock should get
// (docs/theory/fluids.md).
#pragma once

#include "neighbours/neighbour_lists.h"
#include "math/vec.h"
#include "particles/body_sums.h"
#include "particles/mirrored.h"

namespace brisance {

/// What a fluid's step makes besides its body, as kernels take it. Entries: particles and their images, in the order of the grid.
struct FluidWork {
    CellGridView grid;
    MirroredView points;
    NeighbourListsView neighbours;
    float *x, *y, *z, *h;          ///< of the entries, from the grid's corner: for the search
    double *motion, *response;     ///< records of the entries: x y z h, m/rho, v; and: rho, c, (P + q) L
    double* resistance;            ///< R of the entries, where there is tension
    Sym3<double>* correction;      ///< L of the particles
    double *mu, *q;                ///< of the particles: |mu| that the step counts, and bulk viscosity, GPa
    double *missing, *unseen;      ///< of the particles: 1 - tr(M)/3, the share of their surroundings without their kind, and 1 - tr(L M)/3, what of it L does not restore
    std::int64_t n;                ///< particles

    /// Whether an entry of the grid stands for another particle: beyond the period, or beyond a mirror.
    BRISANCE_HD bool image(std::int64_t k) const { return grid.shift[k] != 0 || grid.index[k] >= n; }
    /// The particle that an entry stands for.
    BRISANCE_HD std::int64_t particle(std::int64_t k) const { return points.particle(grid.index[k]); }
    /// Signs of a vector's components at an entry: -1 across a mirror.
    BRISANCE_HD double sign(std::int64_t k, int axis) const { return points.sign(grid.index[k], axis); }
};

class FluidSolver {
public:
    /// Sets rho, e, P, c, h of the state at t_n (extrapolated), with burn fractions where the material burns.
    void state(FluidBody& body, double time);
    /// Neighbours, and the rates of v, rho, e at t_n.
    /// Returns the viscous power and the power of the artificial stress, W = J/us.
    struct Powers {
        double viscous = 0, artificial = 0;
        BRISANCE_HD Powers& operator+=(const Powers& o) {
            viscous += o.viscous;
            artificial += o.artificial;
            return *this;
        }
    };
    Powers rates(FluidBody& body);
    /// A particle in a sheet, or alone among those of another part, learns nothing of its volume from its own kind: it would keep its density
    /// whatever presses on it, and gas in the midst of a liquid under pressure would be as light as at the start, and be thrown about until it
    /// is hot enough to bear that pressure at that density. It follows the pressure p of the fluid that touches it, isentropically, as fast as
    /// the difference lets its surface move:
    ///   d ln V/dt = b^2 (P - p)/(kappa sqrt(rho (rho c^2 + |P - p|))),   de/dt = -P/rho d ln V/dt
    /// but expands no further than to its initial density: drops of liquid bear no pressure, and yet leave gas between them no room.
    /// b = [1 - tr(L M)/3]/[1 - tr(M)/3] is 0.1 at a plane surface, where L sees enough, and 1 in a sheet. `press` and `near` as FluidForces has
    /// them. Adds to the rates of rho and e; gives the power, W = J/us, which comes from contact.
    double equalise(FluidBody& body, const double* press, const double* near, double dt);
    /// v, rho, e over a kick, with the outer forces (mN) on each particle. The heat of a pair was taken with velocities extrapolated to
    /// t_n; what its force did was with the mean of before and after the kick. The difference, f_i.(v_mean - v_now), goes back into e_i,
    /// so that kinetic and internal energy together change by the work of the outer forces alone, to round-off.
    void kick(FluidBody& body, double kick, const double* fx, const double* fy, const double* fz);
    /// x, and the extrapolation to the next t_n.
    void drift(FluidBody& body, double dt);
    /// The largest stable rate 1/dt before the Courant factor: (c + 0.6 (alpha c + beta |mu|))/h and sqrt(|a|/h), 1/us, with
    ///   |mu| = min(max_j |mu_ij|, 1.2 h^2 sum_j m_j/rho_ij (-W'/r) |mu_ij|).
    /// The sum is what the viscosity does to the particle. In a plane compression its integral is the largest mu; as a sum it lacks the particle's
    /// own place, a seventh at 1.3 spacings, hence 1.2. A pair that stands close has a mu of up to five times its velocity, but the weight of one
    /// pair. A particle without neighbours that nothing touched has no rate, where the outer forces of the step before are given, mN.
    double stable_rate(const FluidBody& body, const double* fx = nullptr, const double* fy = nullptr, const double* fz = nullptr) const;
    /// The particle that holds it.
    std::size_t fastest(const FluidBody& body, const double* fx = nullptr, const double* fy = nullptr, const double* fz = nullptr) const;
    BodySums sums(const FluidBody& body) const;
    /// Mean number of neighbours in the last rates().
    double neighbours_per_particle() const;

private:
    FluidWork sort(const FluidBody& body);

    CellGrid grid_;
    Mirrored points_;
    NeighbourLists neighbours_;
    Array<float> x_, y_, z_, h_;
    Array<double> motion_, response_, resistance_;
    Array<Sym3<double>> correction_;
    Array<double> mu_, q_, missing_, unseen_;
};

/// Lighting times from detonation points: time + distance/D in the initial configuration.
struct Detonator {
    int kind = 0;  ///< 0 point, 1 line, 2 instant
    double from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
    double time = 0;
};
/// When the detonation reaches a place, us; 1e300 without detonators. `speed`: D, mm/us.
double lighting_time(const Vec3<double>& at, const std::vector<Detonator>& detonators, double speed);
void light(FluidBody& body, const std::vector<Detonator>& detonators);

}  // namespace brisance
