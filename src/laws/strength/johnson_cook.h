// SPDX-License-Identifier: Apache-2.0
// Johnson-Cook:  sigma_y = (A + B eps_p^n) (1 + C ln max(rate/EPS0, 1)) (1 - theta^m),  theta = (T - T_room)/(T_melt - T_room) in [0, 1].
// Radial return by bisection-guarded Newton on  s_eq - 3 G de - sigma_y(eps_p + de) = 0;  the rate is the total deviatoric one of the step.
// Heating: dT = chi sigma_y de / (rho_0 c_v), sigma_y the mean over the step. Damage D1..D5 as in Johnson & Cook 1985; off where D1..D5 are
// all zero. A failure strain that is not positive fails at once.
#pragma once

#include "base/error.h"
#include "laws/strength.h"
#include "math/power.h"

#include <limits>

namespace brisance {

struct JohnsonCook {
    static constexpr const char* name = "johnson_cook";
    static constexpr const char* meaning = "Johnson-Cook plasticity with adiabatic heating and, where given, its damage";
    static std::vector<ParameterInfo> parameters() {
        std::vector<ParameterInfo> rows = {
            {"G", dimension::pressure, "shear modulus", 1e-6, 1e4},
            {"A", dimension::pressure, "yield stress at rest", 0, 100},
            {"B", dimension::pressure, "hardening", 0, 100},
            {"n", dimension::none, "hardening exponent", 0, 5},
            {"C", dimension::none, "rate coefficient", 0, 1},
            {"m", dimension::none, "thermal exponent", 0.01, 10},
            {"EPS0", dimension::rate, "reference strain rate", 1e-12, 1e6},
            {"T_room", dimension::temperature, "reference temperature", 0, 5000},
            {"T_melt", dimension::temperature, "melting temperature", 1, 20000},
            {"c_v", dimension::specific_heat, "specific heat", 1e-9, 1},
            {"chi", dimension::none, "Taylor-Quinney fraction of plastic work that heats", 0, 1}};
        for (int i = 1; i <= 5; ++i)
            rows.push_back({"D" + std::to_string(i), dimension::none, "damage constant; all zero: no damage", -100, 100, 0.0});
        rows.push_back({"damage", dimension::none, "1: damage weakens the metal; 0: it does not (copper expands without tearing)", 0, 1, 0.0});
        return rows;
    }
    static std::vector<StateInfo> state() {
        return {{"damage", "-", "Johnson-Cook damage", 0},
                {"plastic_strain", "-", "equivalent plastic strain", 0},
                {"heating", "K", "temperature above the initial one", 0}};
    }
    JohnsonCook(const ParameterSet& p, const Eos&, double density)
        : G(p.at("G").value), A(p.at("A").value), B(p.at("B").value), n(p.at("n").value), C(p.at("C").value), m(p.at("m").value),
          eps0(p.at("EPS0").value), t_span(p.at("T_melt").value - p.at("T_room").value), heat(p.at("chi").value / (density * p.at("c_v").value)),
          damages(p.at("damage").value > 0) {
        if (!(t_span > 0))
            throw InputError(p.at("T_melt").where + ": T_melt = " + p.at("T_melt").text + " is not above T_room = " + p.at("T_room").text + "; source: " + p.at("T_melt").source);
        if (n == 0) {  // eps^0 = 1 also at eps = 0
            A += B;
            B = 0;
            n = 1;
        }
        for (int i = 0; i < 5; ++i) {
            d[i] = p.at("D" + std::to_string(i + 1)).value;
            counts_damage = counts_damage || d[i] != 0;
        }
    }
    double shear_modulus() const { return G; }

