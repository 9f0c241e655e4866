// SPDX-License-Identifier: Apache-2.0
// State of a total-Lagrangian part, one array per component, one slot per particle (particles/columns.h).
// Times: u, R, T and the law's state are at t_n; v is at t_n-1/2 before the kick of step n and at t_n+1/2 after it.
#pragma once

#include "laws/material.h"
#include "math/pack.h"
#include "particles/columns.h"

#include <array>
#include <string>

namespace brisance {

/// When a particle fails beside its law, and what is noted of it. Its cause follows from sigma_1 and tau_max (analysis/failure_cause.h).
struct FailureRule {
    int mode = 0;                       ///< 0: the law alone; 1: no tension, no shear; 2: all stresses vanish (once damage is 1)
    double tensile = 0, shear = 0;      ///< GPa; principal-stress failure as a criterion of its own (0: off)
    double fracture_energy = 0; ///< G_f, J/mm2: tensile failure softens as a crack band (laws/crack_band.h) in place of failing at once; 0: off
    double notice = 0;          ///< GPa; principal stresses are followed where the von Mises stress is above
    double threshold = 0.8;             ///< damage at which a particle counts as failed, and its failure time is noted
};

struct SolidOptions {
    double smoothing = 1.3;
    double zero_energy = 0.05;    ///< stiffness of the zero-energy control over the longitudinal modulus
    bool pairwise = false;
    double alpha = 0, beta = 0;   ///< pairwise viscosity
    double linear = 0, quadratic = 0;  ///< bulk viscosity
    FailureRule failure;
    bool yield = false;           ///< the strength in force is kept, for gauges
};

template <class R>
struct SolidBody {
    std::string name;
    Material material;
    SolidOptions options;
    Columns layout;

    std::array<Array<R>, 3> u, v;   ///< displacement mm, velocity mm/us
    // only with pairwise viscosity: velocity extrapolated to t_n, what extrapolates it, and the viscous force per volume
    std::array<Array<R>, 3> v_now, acceleration, viscous_force;
    std::array<Array<R>, 9> R_sum;  ///< sum w (u_j - u_i) (x) xi = (F - I) K, row-major
    std::array<Array<R>, 9> T;      ///< P K^-1 - a (F - I), GPa: what the stress sum needs, and whence the deviator (formulations/total_lagrangian/stress.cpp)
    Array<R> energy;                ///< internal energy per initial volume, GPa, exact to the kicks done so far
    Array<R> power;                 ///< P : dF/dt at t_n with the velocity of t_n-1/2, GPa/us
    Array<R> stiffness;             ///< a, of the zero-energy control, GPa
    std::vector<Array<R>> state;    ///< the law's columns; of one that is not kept, nothing
    Array<R> scale;                 ///< strength scale of the place; none: 1 everywhere
    Array<R> opening;               ///< volume strain of open cracks; only with a fracture energy
    Array<float> live;              ///< 1: takes part in the sums; 0: padding or torn
    // what analysis wants, in single precision
    Array<float> pressure;                       ///< GPa
    Array<float> peak_pressure, peak_radial;     ///< GPa, largest so far (radial: compression positive)
    Array<float> sigma_1, tau_max;               ///< GPa, largest before failure
    Array<float> failure_time;                   ///< us; negative: whole
    Array<float> yield;                          ///< GPa, strength in force; only where an option asks

    double axis_x = 0, axis_y = 0;   ///< radial stress is taken about this axis

    /// Damage of a slot: by convention the first column of the law's state; 0 for a law without state.
    double damage(std::size_t slot) const { return state.empty() ? 0.0 : static_cast<double>(state[0][slot]); }
    double strength_scale(std::size_t slot) const { return scale.empty() ? 1.0 : static_cast<double>(scale[slot]); }
    double volume(const Column& c) const { return c.area * layout.dz; }
    double mass(const Column& c) const { return material.density * volume(c); }
};

/// A body as kernels take it: bare pointers by slot.
template <class R>
struct SolidView {
    R *u[3], *v[3], *v_now[3], *acceleration[3], *viscous_force[3];
    R *R_sum[9], *T[9];
    R *energy, *power, *stiffness, *scale, *opening;
    R* state[max_law_state];
    float *live, *pressure, *peak_pressure, *peak_radial, *sigma_1, *tau_max, *failure_time, *yield;
    std::uint8_t* flags;
    const Tile* tiles;
    const Column* columns;
    double dz;
    double density;
    std::int32_t packs_shift;  ///< a tile holds 2^this packs

