// SPDX-License-Identifier: Apache-2.0
// Jones-Wilkins-Lee, for detonation products (Eq. 11 of the paper, with E per initial volume, as LS-DYNA has it):
//   P = A (1 - omega/(R1 V)) e^(-R1 V) + B (1 - omega/(R2 V)) e^(-R2 V) + omega E / V,   V = 1/(1 + mu).
#pragma once

#include "laws/eos.h"
#include "math/power.h"

namespace brisance {

struct Jwl {
    static constexpr const char* name = "jwl";
    static constexpr const char* meaning = "Jones-Wilkins-Lee detonation products";
    static std::vector<ParameterInfo> parameters() {
        return {{"A", dimension::pressure, "first coefficient", 0, 1e5},   {"B", dimension::pressure, "second coefficient", -1e4, 1e4},
                {"R1", dimension::none, "first exponent", 0.1, 50},         {"R2", dimension::none, "second exponent", 0.01, 50},
                {"omega", dimension::none, "Grueneisen's omega", 0.01, 5},  {"E0", dimension::pressure, "energy per initial volume", 1e-6, 1e3}};
    }
    explicit Jwl(const ParameterSet& p)
        : A(p.at("A").value), B(p.at("B").value), r1(p.at("R1").value), r2(p.at("R2").value), omega(p.at("omega").value),
          e0(p.at("E0").value) {}
    double initial_energy() const { return e0; }
    double pressure_floor() const { return 0; }

    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using R = ScalarOf<V>;
        const V eta = vmax(R(1) + mu, broadcast<V>(R(1e-6)));
        const V v = R(1) / eta;
        const V e1 = R(A) * exponential(R(-r1) * v), e2 = R(B) * exponential(R(-r2) * v);
        const V q1 = R(omega / r1) * eta, q2 = R(omega / r2) * eta;
        // d/dmu of e^(-R V) is R V^2 e^(-R V)
        return {(R(1) - q1) * e1 + (R(1) - q2) * e2, R(omega) * eta,
                e1 * ((R(1) - q1) * R(r1) * v * v - R(omega / r1)) + e2 * ((R(1) - q2) * R(r2) * v * v - R(omega / r2)),
                broadcast<V>(R(omega))};
    }

    double A, B, r1, r2, omega, e0;
};

}  // namespace brisance
