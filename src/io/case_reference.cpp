// SPDX-License-Identifier: Apache-2.0
// The table of all keys of a case file, and its reading as Markdown. Whoever adds a key adds a row here and uses it in case_file.cpp.
#include "base/text.h"
#include "io/case_file.h"
#include "io/config.h"

namespace brisance {

using namespace config;

namespace {

std::vector<Key> root_keys() {
    return {
        {.name = "title", .type = Type::text, .meaning = "one line for reports", .fallback = "\"\""},
        {.name = "include", .type = Type::text, .meaning = "files to read first, relative to this one; what this file says wins", .absent = "no other file", .count = Count::list},
        {.name = "parts", .type = Type::text, .meaning = "the parts that take part, in order: a later part cuts into the earlier ones", .count = Count::list},
        {.name = "run", .type = Type::table, .meaning = "duration and arithmetic", .group = "run"},
        {.name = "part", .type = Type::named, .meaning = "bodies: a shape filled with particles of one material", .group = "part"},
        {.name = "material", .type = Type::named, .meaning = "materials of this case, most often variants of one in the library", .absent = "library only", .group = "material"},
        {.name = "slice", .type = Type::table, .meaning = "plane strain: a periodic slab in place of the whole body", .absent = "three-dimensional", .group = "slice"},
        {.name = "detonation", .type = Type::tables, .meaning = "where and when explosives are lit", .fallback = "[]", .group = "detonation"},
        {.name = "boundary", .type = Type::tables, .meaning = "fixed planes, rigid platens, pressures and planes of symmetry", .fallback = "[]", .group = "boundary"},
        {.name = "contact", .type = Type::table, .meaning = "penalty contact between parts", .fallback = "{}", .group = "contact"},
        {.name = "gauge", .type = Type::tables, .meaning = "points whose history is recorded", .fallback = "[]", .group = "gauge"},
        {.name = "analysis", .type = Type::table, .meaning = "what is counted as cracks, and where", .absent = "no crack analysis", .group = "analysis"},
        {.name = "output", .type = Type::table, .meaning = "what is written, and when", .fallback = "{}", .group = "output"},
        {.name = "step", .type = Type::table, .meaning = "control of the time step", .fallback = "{}", .group = "step"},
        {.name = "preset", .type = Type::named, .meaning = "variants of the case, chosen by --preset", .absent = "no presets", .group = "preset"},
    };
}

/// A preset says what a case says, but for includes and further presets.
std::vector<Key> preset_keys() {
    std::vector<Key> keys{{.name = "extends", .type = Type::text, .meaning = "another preset that is applied first", .absent = "none"}};
    for (const Key& key : root_keys())
        if (key.name != "include" && key.name != "preset") keys.push_back(key);
    return keys;
}

Key quantity(const char* name, Dimension dimension, const char* meaning, Range range = any) {
    return {.name = name, .type = Type::quantity, .meaning = meaning, .dimension = dimension, .range = range};
}

Key place(const char* name, const char* meaning) {
    Key key = quantity(name, dimension::length, meaning);
    key.count = Count::three;
    return key;
}

Key or_else(Key key, const char* absent) {
    key.absent = absent;
    return key;
}

Key or_default(Key key, const char* fallback) {
    key.fallback = fallback;
    return key;
}

Key number(const char* name, const char* fallback, const char* meaning, Range range) {
    return {.name = name, .type = Type::number, .meaning = meaning, .fallback = fallback, .range = range};
}

Key shape(const char* name, const char* meaning) { return {.name = name, .type = Type::table, .meaning = meaning, .group = "shape"}; }

Schema make_schema() {
    const Key direction{.name = "normal", .type = Type::number, .meaning = "a vector along the normal; its length does not matter", .count = Count::three};
    const Key part_name{.name = "part", .type = Type::text, .meaning = "name of a part"};
    Schema schema;
    schema.groups = {
        {.name = "case", .heading = "the case", .meaning = "The root of the file.", .keys = root_keys()},
        {.name = "run", .heading = "[run]", .meaning = "Duration and arithmetic.", .keys = {
            quantity("until", dimension::time, "end of the run", positive),
            {.name = "seed", .type = Type::integer, .meaning = "seed from which those of the parts follow", .fallback = "1", .range = not_negative},
            {.name = "precision", .type = Type::choice, .meaning = "floating-point numbers of the fields", .fallback = "\"double\"", .choices = {"double", "single"}},
        }},
        {.name = "part", .heading = "[part.NAME]", .meaning = "A body. A part that `parts` does not list stays out of the run, but has to be complete.", .keys = {
            {.name = "material", .type = Type::text, .meaning = "a [material.NAME] of this case, a name in the library, or a file"},
            shape("shape", "the space that it fills"),
            {.name = "formulation", .type = Type::choice, .meaning = "total-Lagrangian for rock and metal, updated-Lagrangian for what flows", .choices = {"total_lagrangian", "updated_lagrangian"}},
            quantity("spacing", dimension::length, "distance between particles in the x-y section, at its finest", positive),
            or_else(quantity("spacing_far", dimension::length, "the same at its coarsest", positive), "as `spacing`: no grading"),
            or_else(quantity("grading_radius", dimension::length, "distance from the z axis at which the spacing begins to grow", not_negative), "to be given with a coarser `spacing_far`"),
            or_else({.name = "grading_growth", .type = Type::number, .meaning = "growth of the spacing, mm per mm of distance", .range = positive}, "to be given with a coarser `spacing_far`"),
            or_else(quantity("spacing_z", dimension::length, "distance between particles along z", positive), "as `spacing`"),
            number("smoothing", "1.3", "smoothing length over spacing", {0.8, 3}),
            {.name = "arrangement", .type = Type::choice, .meaning = "relaxed cloud without preferred direction, or square lattice", .fallback = "\"relaxed\"", .choices = {"relaxed", "lattice"}},
            {.name = "angle", .type = Type::angle, .meaning = "rotation of the arrangement about z", .fallback = "\"0 deg\""},
            or_else({.name = "seed", .type = Type::integer, .meaning = "seed of the arrangement", .range = at_least_one}, "follows from run.seed and the part's name"),
            {.name = "z_phase", .type = Type::flag, .meaning = "each column of particles has its own phase along z, so that no horizontal lattice plane remains", .fallback = "true"},
            {.name = "velocity", .type = Type::quantity, .meaning = "initial velocity", .fallback = "[\"0 m/s\", \"0 m/s\", \"0 m/s\"]", .dimension = dimension::velocity, .count = Count::three},
            {.name = "initial", .type = Type::table, .meaning = "initial fields that vary in space", .absent = "none", .group = "initial"},
            {.name = "viscosity", .type = Type::table, .meaning = "artificial viscosity", .fallback = "{pairwise = {alpha = 1.0, beta = 2.0}}", .group = "viscosity"},
            or_else(number("zero_energy", "", "stiffness of the zero-energy control over the longitudinal modulus; total_lagrangian only", {0, 1}), "0.05 (total_lagrangian)"),
            or_else({.name = "artificial_stress", .type = Type::table, .meaning = "artificial stress against the tensile instability; updated_lagrangian only", .group = "artificial_stress", .or_flag = true}, "false"),
            or_else({.name = "failure", .type = Type::table, .meaning = "what happens to a failed particle, and stresses at which one fails besides the law's own damage; total_lagrangian only", .group = "failure"}, "`{}`"),
            {.name = "heterogeneity", .type = Type::table, .meaning = "random field of strength; total_lagrangian only", .absent = "homogeneous", .group = "heterogeneity"},
        }},
        {.name = "initial", .heading = "[part.NAME.initial]", .meaning = "Formulas in x, y, z, with units: `\"10 m/s * exp(-((x - 25 mm)/1.5 mm)^2)\"`. Operators + - * / ^; pi; sqrt exp log sin cos tan sinh cosh tanh atan2 abs min max hypot besselj0 besselj1; step(a) is 1 where a >= 0 and 0 elsewhere.", .keys = {
            {.name = "velocity", .type = Type::text, .meaning = "three formulas, added to `velocity` of the part", .absent = "none", .count = Count::three},
            {.name = "density", .type = Type::text, .meaning = "density of an updated_lagrangian part; the mass of its particles follows", .absent = "that of the material"},
            {.name = "energy", .type = Type::text, .meaning = "internal energy per mass of an updated_lagrangian part", .absent = "that of the material"},
        }},
        {.name = "shape", .heading = "shape", .meaning = "Exactly one of these. Shapes nest.", .keys = {
            {.name = "cylinder", .type = Type::table, .meaning = "a cylinder about the line from `from` to `to`", .group = "cylinder"},
            {.name = "annulus", .type = Type::table, .meaning = "a cylinder with a coaxial hole", .group = "annulus"},
            {.name = "box", .type = Type::table, .meaning = "a box along the axes", .group = "box"},
            {.name = "sphere", .type = Type::table, .meaning = "a sphere", .group = "sphere"},
            {.name = "half_space", .type = Type::table, .meaning = "everything behind a plane, seen along its normal", .group = "half_space"},
            {.name = "union", .type = Type::tables, .meaning = "all shapes of a list together", .group = "shape"},
            {.name = "intersection", .type = Type::tables, .meaning = "what all shapes of a list have in common", .group = "shape"},
            {.name = "difference", .type = Type::tables, .meaning = "the first shape of a list without the others", .group = "shape"},
        }, .choice = true},
        {.name = "cylinder", .heading = "shape.cylinder", .meaning = "", .keys = {
            place("from", "centre of one end"), place("to", "centre of the other end"), quantity("radius", dimension::length, "radius", positive)}},
        {.name = "annulus", .heading = "shape.annulus", .meaning = "", .keys = {
            place("from", "centre of one end"), place("to", "centre of the other end"),
            quantity("inner_radius", dimension::length, "radius of the hole", positive), quantity("outer_radius", dimension::length, "outer radius, above the inner one", positive)}},
        {.name = "box", .heading = "shape.box", .meaning = "", .keys = {
            place("min", "corner with the smallest coordinates"), place("max", "corner with the largest coordinates")}},
        {.name = "sphere", .heading = "shape.sphere", .meaning = "", .keys = {
            place("centre", "centre"), quantity("radius", dimension::length, "radius", positive)}},
        {.name = "half_space", .heading = "shape.half_space", .meaning = "", .keys = {
            place("point", "a point of the plane"), direction}},
        {.name = "viscosity", .heading = "[part.NAME.viscosity]", .meaning = "One of these, or both.", .keys = {
            {.name = "pairwise", .type = Type::table, .meaning = "Monaghan's Pi_ij between approaching pairs; it resists shear too", .absent = "off", .group = "pairwise"},
            {.name = "bulk", .type = Type::table, .meaning = "bulk viscosity in the stress of each particle; resists compression alone", .absent = "off", .group = "bulk"},
        }},
        {.name = "pairwise", .heading = "viscosity.pairwise", .meaning = "", .keys = {
            number("alpha", "1.0", "linear coefficient", not_negative), number("beta", "2.0", "quadratic coefficient", not_negative)}},
        {.name = "bulk", .heading = "viscosity.bulk", .meaning = "", .keys = {
            number("linear", "0.06", "C_l", not_negative), number("quadratic", "1.5", "C_q", not_negative)}},
        {.name = "artificial_stress", .heading = "[part.NAME.artificial_stress]", .meaning = "Or `artificial_stress = true` for these defaults.", .keys = {
            number("epsilon", "0.5", "strength of the repulsion", not_negative), number("n", "4.0", "power of the kernel ratio", positive)}},
        {.name = "failure", .heading = "[part.NAME.failure]", .meaning = "", .keys = {
            {.name = "mode", .type = Type::choice, .meaning = "what a failed particle still carries: the law's fractured strength, pressure only, nothing", .fallback = "\"jh2\"", .choices = {"jh2", "no_tension_no_shear", "all_zero"}},
            or_else(quantity("tensile_strength", dimension::pressure, "largest principal stress at which a particle fails", positive), "off"),
            or_else(quantity("fracture_energy", dimension::energy_per_area, "energy per area of a tensile crack: the stress falls from `tensile_strength` to nothing as the crack opens, over a band of 2.2 spacings", positive), "fails at once"),
            or_else(quantity("shear_strength", dimension::pressure, "largest shear stress at which a particle fails", positive), "off"),
        }},
        {.name = "heterogeneity", .heading = "[part.NAME.heterogeneity]", .meaning = "", .keys = {
            {.name = "weibull_modulus", .type = Type::number, .meaning = "Weibull modulus of the strength; 0: homogeneous", .range = not_negative},
            quantity("correlation_length", dimension::length, "distance over which the strength is alike", positive),
            {.name = "seed", .type = Type::integer, .meaning = "seed of the field; it belongs to the rock, not to the arrangement", .fallback = "1", .range = not_negative},
        }},
        {.name = "material", .heading = "[material.NAME]", .meaning = "A variant of `base`, or without a base a whole material as in a material file. Another `law` drops the parameters of the base's law.", .keys = {
            {.name = "base", .type = Type::text, .meaning = "the material that is varied", .absent = "a whole material"},
            {.name = "title", .type = Type::text, .meaning = "one line for reports", .absent = "that of the base"},
            {.name = "source", .type = Type::text, .meaning = "where the values come from", .absent = "\"case file\""},
            {.name = "notes", .type = Type::text, .meaning = "remarks", .absent = "none", .count = Count::list},
            {.name = "density", .type = Type::material, .meaning = "density", .absent = "that of the base"},
            {.name = "eos", .type = Type::material, .meaning = "equation of state: `law` and its parameters", .absent = "that of the base"},
            {.name = "strength", .type = Type::material, .meaning = "strength law and its parameters", .absent = "that of the base"},
            {.name = "burn", .type = Type::material, .meaning = "burn law and its parameters", .absent = "that of the base"},
        }},
        {.name = "slice", .heading = "[slice]", .meaning = "Plane strain. The z of gauges and sections gives way to that of the slice.", .keys = {
            quantity("z", dimension::length, "centre of the slab"),
            {.name = "layers", .type = Type::integer, .meaning = "thickness in layers of spacing_z of `part`; fastest in multiples of 8, in single precision of 16", .fallback = "8", .range = config::count},
            {.name = "part", .type = Type::text, .meaning = "the part whose spacing_z counts"},
        }},
        {.name = "detonation", .heading = "[[detonation]]", .meaning = "", .keys = {
            {.name = "part", .type = Type::text, .meaning = "a part whose material has a burn law"},
            {.name = "kind", .type = Type::choice, .meaning = "lit at a point, along a line, or everywhere at once", .choices = {"point", "line", "instant"}},
            or_else(place("at", "the point"), "to be given with kind = \"point\""),
            or_else(place("from", "one end of the line"), "to be given with kind = \"line\""),
            or_else(place("to", "the other end"), "to be given with kind = \"line\""),
            or_default(quantity("time", dimension::time, "when it is lit", not_negative), "\"0 us\""),
        }},
        {.name = "boundary", .heading = "[[boundary]]", .meaning = "", .keys = {
            {.name = "kind", .type = Type::choice, .meaning = "particles within one spacing of a plane, or inside a shape, keep components of their displacement; a plane that nothing passes; a pressure on walls; a plane of symmetry of an updated_lagrangian part, normal to an axis", .choices = {"fix", "platen", "pressure", "mirror"}},
            {.name = "part", .type = Type::text, .meaning = "name of a part, or \"*\" for all; a part that stays out of the run takes its boundaries along"},
            or_else(place("point", "a point of the plane"), "to be given with fix (unless `on` is), platen and mirror"),
            or_else(direction, "to be given with `point`; it points out of the material"),
            {.name = "fix", .type = Type::choice, .meaning = "components of the displacement that stay zero", .absent = "to be given with fix", .count = Count::list, .choices = {"x", "y", "z"}},
            or_else(shape("on", "pressure: walls of the part inside this shape are loaded; fix: its particles inside this shape are held"), "to be given with pressure"),
            {.name = "times", .type = Type::quantity, .meaning = "times of the pressure history, ascending; linear between", .absent = "to be given with pressure", .dimension = dimension::time, .range = not_negative, .count = Count::list},
            {.name = "values", .type = Type::quantity, .meaning = "pressures at these times", .absent = "to be given with pressure", .dimension = dimension::pressure, .count = Count::list},
        }},
        {.name = "contact", .heading = "[contact]", .meaning = "", .keys = {
            {.name = "pairs", .type = Type::names, .meaning = "pairs of parts that may touch", .fallback = "\"all\""},
            number("stiffness", "1.0", "factor on the stiffness of the materials", positive),
            number("damping", "0.05", "fraction of critical damping", not_negative),
            number("friction", "0.0", "Coulomb coefficient; 0: no friction term", not_negative),
        }},
        {.name = "gauge", .heading = "[[gauge]]", .meaning = "", .keys = {
            {.name = "name", .type = Type::text, .meaning = "name in the output"},
            part_name,
            place("at", "where, at time zero"),
        }},
        {.name = "analysis", .heading = "[analysis]", .meaning = "", .keys = {
            {.name = "part", .type = Type::text, .meaning = "the part whose cracks are counted"},
            number("damage_threshold", "0.8", "a particle with more damage belongs to a crack", fraction),
            {.name = "zones", .type = Type::quantity, .meaning = "radii that bound the zones of the crack density, ascending", .dimension = dimension::length, .range = not_negative, .count = Count::list},
            {.name = "sectors", .type = Type::integer, .meaning = "sectors of the polar distribution", .fallback = "72", .range = config::count},
            {.name = "axis", .type = Type::quantity, .meaning = "x and y of the borehole axis", .fallback = "[\"0 mm\", \"0 mm\"]", .dimension = dimension::length, .count = Count::two},
            {.name = "sections", .type = Type::tables, .meaning = "sections normal to the axis", .fallback = "[]", .group = "section"},
            quantity("tensile_strength", dimension::pressure, "principal stress that labels a failure as tensile", positive),
            quantity("shear_strength", dimension::pressure, "shear stress that labels a failure as shear", positive),
        }},
        {.name = "section", .heading = "analysis.sections", .meaning = "", .keys = {
            {.name = "name", .type = Type::text, .meaning = "name in the output"},
            quantity("z", dimension::length, "height, inside the analysed part"),
        }},
        {.name = "output", .heading = "[output]", .meaning = "", .keys = {
            {.name = "snapshots", .type = Type::quantity, .meaning = "times of snapshots: an interval, or a list; times after `until` are left out", .fallback = "[]", .dimension = dimension::time, .range = not_negative, .count = Count::one_or_list},
            or_else(quantity("history", dimension::time, "interval between rows of gauges, audit and analysis", positive), "until / 1000"),
            or_default(quantity("checkpoint", dimension::time, "wall time between checkpoints", positive), "\"600 s\""),
        }},
        {.name = "step", .heading = "[step]", .meaning = "", .keys = {
            number("courant_solid", "0.8", "fraction of the stable step of total-Lagrangian parts", {0, 1, true}),
            number("courant_fluid", "0.4", "fraction of the stable step of updated-Lagrangian parts", {0, 1, true}),
            number("growth", "1.02", "largest ratio of successive steps", at_least_one),
            or_default(quantity("minimum", dimension::time, "the run stops when the step falls below", not_negative), "\"1e-6 us\""),
            number("energy_residual_limit", "0.05", "the run stops when the relative error of energy rises above", positive),
            or_default(quantity("velocity_limit", dimension::velocity, "the run stops when a particle is faster", positive), "\"30 km/s\""),
            number("torn_limit", "0.01", "the run stops when more than this fraction of a solid's particles is torn", fraction),
            number("leak_limit", "0.01", "the run stops when more than this fraction of all fluid particles stands inside solids", fraction),
        }},
        {.name = "preset", .heading = "[preset.NAME]", .meaning = "The same keys as the case, written over it. Tables are merged, everything else is replaced.", .keys = preset_keys()},
    };
    return schema;
}

/// A bar would end the cell of a Markdown table.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

std::string default_of(const Key& key) {
    if (key.required()) return "**must be given**";
    return key.fallback.empty() ? key.absent : "`" + key.fallback + "`";
}

}  // namespace

const Schema& case_schema() {
    static const Schema schema = make_schema();
    return schema;
}

std::string case_file_reference() {
    const Schema& schema = case_schema();
    std::string page =
        "# The case file\n\n"
        "A case is a TOML file. Values with a dimension are texts with their unit: `\"0.15 mm\"`; numbers are for what has none. An unknown\n"
        "key, one without effect, a missing unit or a wrong dimension is an error. Included files are read first, then the file itself,\n"
        "then the preset, then `--set key.path=value`; tables are merged, everything else is replaced. This page is written by the program.\n";
    for (const Group& group : schema.groups) {
        page += "\n## " + (group.heading.front() == '[' || group.heading.find('.') != std::string::npos ? "`" + group.heading + "`" : group.heading) + "\n";
        if (!group.meaning.empty()) page += "\n" + group.meaning + "\n";
        if (group.name == "preset") {
            page += "Besides: `extends`, another preset that is applied first.\n";
            continue;
        }
        page += "\n| key | allowed | default | meaning |\n|---|---|---|---|\n";
        for (const Key& key : group.keys)
            page += "| `" + key.name + "` | " + cell(allowed(key, schema)) + " | " + (group.choice ? "" : cell(default_of(key))) + " | " + cell(key.meaning) + " |\n";
    }
    return page;
}

}  // namespace brisance
