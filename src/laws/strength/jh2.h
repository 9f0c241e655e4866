// SPDX-License-Identifier: Apache-2.0
// Johnson-Holmquist 2 (Johnson & Holmquist 1994), with the conventions of LS-DYNA's *MAT_110.
//
//   P*  = P/PHEL, T* = T/PHEL, c = 1 + C ln max(rate/EPS0, 1), rate the total equivalent deviatoric strain rate
//   sigma_i = SHEL A (P* + T*)^N c                intact
//   sigma_f = SHEL min(B P*^M c, SFMAX)           fractured
//   Y       = (1 - D) sigma_i + D sigma_f
//   dD      = d eps_p / (D1 (P* + T*)^D2)
//   P       = K1 mu + K2 mu^2 + K3 mu^3 + dP  (mu > 0);  max(K1 mu + dP, -T (1 - D))  (mu <= 0)
//   dP_new  = -K1 mu + sqrt((K1 mu + dP)^2 + 2 BETA K1 dU),  dU = (Y_old^2 - Y_new^2)/(6 G)     bulking
//
// Order of the damage step. When damage grows, the deviator is taken down to the surface of the *new* damage inside the step, and
// that drop is not plastic strain: its energy feeds the bulking. Counting it as plastic strain in the next step, as several public
// codes do, makes damage snap through and misses the curves of the 1994 paper (tests/unit/jh2_test.cpp shows both).
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "laws/strength.h"
#include "math/power.h"

#include <cmath>

namespace brisance {

struct Jh2 {
    static constexpr const char* name = "jh2";
    static constexpr const char* meaning = "Johnson-Holmquist 2: pressure-dependent strength, damage, bulking";
    static std::vector<ParameterInfo> parameters() {
        return {{"G", dimension::pressure, "shear modulus", 1e-6, 1e4},
                {"A", dimension::none, "intact strength coefficient", 0, 100},
                {"B", dimension::none, "fractured strength coefficient", 0, 100},
                {"C", dimension::none, "rate coefficient", 0, 1},
                {"M", dimension::none, "fractured strength exponent", 0, 5},
                {"N", dimension::none, "intact strength exponent", 0, 5},
                {"EPS0", dimension::rate, "reference strain rate", 1e-12, 1e6},
                {"T", dimension::pressure, "largest hydrostatic tension", 1e-9, 100},
                {"SFMAX", dimension::none, "cap of the fractured strength over SHEL; 0: none", 0, 100},
                {"HEL", dimension::pressure, "Hugoniot elastic limit", 1e-6, 1e3},
                {"PHEL", dimension::pressure, "pressure at the HEL; 0: from HEL, G and the equation of state", 0, 1e3},
                {"SHEL", dimension::pressure, "strength at the HEL; 0: 1.5 (HEL - PHEL)", 0, 1e3, 0.0},
                {"BETA", dimension::none, "fraction of the lost elastic energy that becomes bulking pressure", 0, 1},
                {"D1", dimension::none, "damage coefficient; 0: failure at first yield", 0, 100},
                {"D2", dimension::none, "damage exponent", 0, 10},
                {"FS", dimension::none, "erosion strain; 0: no erosion (the only value supported)", 0, 0}};
    }
    static std::vector<StateInfo> state() {
        return {{"damage", "-", "JH-2 damage D", 0},
                {"plastic_strain", "-", "equivalent plastic strain", 0, false},
                {"bulking", "GPa", "bulking pressure dP", 0}};
    }

    Jh2(const ParameterSet& p, const Eos& eos, double)
        : G(p.at("G").value), A(p.at("A").value), B(p.at("B").value), C(p.at("C").value), M(p.at("M").value), N(p.at("N").value),
          eps0(p.at("EPS0").value), T(p.at("T").value), sfmax(p.at("SFMAX").value > 0 ? p.at("SFMAX").value : 1e20),
          hel(p.at("HEL").value), beta(p.at("BETA").value), D1(p.at("D1").value), D2(p.at("D2").value), K1(eos.bulk_modulus()) {
        phel_of_eos = pressure_at_hel(eos, p.at("HEL"));
        phel = p.at("PHEL").value > 0 ? p.at("PHEL").value : phel_of_eos;
        shel = p.at("SHEL").value > 0 ? p.at("SHEL").value : 1.5 * (hel - phel);
        if (!(shel > 0))
            throw InputError(p.at("PHEL").where + ": PHEL = " + p.at("PHEL").text + " is not below HEL = " + p.at("HEL").text +
                             ": the strength at the HEL, 1.5 (HEL - PHEL), would not be positive; source: " + p.at("HEL").source);
    }
    double shear_modulus() const { return G; }

