// SPDX-License-Identifier: Apache-2.0
// P = (gamma - 1) rho e = (gamma - 1) (1 + mu) E, E per initial volume.
#pragma once

#include "laws/eos.h"

namespace brisance {

struct IdealGas {
    static constexpr const char* name = "ideal_gas";
    static constexpr const char* meaning = "P = (gamma - 1) rho e";
    static std::vector<ParameterInfo> parameters() {
        return {{"gamma", dimension::none, "ratio of specific heats", 1.0001, 10},
                {"E0", dimension::pressure, "initial internal energy per initial volume", 0, 1e3}};
    }
    explicit IdealGas(const ParameterSet& p) : g1(p.at("gamma").value - 1), e0(p.at("E0").value) {}
    double initial_energy() const { return e0; }
    double pressure_floor() const { return 0; }

    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using R = ScalarOf<V>;
        return {V{}, R(g1) * (R(1) + mu), V{}, broadcast<V>(R(g1))};
    }

    double g1, e0;
};

}  // namespace brisance
