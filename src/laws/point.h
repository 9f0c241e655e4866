// SPDX-License-Identifier: Apache-2.0
// The step of one material point: energy, pressure and strength at the end of a strain increment. Particles of a body and the
// single-point driver go through the same lines.
#pragma once

#include "laws/material.h"

#include <algorithm>
#include <type_traits>

namespace brisance {

/// The terms of the equation of state for a number or a pack of them.
template <class V> inline EosTerms<V> eos_terms(const Eos& eos, V mu) {
    if constexpr (std::is_same_v<V, double>) {
        return eos.terms(mu);
    } else {
        EosTerms<V> t;
        alignas(64) ScalarOf<V> x[lanes_of<V>];
        store(x, mu);
        eos.terms(x, t);
        return t;
    }
}

/// Pressure at p.mu and p.energy, then the strength law where there is one. Wants p.d, p.s (rotated), p.dt, p.scale and p.state. Returns rho_0 c^2 of the
/// equation of state (GPa), not below 0.
template <class V> inline V respond(const Material& m, SolidPoint<V>& p, const EosTerms<V>& t) {
    using R = ScalarOf<V>;
    p.pressure = vmax(eos_pressure(t, p.energy), broadcast<V>(static_cast<R>(std::max(m.eos->pressure_floor(), -1e6))));
    const V bulk = vmax(eos_stiffness(t, p.mu, p.energy, p.pressure), V{});
    if (m.strength) {
        if constexpr (std::is_same_v<V, double>) m.strength->update(p);
        else m.strength->update_pack(p);
    }
    return bulk;
}

/// The end of a step at the volume ratio `jacobian`. `energy` (GPa) has the work of the old stress over half of the step in it already;
/// the half of the new stress closes implicitly, P = a + b E being linear:
///   E = [energy + J/2 s:d - J/2 tr d a]/(1 + J/2 tr d b)
/// `lift`, where given, is a pressure that the equation of state does not know: that of an open crack (laws/crack_band.h).
template <class V> inline V advance(const Material& m, SolidPoint<V>& p, V jacobian, V energy, const V* lift = nullptr) {
    using R = ScalarOf<V>;
    p.mu = R(1) / jacobian - R(1);
    EosTerms<V> t = eos_terms(*m.eos, p.mu);
    if (lift) t.a += *lift;
    const V half_volume = R(0.5) * jacobian * trace(p.d);
    p.energy = (energy + R(0.5) * jacobian * ddot(p.s, p.d) - half_volume * t.a) / (R(1) + half_volume * t.b);
    return respond(m, p, t);
}

}  // namespace brisance