    template <class V> BRISANCE_HD void update(SolidPoint<V>& p) const {
        using R = ScalarOf<V>;
        const V zero{}, one = broadcast<V>(R(1));
        const V damage = p.state[0], eps = p.state[1], heating = p.state[2];
        const V s_intact = damages ? vmax(one - damage, broadcast<V>(R(0.01))) : one;
        const Sym3<V> trial = elastic_trial(p, R(2 * G));
        const V s_eq = mises(trial);
        const V log_rate = natural_log(vmax(equivalent_rate(p) / R(eps0), one));
        const V rate = one + R(C) * log_rate;
        const V theta = clamp(heating / R(t_span), zero, one);
        const V soft = rate * (one - power_of_some(theta, R(m))) * s_intact;
        const V a = R(A) * soft, b = R(B) * soft, before = power_of_some(eps, R(n));
        const V y0 = a + b * before;
        // g(de) = s_eq - 3 G de - a - b (eps + de)^n falls from over > 0 at 0 to g <= 0 at over/(3G). Newton's method is monotone from the
        // side on which g is steep. n >= 1: the right end. n < 1: below the root, where b (eps + de)^n grows at most by b n eps^(n-1) de
        // and by b de^n; near eps = 0 the right end would be off by orders of magnitude.
        const V tiny = broadcast<V>(detail::FloatLayout<R>::tiny);
        const V over = vmax(s_eq - y0, zero);
        const bool yields = any_lane(over > zero);
        V low = zero, high = over / R(3 * G), de = high;
        if (n < 1 && yields) {
            const V by_slope = (eps > zero) ? over / (R(3 * G) + R(n) * b * before / vmax(eps, tiny)) : zero;
            const V by_power = power(over / vmax(b + b, broadcast<V>(R(1e-30))), R(1 / n));
            de = vmax(by_slope, vmin(R(0.5) * high, by_power));
        }
        V moving = (over > zero) ? one : zero;  // a lane that has arrived stays, whatever its neighbours still need
        for (int it = 0; it < 12 && any_lane(moving > zero); ++it) {
            const V strain = eps + de, hardening = b * power(strain, R(n));
            const V g = s_eq - R(3 * G) * de - (a + hardening);
            low = (g > zero) ? de : low;
            high = (g > zero) ? high : de;
            const V next = de + g / (R(3 * G) + R(n) * hardening / vmax(strain, tiny));
            const V middle = R(0.5) * (low + high);
            const V last = de, now = (next >= low) ? ((next <= high) ? next : middle) : middle;
            de = (moving > zero) ? now : de;
            moving = (vabs(de - last) > R(4 * std::numeric_limits<R>::epsilon()) * de) ? moving : zero;
        }
        de = (s_eq > y0) ? de : zero;
        const V y = vmax(s_eq - R(3 * G) * de, zero);
        p.s = scaled(trial, (s_eq > y0) ? y / vmax(s_eq, broadcast<V>(R(1e-30))) : one);
        p.state[1] = eps + de;
        p.state[2] = heating + R(0.5 * heat) * (vmin(y0, s_eq) + y) * de;
        if (!counts_damage) {
            settle(p, y0);
            return;
        }
        const V triaxiality = clamp(-p.pressure / vmax(y, broadcast<V>(R(1e-6))), broadcast<V>(R(-1.5)), broadcast<V>(R(1.5)));
        const V eps_f = (R(d[0]) + R(d[1]) * exponential(R(d[2]) * triaxiality)) * (one + R(d[3]) * log_rate) *
                        (one + R(d[4]) * theta);
        p.state[0] = vmin(damage + de / vmax(eps_f, broadcast<V>(R(1e-6))), one);
        settle(p, y0);
    }

    double G, A, B, n, C, m, eps0, t_span, heat;
    bool damages, counts_damage = false;
    double d[5];

private:
    /// x^y of a pack in which often every lane is 0.
    template <class V> BRISANCE_HD static V power_of_some(V x, ScalarOf<V> y) {
        return any_lane(x > V{}) ? power(x, y) : V{};
    }
    template <class V> BRISANCE_HD void settle(SolidPoint<V>& p, V y0) const {
        using R = ScalarOf<V>;
        p.yield = y0;
        p.shear_stiffness = broadcast<V>(R(4.0 / 3.0 * G));
        // A full elastic zero-energy spring would lock plastic flow: beyond a small plastic strain it is kept at a tenth.
        p.integrity = (p.state[1] > broadcast<V>(R(1e-3))) ? broadcast<V>(R(0.1)) : broadcast<V>(R(1));
    }
};

}  // namespace brisance
