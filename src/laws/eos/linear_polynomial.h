// SPDX-License-Identifier: Apache-2.0
// P = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E, with C2 = C6 = 0 in expansion.      Eq. 9 of the paper
// E: internal energy per initial volume. C4 = C5 = gamma - 1 and all others zero: an ideal gas.
#pragma once

#include "laws/eos.h"

namespace brisance {

struct LinearPolynomial {
    static constexpr const char* name = "linear_polynomial";
    static constexpr const char* meaning = "P = C0 + C1 mu + C2 mu^2 + C3 mu^3 + (C4 + C5 mu + C6 mu^2) E";
    static std::vector<ParameterInfo> parameters() {
        std::vector<ParameterInfo> rows;
        for (int i = 0; i < 7; ++i)
            rows.push_back({"C" + std::to_string(i), i < 4 ? dimension::pressure : dimension::none, "coefficient of Eq. 9", -1e6, 1e6});
        rows.push_back({"E0", dimension::pressure, "initial internal energy per initial volume", 0, 1e3});
        return rows;
    }
    explicit LinearPolynomial(const ParameterSet& p) : e0(p.at("E0").value) {
        for (int i = 0; i < 7; ++i) c[i] = p.at("C" + std::to_string(i)).value;
    }
    double initial_energy() const { return e0; }
    /// An energy term makes it a gas or a fluid: neither bears tension.
    double pressure_floor() const { return c[4] > 0 && c[1] <= 0 ? 0.0 : -std::numeric_limits<double>::infinity(); }

    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using R = ScalarOf<V>;
        const V x = vmax(mu, V{});
        return {R(c[0]) + mu * (R(c[1]) + mu * mu * R(c[3])) + R(c[2]) * x * x, R(c[4]) + R(c[5]) * mu + R(c[6]) * x * x,
                R(c[1]) + R(3 * c[3]) * mu * mu + R(2 * c[2]) * x, R(c[5]) + R(2 * c[6]) * x};
    }

    double c[7], e0;
};

}  // namespace brisance