    /// The particles that a kernel treats at once, a pack of a tile.
    BRISANCE_HD Tile pack(std::int64_t g) const {
        const Tile& t = tiles[g >> packs_shift];
        return {t.base + (g - (g >> packs_shift << packs_shift)) * lanes<R>, t.column, t.masked};
    }
    BRISANCE_HD double volume(const Column& c) const { return c.area * dz; }
    BRISANCE_HD double mass(const Column& c) const { return density * volume(c); }
};

/// Kernels that only read take it too, so that a body that is constant has one.
template <class R>
SolidView<R> view(const SolidBody<R>& constant) {
    auto& b = const_cast<SolidBody<R>&>(constant);
    SolidView<R> s{};
    take_pointers(s.u, b.u);
    take_pointers(s.v, b.v);
    take_pointers(s.v_now, b.v_now);
    take_pointers(s.acceleration, b.acceleration);
    take_pointers(s.viscous_force, b.viscous_force);
    take_pointers(s.R_sum, b.R_sum);
    take_pointers(s.T, b.T);
    for (std::size_t k = 0; k < b.state.size(); ++k) s.state[k] = b.state[k].empty() ? nullptr : b.state[k].data();
    s.pressure = b.pressure.data();
    s.energy = b.energy.data();
    s.power = b.power.data();
    s.stiffness = b.stiffness.data();
    s.scale = b.scale.empty() ? nullptr : b.scale.data();
    s.live = b.live.data();
    s.opening = b.opening.data();
    s.peak_pressure = b.peak_pressure.data();
    s.peak_radial = b.peak_radial.data();
    s.sigma_1 = b.sigma_1.data();
    s.tau_max = b.tau_max.data();
    s.failure_time = b.failure_time.data();
    s.yield = b.yield.empty() ? nullptr : b.yield.data();
    s.flags = b.layout.flags.data();
    s.tiles = b.layout.tiles.data();
    s.columns = b.layout.columns.data();
    s.dz = b.layout.dz;
    s.density = b.material.density;
    while ((lanes<R> << s.packs_shift) < b.layout.width) ++s.packs_shift;
    return s;
}
/// Packs of a body: how many items its kernels have.
template <class R>
std::int64_t packs(const SolidBody<R>& b) { return static_cast<std::int64_t>(b.layout.tiles.size()) * (b.layout.width / lanes<R>); }

/// Allocates everything for a layout, at rest and unstressed.
template <class R>
void allocate(SolidBody<R>& b) {
    const auto n = static_cast<std::size_t>(b.layout.slots);
    for (auto* group : {&b.u, &b.v})
        for (auto& a : *group) a.assign(n, R(0));
    if (b.options.pairwise)
        for (auto* group : {&b.v_now, &b.acceleration, &b.viscous_force})
            for (auto& a : *group) a.assign(n, R(0));
    for (auto& a : b.R_sum) a.assign(n, R(0));
    for (auto& a : b.T) a.assign(n, R(0));
    for (auto* a : {&b.energy, &b.power, &b.stiffness}) a->assign(n, R(0));
    if (b.options.failure.fracture_energy > 0) b.opening.assign(n, R(0));
    b.energy.assign(n, R(b.material.eos->initial_energy()));
    b.state.clear();
    for (const StateInfo& info : b.material.strength->state()) b.state.emplace_back(info.kept ? n : 0, R(info.initial));
    for (auto* a : {&b.live, &b.pressure, &b.peak_pressure, &b.peak_radial, &b.sigma_1, &b.tau_max}) a->assign(n, 0.0f);
    if (b.options.yield) b.yield.assign(n, 0.0f);
    b.failure_time.assign(n, -1.0f);
    const R a0 = static_cast<R>(b.options.zero_energy * b.material.longitudinal_modulus());
    for (std::size_t i = 0; i < n; ++i)
        if (b.layout.flags[i] & slot_own) {
            b.live[i] = 1;
            b.stiffness[i] = a0;
        }
}

}  // namespace brisance
