// SPDX-License-Identifier: Apache-2.0
// brisance analyze: the fracture analysis once more, from the snapshots of a run, with the thresholds, zones and sections of its
// case.toml, which may be edited beforehand.
#include "analysis/section_report.h"
#include "app/commands.h"
#include "app/fracture.h"
#include "base/error.h"
#include "io/case_file.h"
#include "io/run_directory.h"
#include "io/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace brisance {

namespace {

template <class T> const std::vector<T>& values(const Snapshot& s, const std::string& name) {
    const auto* v = std::get_if<std::vector<T>>(&s.field(name).values);
    if (!v) throw ResourceError(fmt::format("snapshot field {} has an unexpected type", name));
    return *v;
}

/// The particles of a part, with their reference positions about the axis.
struct PartOfSnapshot {
    std::vector<std::size_t> at;
    std::vector<double> x, y, z;
};
PartOfSnapshot select(const Snapshot& s, std::uint8_t part, Point axis) {
    PartOfSnapshot p;
    const auto& number = values<std::uint8_t>(s, "part");
    const auto& u = values<float>(s, "displacement");
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (number[i] != part) continue;
        p.at.push_back(i);
        p.x.push_back(s.points[3 * i] - static_cast<double>(u[3 * i]) - axis.x);
        p.y.push_back(s.points[3 * i + 1] - static_cast<double>(u[3 * i + 1]) - axis.y);
        p.z.push_back(s.points[3 * i + 2] - static_cast<double>(u[3 * i + 2]));
    }
    return p;
}

}  // namespace

int analyze_command(const std::string& run, bool json) {
    const std::filesystem::path folder = run;
    if (!std::filesystem::exists(folder / "case.toml")) throw InputError(fmt::format("{} is not a run directory: it has no case.toml", run));
    const Case c = read_case((folder / "case.toml").string(), "", {});
    const std::vector<std::filesystem::path> files = list_snapshots(folder / "snapshots");
    if (files.empty()) throw InputError(fmt::format("{} holds no snapshots; ask for some with output.snapshots", run));

    // Parts are numbered solids first, then fluids, each in the order of the case.
    int number = -1, next = 0;
    for (const Formulation f : {Formulation::total_lagrangian, Formulation::updated_lagrangian})
        for (const PartData& p : c.parts)
            if (p.formulation == f) {
                if (p.name == c.analysis.part) number = next;
                ++next;
            }
    if (number < 0) throw InputError(fmt::format("{}: analysis.part = \"{}\" is not a part of the case", run, c.analysis.part));

    analysis::FractureReport report;
    report.threshold = c.analysis.damage_threshold;
    report.zone_edges = c.analysis.zone_radii;
    for (const SectionData& s : sections_of(c)) report.sections.push_back({s.name, s.z, 0, {}});
    for (const std::filesystem::path& file : files) {
        const Snapshot snapshot = read_snapshot(file);
        const PartOfSnapshot p = select(snapshot, static_cast<std::uint8_t>(number), c.analysis.axis);
        if (p.at.empty()) throw InputError(fmt::format("{} holds no particle of part {}", file.string(), c.analysis.part));
        const auto& damage = values<float>(snapshot, "damage");
        const auto& cause = values<std::uint8_t>(snapshot, "cause");
        const auto& size = values<float>(snapshot, "size");
        const auto& column = values<std::int32_t>(snapshot, "column");
        std::vector<double> radius;
        for (std::size_t k = 0; k < p.at.size(); ++k) radius.push_back(std::hypot(p.x[k], p.y[k]));

        analysis::SectionOptions options = section_options(c);
        for (analysis::SectionHistory& section : report.sections) {
            std::map<std::int32_t, std::size_t> nearest;  // of each column
            for (std::size_t k = 0; k < p.at.size(); ++k) {
                const auto [it, fresh] = nearest.try_emplace(column[p.at[k]], k);
                if (!fresh && std::abs(p.z[k] - section.z) < std::abs(p.z[it->second] - section.z) - 1e-6) it->second = k;
            }
            analysis::SectionPoints points;
            for (const auto& [number_of_column, k] : nearest) {
                points.x.push_back(p.x[k]);
                points.y.push_back(p.y[k]);
                points.size.push_back(static_cast<double>(size[p.at[k]]));
                points.damage.push_back(static_cast<double>(damage[p.at[k]]));
                points.cause.push_back(cause[p.at[k]]);
            }
            section.particles = points.count();
            options.specimen = specimen_of(radius, points.size);
            section.times.push_back(analysis::analyse_section(points, snapshot.time_us, options));
        }
        std::vector<double> pressure, radial;
        for (std::size_t i : p.at) {
            pressure.push_back(static_cast<double>(values<float>(snapshot, "peak_pressure")[i]));
            radial.push_back(static_cast<double>(values<float>(snapshot, "peak_radial_stress")[i]));
        }
        report.pressure = attenuation_of(radius, pressure, options.specimen);
        report.radial_stress = attenuation_of(radius, radial, options.specimen);
    }
    const std::string text = analysis::to_json(report);
    write_file(folder / "analysis" / "analysis_from_snapshots.json", text);
    if (json) fmt::print("{}\n", text);
    else
        for (const analysis::SectionHistory& s : report.sections)
            for (const analysis::SectionReport& t : s.times)
                fmt::print("{:<8} t {:8.2f} us  damaged {:6d}  crushed to {:5.2f} mm  radial cracks {:2d} (longest {:5.1f} mm)  spall at {:5.1f} mm over {:3.0f} %\n", s.name,
                           t.time, t.damaged, t.crushed_radius, t.radial.sustained_arms, t.radial.longest, t.spall.radius, 100 * t.spall.coverage);
    return 0;
}

}  // namespace brisance
