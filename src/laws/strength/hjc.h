// SPDX-License-Identifier: Apache-2.0
// Holmquist-Johnson-Cook concrete (Holmquist, Johnson & Cook 1993), parameters as in LS-DYNA's *MAT_111.
//
//   P* = P/FC, T* = T/FC, c = 1 + C ln max(rate/EPS0, 1), rate the total equivalent deviatoric strain rate
//   Y  = FC min([A (1 - D) + B P*^N] c, SFMAX)                    P >= 0
//   Y  = FC A [(1 - D) + P*/T*] c, down to 0 at P = -T (1 - D)     P <  0     (a straight line; the paper draws it, without an equation)
//   dD = (d eps_p + d mu_p) / max(D1 (P* + T*)^D2, EFMIN)
//
// Pressure, with mu_m the largest mu so far (UC + the state `compaction`), and never below -T (1 - D):
//   mu_m <= UC          P = K_e mu, K_e = PC/UC                                            elastic
//   UC < mu_m <= mu_L   P = PC + (PL - PC)(mu_m - UC)/(mu_L - UC) - K_u (mu_m - mu)        pores crush; unloading with
//                       K_u = (1 - F) K_e + F K1, F = (mu_m - UC)/(mu_L - UC)
//   mu_m > mu_L         P = K1 m + K2 m^2 + K3 m^3, m = (mu - UL)/(1 + UL); K1 m below 0   no pores left
// mu_L is where the last curve has PL. mu_p, the compaction that stays, is the mu at which unloading meets P = 0, at most UL.
//
// The equation of state of the material has to be the elastic one, P = K_e mu: this law adds what compaction changes of it, as the bulking
// of JH-2 does. When damage grows the deviator goes down to the surface of the new damage in the same step, without plastic strain for it.
#pragma once

#include "base/error.h"
#include "base/text.h"
#include "laws/strength.h"
#include "math/power.h"

#include <cmath>

namespace brisance {

struct Hjc {
    static constexpr const char* name = "hjc";
    static constexpr const char* meaning = "Holmquist-Johnson-Cook concrete: crushing pores, pressure-dependent strength, damage";
    static std::vector<ParameterInfo> parameters() {
        return {{"G", dimension::pressure, "shear modulus", 1e-6, 1e4},
                {"A", dimension::none, "normalised cohesive strength", 0, 10},
                {"B", dimension::none, "normalised pressure hardening", 0, 10},
                {"C", dimension::none, "rate coefficient", 0, 1},
                {"N", dimension::none, "pressure hardening exponent", 0.01, 5},
                {"FC", dimension::pressure, "quasi-static uniaxial compressive strength", 1e-6, 10},
                {"T", dimension::pressure, "largest hydrostatic tension", 1e-9, 1},
                {"EPS0", dimension::rate, "reference strain rate", 1e-12, 1e6},
                {"EFMIN", dimension::none, "least strain to fracture", 1e-6, 10},
                {"SFMAX", dimension::none, "largest normalised strength", 1e-3, 1e3},
                {"PC", dimension::pressure, "pressure at which the pores begin to crush", 1e-6, 100},
                {"UC", dimension::none, "mu at which the pores begin to crush", 1e-7, 1},
                {"PL", dimension::pressure, "pressure at which no pores are left", 1e-6, 1e3},
                {"UL", dimension::none, "mu of the grains without pores, unloaded", 0, 2},
                {"D1", dimension::none, "damage coefficient", 0, 10},
                {"D2", dimension::none, "damage exponent", 0, 10},
                {"K1", dimension::pressure, "first coefficient of the material without pores", 1e-6, 1e4},
                {"K2", dimension::pressure, "second coefficient", -1e5, 1e5},
                {"K3", dimension::pressure, "third coefficient", -1e5, 1e5}};
    }
    static std::vector<StateInfo> state() {
        return {{"damage", "-", "HJC damage D", 0},
                {"plastic_strain", "-", "equivalent plastic strain", 0, false},
                {"compaction", "-", "largest mu so far, beyond UC", 0}};
    }

