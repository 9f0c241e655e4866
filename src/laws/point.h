// SPDX-License-Identifier: Apache-2.0
// The step of one material point: energy, pressure and strength at the end of a strain increment. Particles of a body and the
// single-point driver go through the same lines.
#pragma once

#include "laws/laws.h"

namespace brisance {

/// Pressure at p.mu and p.energy, then the strength law where there is one. Wants p.d, p.s (rotated), p.dt, p.scale and p.state. Returns rho_0 c^2 of the
/// equation of state (GPa), not below 0. `laws`: laws/laws.h.
template <class V, class Laws> BRISANCE_HD inline V respond(const Laws& laws, SolidPoint<V>& p, const EosTerms<V>& t) {
    using R = ScalarOf<V>;
    p.pressure = vmax(eos_pressure(t, p.energy), broadcast<V>(static_cast<R>(laws.floor)));
    const V bulk = vmax(eos_stiffness(t, p.mu, p.energy, p.pressure), V{});
    laws.update(p);
    return bulk;
}

/// The end of a step at the volume ratio `jacobian`. `energy` (GPa) has the work of the old stress over half of the step in it already;
/// the half of the new stress closes implicitly, P = a + b E being linear:
///   E = [energy + J/2 s:d - J/2 tr d a]/(1 + J/2 tr d b)
/// `lift`, where given, is a pressure that the equation of state does not know: that of an open crack (laws/crack_band.h).
template <class V, class Laws> BRISANCE_HD inline V advance(const Laws& laws, SolidPoint<V>& p, V jacobian, V energy, const V* lift = nullptr) {
    using R = ScalarOf<V>;
    p.mu = R(1) / jacobian - R(1);
    EosTerms<V> t = laws.terms(p.mu);
    if (lift) t.a += *lift;
    const V half_volume = R(0.5) * jacobian * trace(p.d);
    p.energy = (energy + R(0.5) * jacobian * ddot(p.s, p.d) - half_volume * t.a) / (R(1) + half_volume * t.b);
    return respond(laws, p, t);
}

}  // namespace brisance
