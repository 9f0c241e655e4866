// SPDX-License-Identifier: Apache-2.0
// brisance materials: the library, its sources and what the checks say of it.
#include "app/commands.h"
#include "base/error.h"
#include "base/text.h"
#include "io/case_file.h"
#include "laws/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace brisance {

namespace {

void print_law(const std::string& kind, const LawData& law) {
    fmt::print("  {} {}\n", kind, law.law);
    for (const auto& [name, v] : law.parameters) fmt::print("    {:<16} {:<16} {:<8} {}\n", name, v.text, v.confidence, v.source);
}

std::vector<const ParameterValue*> numbers_of(const MaterialData& d) {
    std::vector<const ParameterValue*> all{&d.density};
    const auto add = [&](const LawData& law) {
        for (const auto& entry : law.parameters) all.push_back(&entry.second);
    };
    add(d.eos);
    if (d.strength) add(*d.strength);
    if (d.burn) add(*d.burn);
    return all;
}

/// How many numbers of a material carry each grade: "14 b-H; 3 c", the most frequent first. Choices that are no measurement ("choice: ...")
/// are not counted.
std::string grades(const MaterialData& d) {
    std::map<std::string, int> count;
    for (const ParameterValue* v : numbers_of(d))
        if (!v->source.starts_with("choice:")) ++count[v->confidence];
    std::vector<std::pair<std::string, int>> sorted(count.begin(), count.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<std::string> words;
    for (const auto& [grade, n] : sorted) words.push_back(fmt::format("{} {}", n, grade));
    return joined(words, "; ");
}

std::string verdict(const Material& m) {
    const auto warnings = std::count_if(m.remarks.begin(), m.remarks.end(), [](const std::string& r) { return r.starts_with("warning"); });
    return warnings == 0 ? "ok" : fmt::format("{} warning{}", warnings, warnings == 1 ? "" : "s");
}

std::string json_list(const std::vector<std::string>& texts) {
    std::vector<std::string> quoted;
    for (const std::string& t : texts) quoted.push_back(in_quotes(t));
    return quoted.empty() ? "[]" : "[" + joined(quoted) + "]";
}

}  // namespace

int materials_command(const std::string& name, bool json, bool full) {
    if (!name.empty()) {
        const MaterialData d = read_material(name);
        const Material m = make_material(d);
        fmt::print("{}: {}\n{}\n", d.name, d.title, d.source);
        for (const std::string& n : d.notes) fmt::print("  note: {}\n", n);
        fmt::print("  {:<18} {:<16} {:<8} {}\n", "density", d.density.text, d.density.confidence, d.density.source);
        print_law("equation of state:", d.eos);
        if (d.strength) print_law("strength:", *d.strength);
        if (d.burn) print_law("burn:", *d.burn);
        fmt::print("  bulk modulus {:.4g} GPa, sound speed {:.1f} m/s\n", m.bulk_modulus(), 1e3 * m.sound_speed());
        for (const std::string& r : m.remarks) fmt::print("  check: {}\n", r);
        return 0;
    }
    std::string rows;
    for (const std::string& n : list_materials()) {
        const MaterialData d = read_material(n);
        const Material m = make_material(d);
        const std::string laws = d.eos.law + (d.strength ? " + " + d.strength->law : "") + (d.burn ? " + " + d.burn->law : "");
        if (json) {
            rows += fmt::format("{}{{\"name\": \"{}\", \"title\": {}, \"source\": {}, \"confidence\": \"{}\", \"density_g_cm3\": {:.6g}, \"sound_speed_m_s\": {:.1f}, "
                                "\"laws\": \"{}\", \"checks\": \"{}\", \"remarks\": {}, \"notes\": {}}}",
                                rows.empty() ? "" : ", ", d.name, in_quotes(d.title), in_quotes(d.source), grades(d), m.density, 1e3 * m.sound_speed(), laws,
                                verdict(m), json_list(m.remarks), json_list(d.notes));
            continue;
        }
        fmt::print("{:<24} {:>8.1f} kg/m3 {:>8.0f} m/s  {:<38} {:<11} {}\n", d.name, 1e3 * m.density, 1e3 * m.sound_speed(), laws, verdict(m), grades(d));
        if (!full) continue;
        fmt::print("    {}\n    source: {}\n", d.title, d.source);
        for (const std::string& r : m.remarks) fmt::print("    check: {}\n", r);
    }
    if (json) fmt::print("[{}]\n", rows);
    else if (!full) fmt::print("Columns: density, sound speed, laws, consistency checks, how many numbers carry each grade (docs/materials.md). --full adds sources and checks.\n");
    return 0;
}

}  // namespace brisance