    Hjc(const ParameterSet& p, const Eos& eos, double)
        : G(p.at("G").value), A(p.at("A").value), B(p.at("B").value), C(p.at("C").value), N(p.at("N").value), fc(p.at("FC").value),
          T(p.at("T").value), eps0(p.at("EPS0").value), efmin(p.at("EFMIN").value), sfmax(p.at("SFMAX").value), pc(p.at("PC").value),
          uc(p.at("UC").value), pl(p.at("PL").value), ul(p.at("UL").value), D1(p.at("D1").value), D2(p.at("D2").value), K1(p.at("K1").value),
          K2(p.at("K2").value), K3(p.at("K3").value), ke(pc / uc), two_K2(2 * K2), three_K3(3 * K3), shear(4.0 / 3.0 * G) {
        const auto refuse = [&p](const char* key, const std::string& why) {
            throw InputError(p.at(key).where + ": " + key + " = " + p.at(key).text + ": " + why + "; source: " + p.at(key).source);
        };
        if (!(pl > pc)) refuse("PL", "has to be above PC = " + p.at("PC").text);
        if (!(K1 >= ke)) refuse("K1", printed("has to be at least the elastic modulus PC/UC = %.4g GPa: unloading stiffens as pores close", ke));
        for (double m = 0; m < 1; m += 1e-3)
            if (!(K1 + m * (two_K2 + three_K3 * m) > 0)) refuse("K2", printed("the pressure of the material without pores falls from m = %.3f on", m));
        double low = 0, high = 1;  // K1 m + K2 m^2 + K3 m^3 = PL
        for (int i = 0; i < 100; ++i) {
            const double m = 0.5 * (low + high);
            (m * (K1 + m * (K2 + m * K3)) < pl ? low : high) = m;
        }
        lock = 0.5 * (low + high) * (1 + ul) + ul;
        if (!(high < 1 && lock > uc)) refuse("UL", printed("the pores would be gone at mu = %.4g, before they begin to crush at UC", lock));
        for (const double mu : {-0.01, 0.01, 0.1})
            if (!(std::abs(eos.pressure(mu, 0) - ke * mu) < 1e-3 * ke * std::abs(mu)))
                refuse("PC", printed("the equation of state of an hjc material is the elastic P = PC/UC mu, a polynomial with K1 = %.6g GPa, K2 = K3 = 0; "
                                     "this one gives %.4g GPa at mu = %g in place of %.4g GPa", ke, eos.pressure(mu, 0), mu, ke * mu));
        slope = (pl - pc) / (lock - uc);
        fraction = 1 / (lock - uc);
        stiffer = K1 - ke;
    }
    double shear_modulus() const { return G; }

    std::vector<std::string> remarks() const {
        const auto strength = [this](double P) { return fc * std::min(P >= 0 ? A + B * std::pow(P / fc, N) : std::max(A * (1 + P / T), 0.0), sfmax); };
        const auto uniaxial = [&](int sign) {  // q = Y(sign q/3)
            double low = 0, high = 100;
            for (int i = 0; i < 200; ++i) {
                const double q = 0.5 * (low + high);
                (q < strength(sign * q / 3) ? low : high) = q;
            }
            return 1e3 * low;
        };
        return {printed("elastic bulk modulus PC/UC = %.4g GPa, no pores from mu = %.4f on; at rate EPS0: strength at P = 0: %.1f MPa, uniaxial strengths: "
                        "tension %.2f MPa, compression %.1f MPa (FC = %.1f MPa)", ke, lock, 1e3 * strength(0), uniaxial(-1), uniaxial(+1), 1e3 * fc)};
    }

