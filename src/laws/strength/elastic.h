// SPDX-License-Identifier: Apache-2.0
// Hypoelastic: s grows with 2 G dev d, without limit. For elastic verification. It never damages of itself; its column holds what the
// strengths of [part.NAME.failure] say.
#pragma once

#include "laws/strength.h"

namespace brisance {

struct Elastic {
    static constexpr const char* name = "elastic";
    static constexpr const char* meaning = "linear elastic shear, no yield";
    static std::vector<ParameterInfo> parameters() { return {{"G", dimension::pressure, "shear modulus", 0, 1e4}}; }
    static std::vector<StateInfo> state() { return {{"damage", "-", "failed by a strength of the case", 0}}; }
    Elastic(const ParameterSet& p, const Eos&, double) : G(p.at("G").value) {}
    double shear_modulus() const { return G; }

    template <class V> BRISANCE_HD void update(SolidPoint<V>& p) const {
        using R = ScalarOf<V>;
        p.s = elastic_trial(p, R(2 * G));
        p.yield = broadcast<V>(R(1e30));
        p.shear_stiffness = broadcast<V>(R(4.0 / 3.0 * G));
        p.integrity = broadcast<V>(R(1));
    }

    double G;
};

}  // namespace brisance
