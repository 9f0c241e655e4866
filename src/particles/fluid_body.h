// SPDX-License-Identifier: Apache-2.0
// State of an updated-Lagrangian part: gas, water, polymer. Particles keep their places in these arrays for ever, so that results do not
// depend on how neighbours are found; the neighbour search makes its own sorted copies (neighbours/cell_grid.h).
// Times: x at t_n; v, rho, e at t_n-1/2 before the kick and t_n+1/2 after it; the *_now columns extrapolate them to t_n.
#pragma once

#include "base/hd.h"
#include "exec/memory.h"
#include "laws/material.h"

#include <array>
#include <string>

namespace brisance {

struct FluidOptions {
    double smoothing = 1.3;
    double alpha = 1, beta = 2;         ///< Monaghan viscosity
    double linear = 0, quadratic = 0;   ///< bulk viscosity
    bool artificial_stress = false;
    double epsilon = 0.5, n = 4;        ///< of the artificial stress, Eq. 7
    double h_min = 0.5, h_max = 5;      ///< limits of h over its initial value
};

/// A plane of symmetry, normal to an axis: the flow beyond is the flow before it, mirrored.
struct Mirror {
    int axis = 0;       ///< 0, 1, 2: x, y, z
    double at = 0;      ///< its place on that axis, mm
};

struct FluidBody {
    std::string name;
    Material material;
    FluidOptions options;
    double spacing = 0;                 ///< initial, mm
    double z_low = 0, period = 0;       ///< periodic in z when period > 0, mm

    std::vector<Mirror> mirrors;

    std::array<Array<double>, 3> x, v, v_now, acceleration;  ///< mm, mm/us, mm/us2
    Array<double> mass;                 ///< mg
    Array<double> rho, rho_now, rho_rate;   ///< g/cm3; rate relative: d(ln rho)/dt, 1/us
    Array<double> e, e_now, e_rate;         ///< specific internal energy, km2/s2 (= kJ/g)
    Array<double> pressure, sound, h;       ///< GPa, mm/us, mm
    Array<double> rho_start;            ///< g/cm3, where it differs from the material's; else empty
    Array<double> lit;                  ///< us, when the detonation arrives (burn only)
    Array<double> burnt;                ///< fraction
    Array<double> peak_pressure;        ///< GPa
    std::array<Array<double>, 3> reference;  ///< initial positions, mm

    std::int64_t size() const { return static_cast<std::int64_t>(mass.size()); }
    double current_spacing(std::size_t i) const { return std::cbrt(mass[i] / rho_now[i]); }
};

/// A body as kernels take it: bare pointers by particle.
struct FluidView {
    double *x[3], *v[3], *v_now[3], *acceleration[3];
    double *mass, *rho, *rho_now, *rho_rate, *e, *e_now, *e_rate, *pressure, *sound, *h, *rho_start, *lit, *burnt, *peak_pressure;
    std::int64_t n;
    double spacing, z_low, period, density;   ///< density: of the material at rest
    BRISANCE_HD double current_spacing(std::int64_t i) const { return std::cbrt(mass[i] / rho_now[i]); }
    BRISANCE_HD double initial_density(std::int64_t i) const { return rho_start ? rho_start[i] : density; }
};
/// Kernels that only read take it too, so that a body that is constant has one.
inline FluidView view(const FluidBody& constant) {
    auto& b = const_cast<FluidBody&>(constant);
    FluidView v{};
    take_pointers(v.x, b.x);
    take_pointers(v.v, b.v);
    take_pointers(v.v_now, b.v_now);
    take_pointers(v.acceleration, b.acceleration);
    v.mass = b.mass.data();
    v.rho = b.rho.data();
    v.rho_now = b.rho_now.data();
    v.rho_rate = b.rho_rate.data();
    v.e = b.e.data();
    v.e_now = b.e_now.data();
    v.e_rate = b.e_rate.data();
    v.pressure = b.pressure.data();
    v.sound = b.sound.data();
    v.h = b.h.data();
    v.rho_start = b.rho_start.empty() ? nullptr : b.rho_start.data();
    v.lit = b.lit.data();
    v.burnt = b.burnt.data();
    v.peak_pressure = b.peak_pressure.data();
    v.n = b.size();
    v.spacing = b.spacing;
    v.z_low = b.z_low;
    v.period = b.period;
    v.density = b.material.density;
    return v;
}

inline void resize(FluidBody& b, std::size_t n) {
    for (auto* group : {&b.x, &b.v, &b.v_now, &b.acceleration, &b.reference})
        for (auto& a : *group) a.assign(n, 0);
    for (auto* a : {&b.mass, &b.rho, &b.rho_now, &b.rho_rate, &b.e, &b.e_now, &b.e_rate, &b.pressure, &b.sound, &b.h, &b.lit, &b.burnt,
                    &b.peak_pressure})
        a->assign(n, 0);
}

}  // namespace brisance
