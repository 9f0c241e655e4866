// SPDX-License-Identifier: Apache-2.0
// Mie-Grueneisen in the form of LS-DYNA's *EOS_GRUNEISEN:
//   mu > 0:  P = rho_0 C^2 mu [1 + (1 - Gamma_0/2) mu - (a/2) mu^2] / [1 - (S1-1) mu - S2 mu^2/(1+mu) - S3 mu^3/(1+mu)^2]^2 + (Gamma_0 + a mu) E
//   mu <= 0: P = rho_0 C^2 mu + (Gamma_0 + a mu) E
// Below half of the initial density the last term is multiplied by 2 rho/rho_0, which LS-DYNA does not do. Without it matter with
// more than C^2/Gamma_0 of heat (5 kJ/g of a polymer) keeps gigapascals however far it has expanded, and grows ever stiffer; with it the
// pressure of a vapour falls with its density.
// With S2 = S3 = 0 this is U_s = C + S1 u_p on the Hugoniot (Eq. 10 of the paper). The pole of the denominator is kept away from:
// mu is taken no further than where the denominator (before squaring) is 0.05.
#pragma once

#include "laws/eos.h"

namespace brisance {

struct MieGruneisen {
    static constexpr const char* name = "mie_gruneisen";
    static constexpr const char* meaning = "Mie-Grueneisen about the Hugoniot U_s = C + S u_p, with tension cut-off";
    static std::vector<ParameterInfo> parameters() {
        return {{"density", dimension::density, "initial density (taken from the material)", 1e-6, 100},
                {"C", dimension::velocity, "bulk sound speed C", 1e-3, 100},
                {"S1", dimension::none, "slope of U_s over u_p", 0, 10},
                {"S2", dimension::none, "second coefficient", -10, 10},
                {"S3", dimension::none, "third coefficient", -10, 10},
                {"Gamma0", dimension::none, "Grueneisen's Gamma at rest", 0, 10},
                {"a", dimension::none, "first-order volume correction of Gamma", -10, 10},
                {"E0", dimension::pressure, "initial internal energy per initial volume", 0, 1e3},
                {"pressure_cutoff", dimension::pressure, "smallest pressure borne; absent: no cut-off", -1e4, 0, -1e4}};
    }
    explicit MieGruneisen(const ParameterSet& p)
        : k(p.at("density").value * p.at("C").value * p.at("C").value), s1(p.at("S1").value), s2(p.at("S2").value),
          s3(p.at("S3").value), gamma0(p.at("Gamma0").value), a(p.at("a").value), e0(p.at("E0").value),
          cutoff(p.at("pressure_cutoff").value), mu_max(10) {
        for (double mu = 0.01; mu < 10; mu += 0.001)
            if (denominator(mu) < 0.05) {
                mu_max = mu - 0.001;
                break;
            }
    }
    double initial_energy() const { return e0; }
    double pressure_floor() const { return cutoff; }

    template <class V> BRISANCE_HD V denominator(V x) const {
        using R = ScalarOf<V>;
        const V y = x / (R(1) + x);
        return R(1) - x * (R(s1 - 1) + y * (R(s2) + R(s3) * y));
    }
    template <class V> BRISANCE_HD EosTerms<V> terms(V mu) const {
        using R = ScalarOf<V>;
        const V x = clamp(mu, V{}, broadcast<V>(R(mu_max)));
        const V y = x / (R(1) + x);                      // dy/dx = (1 - y)^2
        const V n = R(1) + x * (R(1 - gamma0 / 2) - R(a / 2) * x);
        const V dn = R(1 - gamma0 / 2) - R(a) * x;
        const V d = R(1) - x * (R(s1 - 1) + y * (R(s2) + R(s3) * y));
        const V dd = -(R(s1 - 1) + y * (R(s2) + R(s3) * y)) - x * (R(s2) + R(2 * s3) * y) * sq(R(1) - y);
        const V inverse = R(1) / d;
        const V cold = R(k) * x * n * inverse * inverse;
        const V slope = R(k) * ((n + x * dn) * inverse - R(2) * x * n * dd * inverse * inverse) * inverse;
        const V linear = mu - x;                          // tension, or beyond mu_max: go on along the tangent
        const V gamma = R(gamma0) + R(a) * mu, thinned = R(2) * (R(1) + mu);
        const auto vapour = thinned < R(1);
        return {cold + slope * linear, vapour ? gamma * thinned : gamma, slope, vapour ? R(a) * thinned + R(2) * gamma : broadcast<V>(R(a))};
    }

    double k, s1, s2, s3, gamma0, a, e0, cutoff, mu_max;
};

}  // namespace brisance
