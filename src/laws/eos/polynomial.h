// SPDX-License-Identifier: Apache-2.0
// The cubic equation of state of Johnson-Holmquist 2 without its bulking term:
//   P = K1 mu + K2 mu^2 + K3 mu^3  (mu > 0),   P = K1 mu  (mu <= 0).      Johnson & Holmquist 1994
#pragma once

#include "laws/eos.h"

namespace brisance {

struct Polynomial {
    static constexpr const char* name = "polynomial";
    static constexpr const char* meaning = "P = K1 mu + K2 mu^2 + K3 mu^3, linear in tension, no energy term";
    static std::vector<ParameterInfo> parameters() {
        return {{"K1", dimension::pressure, "bulk modulus at rest", 1e-6, 1e4},
                {"K2", dimension::pressure, "second coefficient", -1e6, 1e6},
                {"K3", dimension::pressure, "third coefficient", -1e7, 1e7}};
    }
    explicit Polynomial(const ParameterSet& p) : k1(p.at("K1").value), k2(p.at("K2").value), k3(p.at("K3").value), two_k2(2 * k2), three_k3(3 * k3) {}

    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using R = ScalarOf<V>;
        const V x = vmax(mu, V{});
        return {R(k1) * mu + x * x * (R(k2) + R(k3) * x), V{}, R(k1) + x * (R(two_k2) + R(three_k3) * x), V{}};
    }

    double k1, k2, k3;
    double two_k2, three_k3;  // formed once: 2 k2 contracted into the sum would give a point other bits than a pack
};

}  // namespace brisance
