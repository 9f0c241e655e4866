// SPDX-License-Identifier: Apache-2.0
// What the tests of the laws share: materials of the library and varied ones, a driver of a single point, random numbers, bits.
#pragma once

#include "base/error.h"
#include "io/case_file.h"
#include "laws/material.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <vector>

namespace brisance::law_test {

/// rapidcheck draws the same cases in every run; RC_PARAMS in the environment overrides it.
inline const bool fixed_seed = [] { return setenv("RC_PARAMS", "seed=1994 max_success=3000", 0) == 0; }();

// ---- materials

/// The library as data, read once.
inline const std::vector<MaterialData>& library_data() {
    static const std::vector<MaterialData> all = [] {
        std::vector<MaterialData> v;
        for (const std::string& name : list_materials()) v.push_back(read_material(name));
        return v;
    }();
    return all;
}
inline Material library(const std::string& name) { return make_material(read_material(name)); }

using Values = std::map<std::string, double>;
/// Changes parameters that the law has already; internal units.
inline void set(LawData& law, const Values& values) {
    for (const auto& [name, value] : values) {
        ASSERT_TRUE(law.parameters.count(name)) << law.law << " has no " << name;
        law.parameters[name].value = value;
    }
}
inline Material varied(const std::string& base, const Values& eos, const Values& strength, double density = 0) {
    MaterialData data = read_material(base);
    if (density > 0) data.density.value = density;
    set(data.eos, eos);
    if (data.strength) set(*data.strength, strength);
    return make_material(data);
}

/// A law that no material of the library uses: 2 for every parameter without fallback, held within its range.
template <class Entry> LawData from_table(const Entry& entry) {
    LawData law{entry.name, "table.toml:7:1", {}};
    int line = 8;
    for (const ParameterInfo& row : entry.parameters) {
        if (row.name == "density" || row.fallback) continue;
        const double value = std::min(std::max(2.0, row.min), row.max);
        law.parameters[row.name] = {value, row.dimension, std::to_string(value), "test", "c", "table.toml:" + std::to_string(line++) + ":1"};
    }
    return law;
}
/// Data of all library materials that use the law, or one made from its table.
inline std::vector<MaterialData> users_of(const StrengthEntry& entry) {
    std::vector<MaterialData> users;
    for (const MaterialData& m : library_data())
        if (m.strength && m.strength->law == entry.name) users.push_back(m);
    if (users.empty()) {
        users.push_back(read_material("barre_granite"));
        users.back().name = "table of " + entry.name;
        users.back().strength = from_table(entry);
    }
    return users;
}
inline std::vector<MaterialData> users_of(const EosEntry& entry) {
    std::vector<MaterialData> users;
    for (const MaterialData& m : library_data())
        if (m.eos.law == entry.name) users.push_back(m);
    if (users.empty()) {
        users.push_back(read_material("water"));
        users.back().name = "table of " + entry.name;
        users.back().eos = from_table(entry);
    }
    return users;
}
inline std::vector<Material> materials_of(const std::vector<MaterialData>& data) {
    std::vector<Material> v;
    for (const MaterialData& m : data) v.push_back(make_material(m));
    return v;
}

/// The message of the InputError that make_material throws.
inline std::string refusal(const MaterialData& data) {
    try {
        make_material(data);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}
inline bool says(const std::string& message, const std::string& fragment) { return message.find(fragment) != std::string::npos; }

// ---- tensors

using Sym = Sym3<double>;
inline Sym operator+(const Sym& a, const Sym& b) { return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz}; }
inline Sym operator-(const Sym& a, const Sym& b) { return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz}; }
inline Sym operator*(double f, const Sym& a) { return {f * a.xx, f * a.yy, f * a.zz, f * a.xy, f * a.xz, f * a.yz}; }
inline Sym deviator(const Sym& a) {
    const double mean = trace(a) / 3;
    return {a.xx - mean, a.yy - mean, a.zz - mean, a.xy, a.xz, a.yz};
}
inline double norm(const Sym& a) { return std::sqrt(ddot(a, a)); }
inline std::array<double, 6> components(const Sym& a) { return {a.xx, a.yy, a.zz, a.xy, a.xz, a.yz}; }
inline Mat3<double> full(const Sym& a) { return {a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz}; }
/// Q a Q^T
inline Sym rotated(const Mat3<double>& q, const Sym& a) {
    const Mat3<double> m = q * full(a) * transpose(q);
    return {m.xx, m.yy, m.zz, 0.5 * (m.xy + m.yx), 0.5 * (m.xz + m.zx), 0.5 * (m.yz + m.zy)};
}

