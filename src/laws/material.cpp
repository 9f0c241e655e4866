// SPDX-License-Identifier: Apache-2.0
#include "laws/material.h"

#include "base/error.h"
#include "laws/laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace brisance {

namespace {

template <class... Law> std::vector<EosEntry> entries_of(std::type_identity<std::tuple<Law...>>, EosEntry) { return {eos_entry<Law>()...}; }
template <class... Law> std::vector<StrengthEntry> entries_of(std::type_identity<std::tuple<Law...>>, StrengthEntry) { return {strength_entry<Law>()...}; }

/// The laws of a list, by name.
template <class Laws, class Entry> std::vector<Entry> sorted_entries() {
    std::vector<Entry> entries = entries_of(std::type_identity<Laws>{}, Entry{});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    return entries;
}

template <class Entry> const Entry& find_law(const std::vector<Entry>& entries, const LawData& data, const std::string& kind) {
    std::string known;
    for (const Entry& e : entries) {
        if (e.name == data.law) return e;
        known += (known.empty() ? "" : ", ") + e.name;
    }
    throw InputError(fmt::format("{}: {} law = \"{}\" is not known; allowed: {}", data.where, kind, data.law, known));
}

/// "; source: ...", for what a user has to look up.
std::string by_source(const std::string& source) { return source.empty() ? "" : "; source: " + source; }

/// The given parameters held against the law's table; fallbacks filled in.
ParameterSet checked(const std::vector<ParameterInfo>& table, const LawData& data, const ParameterSet& inherited) {
    ParameterSet out;
    for (const ParameterInfo& row : table) {
        const auto given = data.parameters.find(row.name);
        if (given == data.parameters.end()) {
            const auto from_material = inherited.find(row.name);
            if (from_material != inherited.end()) {
                out[row.name] = from_material->second;
            } else if (row.fallback) {
                out[row.name] = {*row.fallback, row.dimension, "", "absent", "", data.where};
            } else {
                throw InputError(fmt::format("{}: law \"{}\" needs {} ({}), a {} such as \"{}\"", data.where, data.law, row.name, row.meaning,
                                             dimension_name(row.dimension), dimension_example(row.dimension)));
            }
            continue;
        }
        const ParameterValue& v = given->second;
        if (!(v.dimension == row.dimension))
            throw InputError(fmt::format("{}: {} = {} is a {}; law \"{}\" wants a {} such as \"{}\"", v.where, row.name, v.text,
                                         dimension_name(v.dimension), data.law, dimension_name(row.dimension), dimension_example(row.dimension)));
        if (!(v.value >= row.min && v.value <= row.max))
            throw InputError(fmt::format("{}: {} = {} is outside of {:g} ... {:g} {} ({}){}", v.where, row.name, v.text, row.min, row.max,
                                         internal_unit(row.dimension), row.meaning, by_source(v.source)));
        out[row.name] = v;
    }
    for (const auto& [name, value] : data.parameters) {
        if (out.count(name)) continue;
        std::string known;
        for (const ParameterInfo& row : table) known += (known.empty() ? "" : ", ") + row.name;
        throw InputError(fmt::format("{}: law \"{}\" has no parameter {}; allowed: {}", value.where, data.law, name, known));
    }
    return out;
}

/// Where c^2 of the equation of state is looked at, mu = rho/rho_0 - 1.
struct Scan {
    double low, working, high;  ///< refused up to `working`, remarked up to `high`
};
Scan scan_of(const Material& m) {
    // products: from the CJ state, and some compression on top, to twenty times the volume
    if (m.burn) return {-0.95, 1 / m.burn->cj_volume - 1, 1.2 * (1 / m.burn->cj_volume - 1)};
    // gases: from a tenth of the density to twice
    if (m.eos->pressure_floor() == 0 && m.eos->initial_energy() > 0) return {-0.9, 1, 3};
    // solids and liquids: a tenth of the volume, or of the density, lost
    return {-0.1, 1.0 / 9, 0.3};
}

/// c^2 > 0 on the curves that bound what a run reaches: the isentrope from rest, the Hugoniot, and the curve of constant energy.
void check_sound_speed(Material& m, const MaterialData& data) {
    const Eos& eos = *m.eos;
    const Scan scan = scan_of(m);
    const double e0 = eos.initial_energy(), p0 = m.burn ? 0 : eos.pressure(0, e0);
    double isentropic = e0, mu_before = 0;
    std::string warned;
    // tells whether all is well
    const auto look = [&](double mu) {
        const EosTerms<double> t = eos.terms(mu);
        const double v = 1 / (1 + mu), dv = v - 1 / (1 + mu_before), swept = 0.5 * (1 - v);
        isentropic = (isentropic - 0.5 * dv * (eos.pressure(mu_before, isentropic) + t.a)) / (1 + 0.5 * dv * t.b);
        mu_before = mu;
        const double energies[] = {isentropic, e0, mu > 0 && swept * t.b < 0.9 ? (e0 + swept * (t.a + p0)) / (1 - swept * t.b) : e0};
        for (const double energy : energies) {
            const double stiffness = eos.stiffness(mu, energy);
            if (stiffness > 0) continue;
            const std::string what = fmt::format("equation of state \"{}\" of {} has c^2 <= 0 at mu = {:.3f}, E = {:.3g} GPa (rho_0 c^2 = {:.3g} GPa){}",
                                                 data.eos.law, data.name, mu, energy, stiffness, by_source(data.source));
            if (mu <= scan.working) throw InputError(data.eos.where + ": " + what);
            if (warned.empty()) warned = "warning: " + what;
        }
        return warned.empty();
    };
    constexpr int steps = 600;
    for (int i = 0; i <= steps && look(scan.high * i / steps); ++i) {}
    isentropic = e0;
    mu_before = 0;
    for (int i = 1; i <= steps; ++i) look(std::pow(1 + scan.low, static_cast<double>(i) / steps) - 1);  // equal steps of the logarithm
    if (!warned.empty()) m.remarks.push_back(warned);
}

/// A solid that thickens when it is pulled is a mistake in K or G.
void check_poisson(Material& m, const MaterialData& data) {
    const double k = m.bulk_modulus(), g = m.strength->shear_modulus(), nu = (3 * k - 2 * g) / (6 * k + 2 * g);
    if (nu < 0)
        m.remarks.push_back(fmt::format("warning: K = {:.4g} GPa and G = {:.4g} GPa give Poisson's ratio {:.3f} < 0{}", k, g, nu, by_source(data.source)));
}

}  // namespace