    /// PHEL from HEL = P(mu) + 4/3 G mu/(1+mu), the smallest positive root (bracket scan, then bisection).
    double pressure_at_hel(const Eos& eos, const ParameterValue& given) const {
        const auto excess = [&](double mu) { return eos.pressure(mu, 0) + 4.0 / 3.0 * G * mu / (1 + mu) - hel; };
        double low = 0, high = 1e-4;
        while (excess(high) < 0 && high < 10) {
            low = high;
            high += 1e-4;
        }
        if (excess(high) < 0) throw InputError(given.where + ": HEL = " + given.text + " is not reached below mu = 10");
        for (int i = 0; i < 80; ++i) {
            const double mid = 0.5 * (low + high);
            (excess(mid) < 0 ? low : high) = mid;
        }
        return eos.pressure(0.5 * (low + high), 0);
    }

    std::vector<std::string> remarks() const {
        std::vector<std::string> r;
        const double off = phel / phel_of_eos - 1;
        if (std::abs(off) > 0.01)
            r.push_back(printed("%sPHEL = %.4g GPa is %+.1f %% off the %.4g GPa that HEL, G and the equation of state give",
                                std::abs(off) > 0.05 ? "warning: " : "", phel, 100 * off, phel_of_eos));
        const double at_hel = A * std::pow(1 + T / phel, N);
        if (std::abs(at_hel - 1) > 0.05)
            r.push_back(printed("A (1 + T*)^N = %.3f at the HEL, not 1: the HEL is not a yield point of this set", at_hel));
        r.push_back(printed("PHEL = %.4f GPa, SHEL = %.4f GPa, strength at P = 0: %.1f MPa, uniaxial strengths: tension %.0f MPa, compression %.0f MPa", phel,
                            shel, 1e3 * intact(0), 1e3 * uniaxial(-1), 1e3 * uniaxial(+1)));
        return r;
    }
    double intact(double pressure) const {
        const double x = (pressure + T) / phel;
        return x > 0 ? shel * A * std::pow(x, N) : 0;
    }
    /// Strength q of a uniaxial stress state, where P = sign q/3: the root of q = sigma_i(sign q/3) (rate 1).
    double uniaxial(int sign) const {
        double low = 0, high = 100;
        for (int i = 0; i < 200; ++i) {
            const double q = 0.5 * (low + high);
            (q < intact(sign * q / 3) ? low : high) = q;
        }
        return 0.5 * (low + high);
    }

    template <class V> BRISANCE_HD void update(SolidPoint<V>& p) const {
        using R = ScalarOf<V>;
        const V zero{}, one = broadcast<V>(R(1));
        const V damage = p.state[0], bulking = p.state[2];
        const V tension = R(T) * p.scale;

        // pressure with bulking and cut-off
        const V with_bulking = p.pressure + bulking;
        const V pressure = (p.mu > zero) ? with_bulking : vmax(with_bulking, -tension * (one - damage));

        // strength before the step's damage
        const V rate = one + R(C) * natural_log(vmax(equivalent_rate(p) / R(eps0), one));
        const V reach = vmax((pressure + tension) * R(1 / phel), zero);  // P* + T*
        const V p_star = vmax(pressure * R(1 / phel), zero);
        const V intact_now = R(shel * A) * power(reach, R(N)) * rate;
        const V fractured = (p_star > zero) ? R(shel) * vmin(R(B) * power(p_star, R(M)) * rate, broadcast<V>(R(sfmax))) : zero;
        const V y_old = (one - damage) * intact_now + damage * fractured;

        const Sym3<V> trial = elastic_trial(p, R(2 * G));
        const V s_eq = mises(trial);
        const V over = vmax(s_eq - y_old, zero);
        const V plastic = over * R(1 / (3 * G));
        const V eps_f = R(D1) * p.scale * power(reach, R(D2));
        // one more than needed where the denominator vanishes: immediate failure
        const V growth = (eps_f > zero) ? plastic / vmax(eps_f, broadcast<V>(R(1e-30))) : one;
        const V d_new = (over > zero) ? vmin(damage + growth, one) : damage;
        const V y_new = (one - d_new) * intact_now + d_new * fractured;
        const V target = (d_new > damage) ? vmin(y_old, y_new) : y_old;
        const V factor = (over > zero) ? target / vmax(s_eq, broadcast<V>(R(1e-30))) : one;

        const V du = vmax(y_old * y_old - y_new * y_new, zero) * R(1 / (6 * G));
        const V base = R(K1) * p.mu + bulking;
        const V bulked = bulking + (vsqrt(vmax(base * base + R(2 * beta * K1) * du, zero)) - base);

        p.s = scaled(trial, factor);
        p.pressure = pressure;
        p.state[0] = d_new;
        p.state[1] = p.state[1] + plastic;
        p.state[2] = (d_new > damage) ? ((p.mu > zero) ? bulked : bulking) : bulking;
        p.yield = y_old;
        p.shear_stiffness = broadcast<V>(R(4.0 / 3.0 * G));
        p.integrity = one - d_new;
    }

    double G, A, B, C, M, N, eps0, T, sfmax, hel, beta, D1, D2, K1;
    double phel = 0, shel = 0, phel_of_eos = 0;
};

}  // namespace brisance