    /// At the compaction k = mu_m - UC: K_u - K_e, the pressure of crushing, and mu_p. Where a product goes into a sum a maximum stands
    /// between: which products are contracted into FMA would differ between packs and points.
    template <class V> BRISANCE_HD V closing(V k) const {
        using R = ScalarOf<V>;
        return vmax(R(stiffer) * vmin(k * R(fraction), broadcast<V>(R(1))), V{});
    }
    template <class V> BRISANCE_HD V crushing(V k) const {
        using R = ScalarOf<V>;
        return R(pc) + R(slope) * k;
    }
    template <class V> BRISANCE_HD V residual(V k) const {
        using R = ScalarOf<V>;
        const V porous = (k + R(uc)) - crushing(k) / (R(ke) + closing(k));
        return (k > V{}) ? ((k > R(lock - uc)) ? broadcast<V>(R(ul)) : clamp(porous, V{}, broadcast<V>(R(ul)))) : V{};
    }

    template <class V> BRISANCE_HD void update(SolidPoint<V>& p) const {
        using R = ScalarOf<V>;
        const V zero{}, one = broadcast<V>(R(1));
        const V damage = p.state[0], before = p.state[2], k = vmax(before, p.mu - R(uc));

        // pressure: what compaction changes of K_e mu
        const V closed = closing(k);
        const V porous = crushing(k) - (R(ke) + closed) * ((k + R(uc)) - p.mu);
        const V x = (p.mu - R(ul)) * R(1 / (1 + ul)), x_pressed = vmax(x, zero);
        const V dense = x * R(K1) + x_pressed * x_pressed * (R(K2) + R(K3) * x_pressed);
        const auto no_pores = k > R(lock - uc);
        const V compacted = no_pores ? dense : porous;
        const V whole = (k > zero) ? p.pressure + (compacted - R(ke) * p.mu) : p.pressure;
        const V tension = R(T) * p.scale;
        const V pressure = vmax(whole, -tension * (one - damage));

        // strength before the step's damage
        const V rate = one + R(C) * natural_log(vmax(equivalent_rate(p) / R(eps0), one));
        const V pressed = vmax(pressure, zero) * R(1 / fc);
        const V hardening = vmax(R(B) * power(pressed, R(N)), zero);
        const V pulled = vmin(pressure, zero) / tension;
        const V cap = broadcast<V>(R(fc * sfmax));
        const auto strength = [&](V d) { return vmin(R(fc) * (rate * vmax(R(A) * ((one - d) + pulled) + hardening, zero)), cap); };
        const V y_old = strength(damage);

        const Sym3<V> trial = elastic_trial(p, R(2 * G));
        const V s_eq = mises(trial);
        const V plastic = vmax((s_eq - y_old) * R(1 / (3 * G)), zero);
        const V compacting = vmax(residual(k) - residual(before), zero);
        const V reach = vmax((pressure + tension) * R(1 / fc), zero);
        const V eps_f = vmax(R(D1) * p.scale * power(reach, R(D2)), broadcast<V>(R(efmin)));
        const V d_new = vmin(damage + (plastic + compacting) / eps_f, one);
        const V target = vmin(y_old, strength(d_new));
        const V factor = (s_eq > target) ? target / vmax(s_eq, broadcast<V>(R(1e-30))) : one;

        p.s = scaled(trial, factor);
        p.pressure = pressure;
        p.state[0] = d_new;
        p.state[1] = p.state[1] + plastic;
        p.state[2] = k;
        p.yield = y_old;
        // with the bulk stiffness above K_e, so that the stable step knows it
        const V extra = no_pores ? R(stiffer) + vmax(x_pressed * (R(two_K2) + R(three_K3) * x_pressed), zero) : closed;
        p.shear_stiffness = R(shear) + extra;
        p.integrity = one - d_new;
    }

    double G, A, B, C, N, fc, T, eps0, efmin, sfmax, pc, uc, pl, ul, D1, D2, K1, K2, K3, ke;
    double lock = 0, slope = 0, fraction = 0, stiffer = 0;
    double two_K2, three_K3, shear;  // formed once: contracted into a sum they would give a point other bits than a pack
};

}  // namespace brisance