// ---- random numbers, the same everywhere

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
    /// Uniform in the logarithm.
    double decades(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    Sym sym(double size) { return {component(size), component(size), component(size), component(size), component(size), component(size)}; }
    /// A rotation, from a random unit quaternion.
    Mat3<double> rotation() {
        double w, x, y, z, n;
        do {
            w = component(1), x = component(1), y = component(1), z = component(1);
            n = w * w + x * x + y * y + z * z;
        } while (n > 1 || n < 0.01);
        const double f = 2 / n;
        return {1 - f * (y * y + z * z), f * (x * y - w * z), f * (x * z + w * y), f * (x * y + w * z), 1 - f * (x * x + z * z),
                f * (y * z - w * x), f * (x * z - w * y), f * (y * z + w * x), 1 - f * (x * x + y * y)};
    }

private:
    double component(double size) { return uniform(-size, size); }
    std::mt19937_64 engine_;
};

// ---- bits

inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }
inline bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

// ---- a single point of a solid

/// The point before its first step.
inline SolidPoint<double> at_rest(const Material& m, double dt = 1) {
    SolidPoint<double> p{};
    p.energy = m.eos->initial_energy();
    p.pressure = m.eos->pressure(0, p.energy);
    p.dt = dt;
    p.scale = 1;
    const std::vector<StateInfo> rows = m.strength->state();
    for (std::size_t i = 0; i < rows.size(); ++i) p.state[i] = rows[i].initial;
    return p;
}
/// One step by the strain increment d to the density mu.
inline void step(const Material& m, SolidPoint<double>& p, const Sym& d, double mu) {
    p.d = d;
    p.mu = mu;
    p.pressure = m.eos->pressure(mu, p.energy);
    m.strength->update(p);
}

/// What one step of a path left behind. Stresses in GPa, pressure positive in compression.
struct Row {
    double mu, pressure, s_eq, sigma_z, damage, plastic, yield;
    double s_z;  ///< axial deviator, positive in tension
    double strain() const { return mu / (1 + mu); }  ///< 1 - V/V_0
};
/// Uniaxial logarithmic strain from the state of p, where log strain is `from` (negative: compression), to `to`, in n equal increments.
/// Expects a law whose first two columns are damage and plastic strain.
inline std::vector<Row> uniaxial(const Material& m, SolidPoint<double>& p, double from, double to, int n) {
    std::vector<Row> rows;
    for (int i = 1; i <= n; ++i) {
        const double strain = from + (to - from) * i / n;
        step(m, p, {0, 0, (to - from) / n, 0, 0, 0}, std::exp(-strain) - 1);
        rows.push_back({p.mu, p.pressure, mises(p.s), p.s.zz - p.pressure, p.state[0], p.state[1], p.yield, p.s.zz});
    }
    return rows;
}

/// Index of a state column, -1: the law has none of this name.
inline int column(const std::vector<StateInfo>& rows, const std::string& name) {
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].name == name) return static_cast<int>(i);
    return -1;
}

/// "file.toml:line" somewhere in the message.
inline bool names_a_place(const std::string& message) { return std::regex_search(message, std::regex(R"(\.toml:\d+)")); }

}  // namespace brisance::law_test
