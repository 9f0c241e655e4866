// SPDX-License-Identifier: Apache-2.0
// brisance materials: the library, its sources and what the checks say of it.
#include "app/commands.h"
#include "base/error.h"
#include "io/case_file.h"
#include "laws/material.h"

#include <fmt/format.h>

namespace brisance {

namespace {

void print_law(const std::string& kind, const LawData& law) {
    fmt::print("  {} {}\n", kind, law.law);
    for (const auto& [name, v] : law.parameters) fmt::print("    {:<16} {:<16} {:<8} {}\n", name, v.text, v.confidence, v.source);
}

}  // namespace

int materials_command(const std::string& name, bool json) {
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
        for (const std::string& r : m.remarks) fmt::print("  {}\n", r);
        return 0;
    }
    std::string rows;
    for (const std::string& n : list_materials()) {
        const MaterialData d = read_material(n);
        const Material m = make_material(d);
        const std::string laws = d.eos.law + (d.strength ? " + " + d.strength->law : "") + (d.burn ? " + " + d.burn->law : "");
        if (json)
            rows += fmt::format("{}{{\"name\": \"{}\", \"title\": \"{}\", \"density_g_cm3\": {:.6g}, \"sound_speed_m_s\": {:.1f}, \"laws\": \"{}\"}}", rows.empty() ? "" : ", ",
                                d.name, d.title, m.density, 1e3 * m.sound_speed(), laws);
        else
            fmt::print("{:<24} {:>8.1f} kg/m3 {:>8.0f} m/s  {:<38} {}\n", d.name, 1e3 * m.density, 1e3 * m.sound_speed(), laws, d.title);
    }
    if (json) fmt::print("[{}]\n", rows);
    return 0;
}

}  // namespace brisance