const std::vector<EosEntry>& eos_entries() {
    static const std::vector<EosEntry> entries = sorted_entries<EosLaws, EosEntry>();
    return entries;
}
const std::vector<StrengthEntry>& strength_entries() {
    static const std::vector<StrengthEntry> entries = sorted_entries<StrengthLaws, StrengthEntry>();
    return entries;
}
const std::vector<ParameterInfo>& burn_parameters() {
    static const std::vector<ParameterInfo> rows = {{"D", dimension::velocity, "detonation velocity", 0.1, 20},
                                                    {"P_CJ", dimension::pressure, "Chapman-Jouguet pressure", 0.01, 100}};
    return rows;
}

CjState chapman_jouguet(const Eos& products, double density) {
    // On the Hugoniot of the products E = E0 + P (1 - V)/2; the CJ state has the least slope P/(1 - V) of the Rayleigh line.
    const auto hugoniot = [&](double v) {
        const EosTerms<double> t = products.terms(1 / v - 1);
        return (t.a + t.b * products.initial_energy()) / (1 - 0.5 * t.b * (1 - v));
    };
    double best = 1e300, volume = 0.7;
    for (double v = 0.4; v < 0.98; v += 1e-4) {
        const double slope = hugoniot(v) / (1 - v);
        if (slope > 0 && slope < best) {
            best = slope;
            volume = v;
        }
    }
    double low = volume - 2e-4, high = volume + 2e-4;  // golden section on the bracket
    for (int i = 0; i < 100; ++i) {
        const double a = high - 0.6180339887 * (high - low), b = low + 0.6180339887 * (high - low);
        if (hugoniot(a) / (1 - a) < hugoniot(b) / (1 - b)) high = b;
        else low = a;
    }
    volume = 0.5 * (low + high);
    const double pressure = hugoniot(volume);
    return {std::sqrt(pressure / (1 - volume) / density), pressure, volume};
}

Material make_material(const MaterialData& data) {
    Material m;
    m.name = data.name;
    if (!(data.density.dimension == dimension::density) || !(data.density.value > 0))
        throw InputError(fmt::format("{}: density = {} must be a positive density such as \"2660 kg/m3\"", data.density.where, data.density.text));
    m.density = data.density.value;
    const ParameterSet inherited{{"density", data.density}};

    const EosEntry& eos = find_law(eos_entries(), data.eos, "eos");
    m.eos = eos.make(checked(eos.parameters, data.eos, inherited));
    if (data.strength) {
        const StrengthEntry& law = find_law(strength_entries(), *data.strength, "strength");
        m.strength = law.make(checked(law.parameters, *data.strength, inherited), *m.eos, m.density);
        m.remarks = m.strength->remarks();
        for (std::string& r : m.remarks)
            if (r.starts_with("warning")) r += by_source(data.source);
        check_poisson(m, data);
    }
    if (data.burn) {
        if (data.burn->law != "programmed")
            throw InputError(fmt::format("{}: burn law = \"{}\" is not known; allowed: programmed", data.burn->where, data.burn->law));
        const ParameterSet p = checked(burn_parameters(), *data.burn, inherited);
        BurnLaw burn{p.at("D").value, p.at("P_CJ").value, 0};
        burn.cj_volume = 1 - burn.cj_pressure / (m.density * burn.speed * burn.speed);
        if (!(burn.cj_volume > 0.3 && burn.cj_volume < 1))
            throw InputError(fmt::format("{}: P_CJ = {} and D = {} give V_CJ = {:.3f}, which no explosive has{}", p.at("P_CJ").where,
                                         p.at("P_CJ").text, p.at("D").text, burn.cj_volume, by_source(p.at("P_CJ").source)));
        const CjState cj = chapman_jouguet(*m.eos, m.density);
        m.remarks.push_back(fmt::format("CJ state of the products: D = {:.0f} m/s ({:+.2f} %), P = {:.2f} GPa ({:+.1f} %)", 1e3 * cj.speed,
                                        100 * (cj.speed / burn.speed - 1), cj.pressure, 100 * (cj.pressure / burn.cj_pressure - 1)));
        if (std::abs(cj.speed / burn.speed - 1) > 0.01 || std::abs(cj.pressure / burn.cj_pressure - 1) > 0.03)
            m.remarks.push_back("warning: the products miss the stated CJ state by more than 1 % in D or 3 % in P" + by_source(data.source));
        m.burn = std::make_shared<const BurnLaw>(burn);
    }
    check_sound_speed(m, data);
    return m;
}

}  // namespace brisance
