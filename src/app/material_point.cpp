// SPDX-License-Identifier: Apache-2.0
// brisance material: drives a material at one point along a path, and prints, writes or plots what it answers.
#include "app/commands.h"
#include "base/error.h"
#include "base/text.h"
#include "io/case_file.h"
#include "io/csv.h"
#include "io/path_file.h"
#include "laws/material.h"
#include "laws/point_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <unistd.h>

namespace brisance {

namespace {

/// "--rate = 5 m: ..." in place of a bare message.
double option(const std::string& name, const std::string& text, Dimension dimension) {
    try {
        return parse_quantity(text, dimension);
    } catch (const std::invalid_argument& e) {
        throw InputError("--" + name + " " + text + ": " + e.what());
    }
}

PathLeg leg(PathLeg::Kind kind, double target = 0) {
    PathLeg l;
    l.kind = kind;
    l.target = target;
    return l;
}
PathLeg strain_leg(Vec3<double> strain, double shear = 0) {
    PathLeg l = leg(PathLeg::Kind::strain);
    l.strain = strain;
    l.shear = shear;
    return l;
}
PathLeg axial_leg(double strain, double lateral) {
    PathLeg l = leg(PathLeg::Kind::axial);
    l.strain.z = strain;
    l.lateral = lateral;
    return l;
}

struct Preset {
    const char* name;
    const char* meaning;
    double strain;  ///< the default of --strain
    std::function<std::vector<PathLeg>(const PointOptions&, const Material&, double strain)> legs;
};

double pressure_of(const PointOptions& o, const char* fallback) { return option("pressure", o.pressure.empty() ? fallback : o.pressure, dimension::pressure); }
double velocity_of(const PointOptions& o) { return option("velocity", o.velocity.empty() ? "500 m/s" : o.velocity, dimension::velocity); }

const std::vector<Preset>& presets() {
    using K = PathLeg::Kind;
    static const std::vector<Preset> all = {
        {"uniaxial_strain", "compression to --strain with fixed sides, and back", 0.05,
         [](const PointOptions&, const Material&, double e) { return std::vector{strain_leg({0, 0, -e}), strain_leg({0, 0, 0})}; }},
        {"uniaxial_strain_tension", "extension to --strain with fixed sides", 0.01,
         [](const PointOptions&, const Material&, double e) { return std::vector{strain_leg({0, 0, e})}; }},
        {"compression", "axial compression to --strain, sides free", 0.02,
         [](const PointOptions&, const Material&, double e) { return std::vector{axial_leg(-e, 0)}; }},
        {"tension", "axial extension to --strain, sides free", 0.005,
         [](const PointOptions&, const Material&, double e) { return std::vector{axial_leg(e, 0)}; }},
        {"triaxial", "each --confinement as pressure all around, then axial compression to --strain with that pressure on the sides", 0.05,
         [](const PointOptions& o, const Material&, double e) {
             const double p = option("confinement", o.confinement.front(), dimension::pressure);
             std::vector<PathLeg> legs;
             if (p != 0) legs.push_back(leg(K::pressure, p));
             legs.push_back(axial_leg(-e, p));
             return legs;
         }},
        {"hydrostatic", "equal strains to --pressure, and back to none", 0,
         [](const PointOptions& o, const Material&, double) { return std::vector{leg(K::pressure, pressure_of(o, "1 GPa")), leg(K::pressure, 0)}; }},
        {"hydrostatic_tension", "equal extension to the volume strain --strain", 0.01,
         [](const PointOptions&, const Material&, double e) { return std::vector{leg(K::volume, 1 + e)}; }},
        {"shear", "simple shear to gamma = --strain", 0.1,
         [](const PointOptions&, const Material&, double e) { return std::vector{strain_leg({0, 0, 0}, e)}; }},
        {"shock", "along the Hugoniot to --velocity; an explosive to its Chapman-Jouguet state", 0,
         [](const PointOptions& o, const Material& m, double) { return std::vector{m.burn ? leg(K::cj) : leg(K::shock, velocity_of(o))}; }},
        {"release", "the shock, then the isentrope out to --volume (explosives 7, others 1)", 0,
         [](const PointOptions& o, const Material& m, double) {
             return std::vector{m.burn ? leg(K::cj) : leg(K::shock, velocity_of(o)), leg(K::volume, o.volume > 0 ? o.volume : m.burn ? 7 : 1)};
         }}};
    return all;
}

/// The paths that the options ask for: a file gives one, a preset one for every confinement.
std::vector<PointPath> paths_of(const PointOptions& o, const Material& m) {
    if (o.path.ends_with(".toml") || o.path.find('/') != std::string::npos) {
        if (!o.strain.empty() || !o.pressure.empty() || !o.velocity.empty() || o.volume > 0 || !o.confinement.empty() || !o.rate.empty() || o.steps > 0 || o.scale > 0 || o.damage > 0)
            throw InputError("--path " + o.path + ": a path file holds everything itself; the other options of a path go with presets");
        return {read_path(o.path)};
    }
    std::vector<std::string> names;
    for (const Preset& p : presets()) {
        names.emplace_back(p.name);
        if (o.path != p.name) continue;
        const double strain = o.strain.empty() ? p.strain : option("strain", o.strain, dimension::none);
        const double most = o.path == "shear" ? 100 : 0.95;
        if (!(strain > 0 && strain <= most) && p.strain > 0) throw InputError(fmt::format("--strain {}: allowed: above 0, up to {:g}", o.strain, most));
        std::vector<std::string> confinements = o.confinement.empty() ? std::vector<std::string>{"0 MPa"} : o.confinement;
        if (o.path != "triaxial" && !o.confinement.empty()) throw InputError("--confinement goes with --path triaxial only");
        std::vector<PointPath> paths;
        for (const std::string& c : confinements) {
            PointOptions one = o;
            one.confinement = {c};
            PointPath path;
            path.name = o.path == "triaxial" ? "triaxial, " + c : o.path;
            path.legs = p.legs(one, m, strain);
            path.scale = o.scale > 0 ? o.scale : 1;
            path.damage = o.damage;
            for (PathLeg& l : path.legs) {
                l.rate = option("rate", o.rate.empty() ? "1000 1/s" : o.rate, dimension::rate);
                if (!(l.rate > 0)) throw InputError("--rate " + o.rate + ": has to be > 0");
                if (o.steps > 0) l.steps = o.steps;
            }
            paths.push_back(std::move(path));
        }
        return paths;
    }
    throw InputError("--path " + o.path + ": no such preset" + did_you_mean(o.path, names) + "; there are: " + joined(names) + "; or a file NAME.toml");
}

struct Column {
    CsvColumn head;
    std::function<double(const PathPoint&)> value;
    bool shown = true;  ///< in the table of the terminal
};

std::vector<Column> columns_of(const Material& m) {
    const double density = m.density;
    std::vector<Column> c = {
        {{"leg", "-"}, [](const PathPoint& r) { return r.leg; }},
        {{"time", "us"}, [](const PathPoint& r) { return r.time; }, false},
        {{"strain_x", "-"}, [](const PathPoint& r) { return r.strain.x; }, false},
        {{"strain_y", "-"}, [](const PathPoint& r) { return r.strain.y; }, false},
        {{"strain_z", "-"}, [](const PathPoint& r) { return r.strain.z; }},
        {{"shear", "-"}, [](const PathPoint& r) { return r.shear; }, false},
        {{"volume", "-"}, [](const PathPoint& r) { return r.volume; }},
        {{"density", "g/cm3"}, [](const PathPoint& r) { return r.density; }},
        {{"stress_x", "GPa"}, [](const PathPoint& r) { return r.stress.xx; }, false},
        {{"stress_y", "GPa"}, [](const PathPoint& r) { return r.stress.yy; }, false},
        {{"stress_z", "GPa"}, [](const PathPoint& r) { return r.stress.zz; }},
        {{"stress_xy", "GPa"}, [](const PathPoint& r) { return r.stress.xy; }, false},
        {{"pressure", "GPa"}, [](const PathPoint& r) { return r.pressure; }},
        {{"mises", "GPa"}, [](const PathPoint& r) { return r.mises; }},
        {{"yield", "GPa"}, [](const PathPoint& r) { return r.yield; }},
        {{"energy", "GPa"}, [](const PathPoint& r) { return r.energy; }, false},
        {{"specific_energy", "MJ/kg"}, [density](const PathPoint& r) { return r.energy / density; }},
        {{"sound_speed", "mm/us"}, [](const PathPoint& r) { return r.sound_speed; }},
        {{"particle_velocity", "mm/us"}, [](const PathPoint& r) { return r.particle_velocity; }, false},
        {{"shock_speed", "mm/us"}, [](const PathPoint& r) { return r.shock_speed; }, false}};
    if (m.strength) {
        const std::vector<StateInfo> rows = m.strength->state();
        for (std::size_t k = 0; k < rows.size(); ++k)
            c.push_back({{rows[k].name, rows[k].unit}, [k](const PathPoint& r) { return r.state[k]; }});
    }
    return c;
}

struct Curve {
    PointPath path;
    std::vector<PathPoint> rows;
};

void print_table(const Material& m, const std::vector<Curve>& curves, std::vector<Column> columns) {
    const bool shocks = curves.front().path.legs.front().kind == PathLeg::Kind::shock || curves.front().path.legs.front().kind == PathLeg::Kind::cj;
    for (Column& c : columns) {
        if (shocks && (c.head.name == "particle_velocity" || c.head.name == "shock_speed")) c.shown = true;
        if (c.head.name == "stress_xy" && std::any_of(curves.begin(), curves.end(), [](const Curve& k) { return k.rows.back().shear != 0; })) c.shown = true;
    }
    std::erase_if(columns, [](const Column& c) { return !c.shown; });
    for (const Curve& curve : curves) {
        fmt::print("{}, {}: {} steps\n", m.name, curve.path.name, curve.rows.size() - 1);
        std::vector<std::size_t> widths;
        std::string heads, units;
        for (const Column& c : columns) {
            widths.push_back(std::max<std::size_t>({c.head.name.size(), c.head.unit.size(), 9}));
            heads += fmt::format("{:>{}} ", c.head.name, widths.back());
            units += fmt::format("{:>{}} ", c.head.unit, widths.back());
        }
        fmt::print("{}\n{}\n", heads, units);
        // about 20 rows, the last of every leg among them
        const std::size_t every = std::max<std::size_t>(1, (curve.rows.size() - 1) / 20);
        for (std::size_t i = 0; i < curve.rows.size(); ++i) {
            const bool last_of_leg = i + 1 == curve.rows.size() || curve.rows[i + 1].leg != curve.rows[i].leg;
            if (i % every != 0 && !last_of_leg) continue;
            std::string line;
            for (std::size_t k = 0; k < columns.size(); ++k) line += fmt::format("{:>{}.5g} ", columns[k].value(curve.rows[i]), widths[k]);
            fmt::print("{}\n", line);
        }
    }
}

std::string as_json(const Material& m, const std::vector<Curve>& curves, const std::vector<Column>& columns) {
    std::string out = fmt::format("{{\"material\": {}, \"units\": {{", in_quotes(m.name));
    for (std::size_t k = 0; k < columns.size(); ++k) out += fmt::format("{}\"{}\": \"{}\"", k ? ", " : "", columns[k].head.name, columns[k].head.unit);
    out += "}, \"paths\": [";
    for (std::size_t c = 0; c < curves.size(); ++c) {
        out += fmt::format("{}{{\"name\": {}", c ? ", " : "", in_quotes(curves[c].path.name));
        for (const Column& column : columns) {
            out += fmt::format(", \"{}\": [", column.head.name);
            for (std::size_t i = 0; i < curves[c].rows.size(); ++i) out += fmt::format("{}{}", i ? ", " : "", column.value(curves[c].rows[i]));
            out += "]";
        }
        out += "}";
    }
    return out + "]}\n";
}

void write_csv(const std::filesystem::path& file, const std::vector<Curve>& curves, const std::vector<Column>& columns) {
    std::vector<CsvColumn> heads{{"path", ""}};
    for (const Column& c : columns) heads.push_back(c.head);
    CsvFile csv(file, heads);
    for (const Curve& curve : curves)
        for (const PathPoint& r : curve.rows) {
            std::vector<CsvCell> cells{curve.path.name};
            for (const Column& c : columns) cells.emplace_back(c.value(r));
            csv.row(cells);
        }
    csv.close();
}

}  // namespace

std::string point_presets() {
    std::string text;
    for (const Preset& p : presets()) text += fmt::format("  {:<24} {}{}\n", p.name, p.meaning, p.strain > 0 ? fmt::format(" (default {:g})", p.strain) : "");
    return text;
}

int material_command(const PointOptions& o) {
    const Material m = make_material(read_material(o.material));
    const std::vector<Column> columns = columns_of(m);
    std::vector<Curve> curves;
    for (PointPath& path : paths_of(o, m)) {
        std::vector<PathPoint> rows = drive(m, path);
        curves.push_back({std::move(path), std::move(rows)});
    }
    for (const std::string& r : m.remarks)
        if (r.starts_with("warning")) fmt::print(stderr, "{}\n", r);
    if (!o.csv.empty()) write_csv(o.csv, curves, columns);
    if (o.json) fmt::print("{}", as_json(m, curves, columns));
    else if (o.csv.empty()) print_table(m, curves, columns);
    if (o.plot.empty()) return 0;
    // the plot reads the same table that --csv writes
    const std::filesystem::path table = std::filesystem::temp_directory_path() / fmt::format("brisance_material_{}.csv", getpid());
    write_csv(table, curves, columns);
    const int code = run_python("material_point.py", {table.string(), "--out", o.plot, "--title", m.name});
    std::error_code ignored;
    std::filesystem::remove(table, ignored);
    return code;
}

}  // namespace brisance
