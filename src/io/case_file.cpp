// SPDX-License-Identifier: Apache-2.0
// From text to a Case, in three steps: gather (includes, preset, --set) into one tree; check the tree against the table of keys
// (case_reference.cpp), which fills in defaults; translate it, with the checks that need more than one value.
#include "io/case_file.h"

#include "base/error.h"
#include "base/text.h"
#include "io/config.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>

namespace brisance {

using namespace config;
namespace fs = std::filesystem;

namespace {

// --- gather ----------------------------------------------------------------------------------------------------------------

bool is_choice(const std::string& key) { return case_schema().is_choice(key); }

std::vector<std::string> root_keys() {
    std::vector<std::string> names;
    for (const Key& key : case_schema().groups.front().keys) names.push_back(key.name);
    return names;
}

void remove(Node& table, const std::string& key) {
    std::erase_if(table.children, [&](const Node& child) { return child.key == key; });
}

/// The file with all that it includes. `open`: the files that led here, against cycles.
Node load(const std::string& file, const std::string& asked_at, std::vector<std::string> open) {
    const std::string identity = fs::weakly_canonical(file).string();
    const bool cycle = std::find(open.begin(), open.end(), identity) != open.end();
    open.push_back(identity);
    if (cycle) throw InputError(asked_at + ": include = " + in_quotes(file) + ": files include each other in a circle: " + joined(open, " -> "));

    Node own = parse_file(file, asked_at);
    Node all;
    all.where = own.where;
    if (const Node* include = own.find("include")) {
        if (!include->is_list()) fail(*include, "include has to be a list of file names in quotes");
        for (const Node& name : include->children) {
            if (!name.is_text()) fail(name, "include has to be a list of file names in quotes");
            const std::string path = (fs::path(file).parent_path() / name.text).lexically_normal().string();
            merge(all, load(path, name.where, open), is_choice);
        }
    }
    remove(own, "include");
    merge(all, own, is_choice);
    all.where = own.where;
    return all;
}

void set_via(Node& node, const std::string& via) {
    node.via = via;
    for (Node& child : node.children) set_via(child, via);
}

/// Presets in the order in which they are applied: what `name` extends comes first.
void apply_preset(Node& root, const Node& presets, const std::string& name, const std::string& asked_by, std::vector<std::string> chain) {
    const Node* found = nullptr;
    for (const Node& preset : presets.children)
        if (preset.key == name) found = &preset;
    if (!found)
        throw InputError(asked_by + ": no preset '" + name + "'" + did_you_mean(name, presets.names()) + "; there are: " + joined(presets.names()));
    const bool cycle = std::find(chain.begin(), chain.end(), name) != chain.end();
    chain.push_back(name);
    if (cycle) throw InputError(asked_by + ": presets extend each other in a circle: " + joined(chain, " -> "));

    Node preset = *found;
    if (const Node* extends = preset.find("extends")) apply_preset(root, presets, extends->text, origin(*extends) + ": extends", chain);
    remove(preset, "extends");
    set_via(preset, "preset " + name);
    merge(root, preset, is_choice);
}

std::vector<std::string> split(const std::string& path) {
    std::vector<std::string> pieces;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t dot = std::min(path.find('.', begin), path.size());
        pieces.push_back(trimmed(path.substr(begin, dot - begin)));
        begin = dot + 1;
    }
    return pieces;
}

/// Puts `value` at the place that the pieces from `depth` on name, making tables on the way.
void put(Node& at, const std::vector<std::string>& pieces, std::size_t depth, Node value) {
    const std::string& piece = pieces[depth];
    const bool last = depth + 1 == pieces.size();
    Node* next = nullptr;
    if (at.is_list()) {
        const bool is_index = !piece.empty() && piece.size() < 9 && piece.find_first_not_of("0123456789") == std::string::npos;
        const std::size_t index = is_index ? std::stoul(piece) : at.children.size();
        if (index >= at.children.size())
            throw InputError(value.where + ": '" + piece + "' is no element of the list " + joined({pieces.begin(), pieces.begin() + static_cast<long>(depth)}, ".") +
                             "; allowed: 0 to " + std::to_string(static_cast<long>(at.children.size()) - 1));
        next = &at.children[index];
    } else {
        if (!at.is_table()) {
            Node table;
            table.key = at.key;
            table.where = value.where;
            at = table;
        }
        if (is_choice(at.key) && !at.has(piece)) at.children.clear();
        next = at.child(piece);
        if (!next) {
            Node made;
            made.key = piece;
            made.where = value.where;
            at.children.push_back(made);
            next = &at.children.back();
        }
    }
    if (!last) return put(*next, pieces, depth + 1, std::move(value));
    value.key = next->key;
    *next = std::move(value);
}

void apply_setting(Node& root, const std::string& setting) {
    const std::string where = "--set " + one_line(setting);
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw InputError(where + ": has to be key.path=value");
    std::vector<std::string> pieces = split(setting.substr(0, equals));
    if (std::find(pieces.begin(), pieces.end(), "") != pieces.end()) throw InputError(where + ": a name in the path is empty; it has to be key.path=value");

    std::vector<std::string> names = root_keys();
    const Node* parts = nullptr;
    for (const Node& child : root.children)
        if (child.key == "part") parts = &child;
    if (std::find(names.begin(), names.end(), pieces.front()) == names.end()) {
        if (parts && parts->has(pieces.front())) {
            pieces.insert(pieces.begin(), "part");
        } else {
            if (parts)
                for (const std::string& name : parts->names()) names.push_back(name);
            throw InputError(where + ": unknown key or part '" + pieces.front() + "'" + did_you_mean(pieces.front(), names) + "; a path begins with one of: " + joined(names));
        }
    }
    if (pieces.front() == "include" || pieces.front() == "preset") throw InputError(where + ": '" + pieces.front() + "' can not be set from the command line");
    put(root, pieces, 0, parse_value(setting.substr(equals + 1), where));
}

bool is_name(const std::string& name) {
    const auto allowed_char = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    return !name.empty() && std::all_of(name.begin(), name.end(), allowed_char);
}

/// Presets that are not chosen are checked too, as far as this is possible without applying them.
void check_presets(Node& root) {
    const Schema& schema = case_schema();
    Node* presets = root.child("preset");
    if (!presets) return;
    if (!presets->is_table()) fail(*presets, "this has to be a table for each preset: [preset.NAME]");
    const Node* parts = root.child("part");
    for (Node& preset : presets->children) {
        // On a copy: the values stay as written until they have been merged.
        Node copy = preset;
        complete(copy, schema.group("preset"), schema, Check::partial);
        if (const Node* its_parts = copy.find("part"))
            for (const Node& part : its_parts->children)
                if ((!parts || !parts->has(part.key)) && !(part.has("material") && part.has("shape")))
                    fail(part, "no part '" + part.key + "'" + did_you_mean(part.key, parts ? parts->names() : std::vector<std::string>()) + "; there are: " +
                                   joined(parts ? parts->names() : std::vector<std::string>()));
        if (const Node* extends = copy.find("extends"); extends && !presets->has(extends->text))
            fail(*extends, "no preset '" + extends->text + "'" + did_you_mean(extends->text, presets->names()) + "; there are: " + joined(presets->names()));
    }
}

Node gather(const std::string& file, const std::string& preset, const std::vector<std::string>& settings) {
    Node root = load(file, "", {});
    set_paths(root);
    check_presets(root);
    Node presets;
    if (const Node* given = root.find("preset")) presets = *given;
    remove(root, "preset");
    if (!preset.empty()) apply_preset(root, presets, preset, "--preset " + preset, {});
    for (const std::string& setting : settings) apply_setting(root, setting);
    set_paths(root);
    return root;
}

/// What `parts` says has to fit the tables [part.NAME]. Done before the general check, whose messages would be less to the point.
void check_parts(const Node& root) {
    const Node* parts = root.find("parts");
    const Node* tables = root.find("part");
    if (!parts || !parts->is_list() || !tables || !tables->is_table()) return;
    if (parts->children.empty()) fail(*parts, "no parts: at least one has to take part; there are: " + joined(tables->names()));
    const std::vector<std::string> listed = parts->texts(), reserved = root_keys();
    std::set<std::string> seen;
    for (const Node& name : parts->children) {
        if (!seen.insert(name.text).second) fail(name, "the part '" + name.text + "' is listed twice");
        if (!tables->has(name.text)) fail(name, "no part '" + name.text + "'" + did_you_mean(name.text, tables->names()) + "; there are: " + joined(tables->names()));
    }
    for (const Node& part : tables->children) {
        if (!is_name(part.key)) fail(part, "the name of a part consists of letters, digits, '_' and '-'");
        if (std::find(reserved.begin(), reserved.end(), part.key) != reserved.end()) fail(part, "'" + part.key + "' is a key of the case and can not name a part");
        const bool is_listed = std::find(listed.begin(), listed.end(), part.key) != listed.end();
        if (!is_listed && !(part.has("material") && part.has("shape")))
            fail(part, "the part '" + part.key + "' is not listed in `parts`" + did_you_mean(part.key, listed) + "; listed are: " + joined(listed) +
                           " (a part may stay out, but then it has to be complete)");
    }
}

// --- translate -------------------------------------------------------------------------------------------------------------

template <class Enum>
Enum which(const Node& node, std::initializer_list<std::pair<const char*, Enum>> values) {
    for (const auto& [name, value] : values)
        if (node.text == name) return value;
    fail(node, "a choice that the table of keys has and the program has not");
}

/// A key that another value makes mandatory.
const Node& need(const Node& table, const std::string& key, const std::string& because) {
    if (const Node* node = table.find(key)) return *node;
    fail(table, "the key '" + key + "' is missing; it has to be given with " + because);
}

bool same(Point a, Point b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

Point direction(const Node& node) {
    const Point vector = node.point();
    if (norm(vector) == 0) fail(node, "a normal of length zero has no direction");
    return (1 / norm(vector)) * vector;
}

ShapePtr read_shape(const Node& node) {
    const Node& one = node.children.front();
    one.read = true;
    const std::string& kind = one.key;
    if (kind == "cylinder" || kind == "annulus") {
        const Node& to = one.at("to");
        const Point from = one.at("from").point();
        if (same(from, to.point())) fail(to, "the two ends are the same point: a length of zero");
        if (kind == "cylinder") return make_cylinder(from, to.point(), one.at("radius").number);
        const Node& inner = one.at("inner_radius");
        const double outer = one.at("outer_radius").number;
        if (inner.number >= outer) fail(inner, "the inner radius has to be smaller than the outer one, " + in_quotes(one.at("outer_radius").text));
        return make_annulus(from, to.point(), inner.number, outer);
    }
    if (kind == "box") {
        const Node& max = one.at("max");
        const Point a = one.at("min").point(), b = max.point();
        if (!(a.x < b.x && a.y < b.y && a.z < b.z)) fail(max, "each coordinate has to be larger than that of min = " + to_toml(one.at("min")));
        return make_box(a, b);
    }
    if (kind == "sphere") return make_sphere(one.at("centre").point(), one.at("radius").number);
    if (kind == "half_space") return make_half_space(one.at("point").point(), direction(one.at("normal")));

    std::vector<ShapePtr> shapes;
    for (const Node& inner : one.children) shapes.push_back(read_shape(inner));
    if (shapes.empty()) fail(one, "an empty list of shapes");
    if (kind == "union") return make_union(shapes);
    if (kind == "intersection") return make_intersection(shapes);
    if (shapes.size() < 2) fail(one, "a difference takes at least two shapes: the first, and what is cut out of it");
    return make_difference(shapes.front(), {shapes.begin() + 1, shapes.end()});
}

class Translator {
public:
    Translator(Node& root, const std::string& file) : root_(root), folder_(fs::path(file).parent_path().string()) {}

    Case translate() {
        Case result;
        result.title = root_.at("title").text;
        run(result);
        materials();
        for (const Node& name : root_.at("parts").children) {
            Node& node = *root_.child("part")->child(name.text);
            node.read = true;
            result.parts.push_back(part(node));
        }
        if (const Node* node = root_.find("slice")) result.slice = slice(*node, result);
        for (const Node& node : root_.at("detonation").children) result.detonations.push_back(detonation(node, result));
        for (const Node& node : root_.at("boundary").children) boundary(node, result);
        contact(root_.at("contact"), result);
        gauges(result);
        if (const Node* node = root_.find("analysis")) analysis(*node, result);
        root_.at("output");
        output(*root_.child("output"), result);
        step(root_.at("step"), result);
        return result;
    }

private:
    void run(Case& result) const {
        const Node& node = root_.at("run");
        result.until = node.at("until").number;
        result.seed = static_cast<std::uint64_t>(node.at("seed").integer);
        result.precision = which<Precision>(node.at("precision"), {{"double", Precision::double_}, {"single", Precision::single}});
    }

    // Materials

    void materials() const {
        if (const Node* all = root_.find("material"))
            for (const Node& node : all->children) {
                node.read = true;
                if (!is_name(node.key)) fail(node, "the name of a material consists of letters, digits, '_' and '-'");
                variant(node, {});
            }
    }

    MaterialData variant(const Node& node, std::vector<std::string> chain) const {
        const bool cycle = std::find(chain.begin(), chain.end(), node.key) != chain.end();
        chain.push_back(node.key);
        if (cycle) fail(node, "materials are based on each other in a circle: " + joined(chain, " -> "));
        const Node* base = node.find("base");
        if (!base) return read_material_variant(node, nullptr);
        // A variant may bear the name of what it varies: then the base is the one in the library.
        const MaterialData data = base->text == node.key ? from_library(*base) : material(*base, chain);
        return read_material_variant(node, &data);
    }

    MaterialData from_library(const Node& name) const {
        const std::string file = find_material(name.text, folder_);
        if (!file.empty()) return read_material(file);
        std::vector<std::string> names = list_materials();
        if (const Node* all = root_.find("material"))
            for (const std::string& own : all->names()) names.push_back(own);
        fail(name, "no material '" + name.text + "'" + did_you_mean(name.text, names) + "; there are: " + joined(names));
    }

    MaterialData material(const Node& name, const std::vector<std::string>& chain) const {
        if (const Node* all = root_.find("material"))
            if (const Node* own = all->find(name.text)) return variant(*own, chain);
        return from_library(name);
    }

    // Parts

    PartData part(Node& node) const {
        PartData data;
        data.name = node.key;
        data.where = origin(node);
        data.material = material(node.at("material"), {});
        data.shape = read_shape(node.at("shape"));
        data.formulation = which<Formulation>(node.at("formulation"), {{"total_lagrangian", Formulation::total_lagrangian}, {"updated_lagrangian", Formulation::updated_lagrangian}});
        data.arrangement = which<Arrangement>(node.at("arrangement"), {{"relaxed", Arrangement::relaxed}, {"lattice", Arrangement::lattice}});
        data.angle = node.at("angle").number;
        if (const Node* seed = node.find("seed")) data.seed = static_cast<std::uint64_t>(seed->integer);
        spacing(node, data);
        data.z_phase = node.at("z_phase").flag;
        data.smoothing = node.at("smoothing").number;
        data.velocity = node.at("velocity").point();
        if (const Node* fields = node.find("initial")) initial(*fields, data);
        data.viscosity = viscosity(node.at("viscosity"));
        by_formulation(node, data);
        return data;
    }

    static void spacing(Node& node, PartData& data) {
        const Node& finest = node.at("spacing");
        const std::string text = to_toml(finest);
        data.spacing = finest.number;
        if (!node.has("spacing_z")) supply(node, "spacing_z", text, "as spacing");
        if (!node.has("spacing_far")) supply(node, "spacing_far", text, "as spacing");
        data.spacing_far = value(node, "spacing_far", dimension::length);
        data.spacing_z = value(node, "spacing_z", dimension::length);
        if (data.spacing_far < data.spacing) fail(node.at("spacing_far"), "spacing_far has to be at least as large as spacing = " + text);
        if (data.spacing_far == data.spacing) {
            // A preset may make uniform what the case grades: the keys of the grading then rest.
            node.find("grading_radius");
            node.find("grading_growth");
            return;
        }
        const std::string because = "a spacing_far above spacing";
        data.grading_radius = need(node, "grading_radius", because).number;
        data.grading_growth = need(node, "grading_growth", because).number;
    }

    /// A quantity, which may have been supplied after the check that converts quantities.
    static double value(const Node& node, const char* key, Dimension dimension) { return parse_quantity(node.at(key).text, dimension); }

    static Formula formula(const Node& node, Dimension wanted) {
        try {
            return Formula(node.text, wanted);
        } catch (const std::invalid_argument& error) {
            fail(node, error.what());
        }
    }

    static void initial(const Node& node, PartData& data) {
        if (const Node* velocity = node.find("velocity"))
            for (const Node& component : velocity->children) data.velocity_field.push_back(formula(component, dimension::velocity));
        if (data.formulation == Formulation::total_lagrangian) return;  // the other keys stay unread, which is an error
        if (const Node* density = node.find("density")) data.density_field = formula(*density, dimension::density);
        if (const Node* energy = node.find("energy")) data.energy_field = formula(*energy, dimension::specific_energy);
    }

    static ViscosityData viscosity(const Node& node) {
        ViscosityData data;
        data.pairwise = node.has("pairwise");
        if (data.pairwise) {
            data.alpha = node.at("pairwise").at("alpha").number;
            data.beta = node.at("pairwise").at("beta").number;
        }
        if (node.has("bulk")) {
            data.linear = node.at("bulk").at("linear").number;
            data.quadratic = node.at("bulk").at("quadratic").number;
        }
        return data;
    }

    /// What only one of the formulations has. The other one leaves the key unread, which is an error.
    static void by_formulation(Node& node, PartData& data) {
        if (data.formulation == Formulation::total_lagrangian) {
            if (!node.has("zero_energy")) supply(node, "zero_energy", "0.05", "total_lagrangian");
            data.zero_energy = node.at("zero_energy").number;
            if (!node.has("failure")) supply(node, "failure", "{mode = \"jh2\"}", "total_lagrangian");
            data.failure = failure(node.at("failure"));
            if (const Node* field = node.find("heterogeneity"))
                data.heterogeneity = {field->at("weibull_modulus").number, field->at("correlation_length").number, static_cast<std::uint64_t>(field->at("seed").integer)};
            return;
        }
        if (!node.has("artificial_stress")) supply(node, "artificial_stress", "false", "off");
        const Node& stress = node.at("artificial_stress");
        data.artificial_stress = stress.is_table();
        if (!data.artificial_stress) return;
        data.artificial_stress_epsilon = stress.at("epsilon").number;
        data.artificial_stress_n = stress.at("n").number;
    }

    static FailureData failure(const Node& node) {
        FailureData data;
        data.mode = which<OnFailure>(node.at("mode"), {{"jh2", OnFailure::jh2}, {"no_tension_no_shear", OnFailure::no_tension_no_shear}, {"all_zero", OnFailure::all_zero}});
        if (const Node* strength = node.find("tensile_strength")) data.tensile_strength = strength->number;
        if (const Node* strength = node.find("shear_strength")) data.shear_strength = strength->number;
        if (const Node* energy = node.find("fracture_energy")) {
            if (!data.tensile_strength) fail(*energy, "a fracture energy needs the stress at which cracks begin: `tensile_strength` beside it");
            if (data.mode != OnFailure::jh2) fail(*energy, "goes with mode = \"jh2\" only: a crack that opens sets its stresses itself");
            data.fracture_energy = energy->number;
            data.fracture_energy_where = origin(*energy);
        }
        return data;
    }

    /// The part of this name that takes part in the run.
    const PartData& part_named(const Node& name, const Case& result) const {
        std::vector<std::string> names;
        for (const PartData& part : result.parts) {
            if (part.name == name.text) return part;
            names.push_back(part.name);
        }
        const bool left_out = root_.at("part").has(name.text);
        fail(name, (left_out ? "the part '" + name.text + "' is defined, but `parts` does not list it" : "no part '" + name.text + "'" + did_you_mean(name.text, names)) +
                       "; parts of the run: " + joined(names));
    }

    static void inside_heights(const Node& z, const PartData& part) {
        const Box box = part.shape->bounds();
        if (z.number < box.min.z || z.number > box.max.z)
            fail(z, "outside the part '" + part.name + "', which reaches from z = " + shortest(box.min.z) + " mm to " + shortest(box.max.z) + " mm");
    }

    SliceData slice(const Node& node, const Case& result) const {
        const PartData& reference = part_named(node.at("part"), result);
        inside_heights(node.at("z"), reference);
        return {node.at("z").number, static_cast<int>(node.at("layers").integer), reference.name};
    }

    // What acts on the parts

    DetonationData detonation(const Node& node, const Case& result) const {
        const PartData& charge = part_named(node.at("part"), result);
        if (!charge.material.burn) {
            std::vector<std::string> explosive;
            for (const PartData& part : result.parts)
                if (part.material.burn) explosive.push_back(part.name);
            fail(node.at("part"), "its material '" + charge.material.name + "' has no burn law, so it can not detonate; parts that can: " + joined(explosive));
        }
        DetonationData data;
        data.part = charge.name;
        data.kind = which<DetonationKind>(node.at("kind"), {{"point", DetonationKind::point}, {"line", DetonationKind::line}, {"instant", DetonationKind::instant}});
        data.time = node.at("time").number;
        if (data.kind == DetonationKind::point) {
            data.from = data.to = need(node, "at", "kind = \"point\"").point();
        } else if (data.kind == DetonationKind::line) {
            data.from = need(node, "from", "kind = \"line\"").point();
            data.to = need(node, "to", "kind = \"line\"").point();
            if (same(data.from, data.to)) fail(node.at("to"), "the two ends of the line are the same point; use kind = \"point\"");
        }
        return data;
    }

    void boundary(const Node& node, Case& result) const {
        const Node& name = node.at("part");
        BoundaryData data;
        data.part = name.text;
        data.kind = which<BoundaryKind>(node.at("kind"), {{"fix", BoundaryKind::fix}, {"platen", BoundaryKind::platen}, {"pressure", BoundaryKind::pressure}, {"mirror", BoundaryKind::mirror}});
        const std::string because = "kind = " + to_toml(node.at("kind"));
        if (data.kind == BoundaryKind::pressure) {
            data.on = read_shape(need(node, "on", because));
            data.where = node.at("on").where;
            data.times = ascending(need(node, "times", because), true);
            data.values = need(node, "values", because).numbers();
            if (data.times.empty() || data.times.size() != data.values.size())
                fail(node.at("values"), "as many values as times are needed, and at least one: there are " + std::to_string(data.values.size()) + " values and " + std::to_string(data.times.size()) + " times");
        } else if (data.kind == BoundaryKind::fix && node.has("on")) {
            data.on = read_shape(node.at("on"));
        } else {
            data.point = need(node, "point", because).point();
            data.normal = direction(need(node, "normal", because));
        }
        if (data.kind == BoundaryKind::mirror && std::max({std::abs(data.normal.x), std::abs(data.normal.y), std::abs(data.normal.z)}) < 1 - 1e-9)
            fail(node.at("normal"), "a mirror stands across an axis: one of [1, 0, 0], [0, 1, 0], [0, 0, 1], or their opposites");
        if (data.kind == BoundaryKind::fix) {
            const std::vector<std::string> fixed = need(node, "fix", because).texts();
            if (fixed.empty()) fail(node.at("fix"), "nothing is fixed; allowed: a list of \"x\", \"y\", \"z\"");
            const auto has = [&](const char* axis) { return std::find(fixed.begin(), fixed.end(), axis) != fixed.end(); };
            data.fix_x = has("x");
            data.fix_y = has("y");
            data.fix_z = has("z");
        }
        const bool stays_out = data.part != "*" && root_.at("part").has(data.part) &&
                               std::none_of(result.parts.begin(), result.parts.end(), [&](const PartData& part) { return part.name == data.part; });
        if (stays_out) return;
        if (data.part != "*" && data.kind == BoundaryKind::mirror && part_named(name, result).formulation == Formulation::total_lagrangian)
            fail(name, "mirrors are for updated_lagrangian parts; of a solid, fix the component across the plane");
        if (data.part != "*") part_named(name, result);
        result.boundaries.push_back(std::move(data));
    }

    static std::vector<double> ascending(const Node& list, bool strictly) {
        for (std::size_t i = 1; i < list.children.size(); ++i) {
            const double step = list.children[i].number - list.children[i - 1].number;
            if (step < 0 || (strictly && step == 0)) fail(list, "the values have to ascend; " + to_toml(list.children[i]) + " follows " + to_toml(list.children[i - 1]));
        }
        return list.numbers();
    }

    void contact(const Node& node, Case& result) const {
        const Node& pairs = node.at("pairs");
        result.contact.all = pairs.is_text();
        for (const Node& pair : pairs.children) {
            const std::string first = part_named(pair.children[0], result).name, second = part_named(pair.children[1], result).name;
            if (first == second) fail(pair, "a pair takes two different parts");
            result.contact.pairs.emplace_back(first, second);
        }
        result.contact.stiffness = node.at("stiffness").number;
        result.contact.damping = node.at("damping").number;
        result.contact.friction = node.at("friction").number;
    }

    // What is looked at

    /// A name that is also the name of a file.
    static const std::string& file_name(const Node& node) {
        const std::string& name = node.text;
        const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' || c == ' '; };
        if (name.empty() || name.front() == '.' || !std::all_of(name.begin(), name.end(), plain))
            fail(node, "it names a file too; allowed: letters, digits, spaces, _, - and ., not first a point");
        return name;
    }

    void gauges(Case& result) const {
        std::set<std::string> names;
        for (const Node& node : root_.at("gauge").children) {
            const PartData& part = part_named(node.at("part"), result);
            if (part.formulation != Formulation::total_lagrangian)
                fail(node.at("part"), "gauges move with a solid; the part '" + part.name + "' is updated_lagrangian (its fields are in the snapshots)");
            const Node& at = node.at("at");
            const double outside = part.shape->distance(at.point());
            if (outside > part.spacing_far)
                fail(at, "the gauge lies outside the part '" + part.name + "', by " + shortest(std::round(outside * 1000) / 1000) + " mm");
            if (!names.insert(file_name(node.at("name"))).second) fail(node.at("name"), "two gauges have the same name");
            result.gauges.push_back({node.at("name").text, part.name, at.point()});
        }
    }

    void analysis(const Node& node, Case& result) const {
        const PartData& part = part_named(node.at("part"), result);
        AnalysisData& data = result.analysis;
        data.part = part.name;
        data.damage_threshold = node.at("damage_threshold").number;
        data.zone_radii = ascending(node.at("zones"), true);
        if (data.zone_radii.size() < 2) fail(node.at("zones"), "at least two radii are needed to bound a zone");
        data.sectors = static_cast<int>(node.at("sectors").integer);
        const std::vector<double> axis = node.at("axis").numbers();
        data.axis = {axis[0], axis[1], 0};
        std::set<std::string> names;
        for (const Node& section : node.at("sections").children) {
            inside_heights(section.at("z"), part);
            if (!names.insert(file_name(section.at("name"))).second) fail(section.at("name"), "two sections have the same name");
            data.sections.push_back({section.at("name").text, section.at("z").number});
        }
        data.tensile_strength = node.at("tensile_strength").number;
        data.shear_strength = node.at("shear_strength").number;
    }

    static void output(Node& node, Case& result) {
        std::vector<double>& times = result.output.snapshot_times;
        const double last = result.until * (1 + 1e-9);
        const Node& snapshots = node.at("snapshots");
        if (snapshots.is_list()) {
            for (const double time : ascending(snapshots, true))
                if (time <= last) times.push_back(time);
        } else {
            const double interval = snapshots.number;
            if (interval <= 0) fail(snapshots, "the interval has to be > 0");
            if (result.until / interval > 1e6) fail(snapshots, "this makes more than a million snapshots until " + shortest(result.until) + " us");
            for (int i = 0; i * interval <= last; ++i) times.push_back(i * interval);
        }
        if (!node.has("history")) supply(node, "history", in_quotes(shortest(result.until / 1000) + " us"), "until / 1000");
        result.output.history_interval = value(node, "history", dimension::time);
        result.output.checkpoint_interval = node.at("checkpoint").number;
    }

    static void step(const Node& node, Case& result) {
        result.step.courant_solid = node.at("courant_solid").number;
        result.step.courant_fluid = node.at("courant_fluid").number;
        result.step.growth = node.at("growth").number;
        result.step.minimum = node.at("minimum").number;
        result.step.energy_residual_limit = node.at("energy_residual_limit").number;
        result.step.velocity_limit = node.at("velocity_limit").number;
        result.step.torn_limit = node.at("torn_limit").number;
        result.step.leak_limit = node.at("leak_limit").number;
    }

    Node& root_;
    std::string folder_;
};

// --- the record ------------------------------------------------------------------------------------------------------------

/// "T = {value = ..., source = "...", confidence = "..."}   # where it was read".
std::string line_of(const std::string& name, const ParameterValue& value) {
    const std::string text = value.text.find_first_not_of("+-.0123456789eE_") == std::string::npos ? value.text : in_quotes(value.text);
    return name + " = {value = " + text + ", source = " + in_quotes(value.source) + ", confidence = " + in_quotes(value.confidence) + "}  # " + one_line(value.where) + "\n";
}

std::string table_of(const std::string& name, const LawData& law) {
    std::string out = "\n[" + name + "]\nlaw = " + in_quotes(law.law) + "  # " + one_line(law.where) + "\n";
    for (const auto& [parameter, value] : law.parameters) out += line_of(parameter, value);
    return out;
}

/// The materials that the parts use, each constant with its value, its source and the place where it was read: the resolved case needs no
/// library, and means the same when the library changes.
std::string materials_of(const Case& result) {
    std::string out;
    std::set<std::string> done;
    for (const PartData& part : result.parts) {
        const MaterialData& m = part.material;
        if (!done.insert(m.name).second) continue;
        const std::string name = "material." + m.name;
        out += "\n[" + name + "]  # " + one_line(m.file) + "\ntitle = " + in_quotes(m.title) + "\nsource = " + in_quotes(m.source) + "\nnotes = [";
        for (const std::string& note : m.notes) out += (&note == &m.notes.front() ? "" : ", ") + in_quotes(note);
        out += "]\n" + line_of("density", m.density);
        out += table_of(name + ".eos", m.eos);
        if (m.strength) out += table_of(name + ".strength", *m.strength);
        if (m.burn) out += table_of(name + ".burn", *m.burn);
    }
    return out;
}

/// Parts refer to their materials by name; in the record a name has to mean one material.
void name_materials(Node& root, const Case& result) {
    std::map<std::string, std::string> files;
    for (const PartData& part : result.parts) {
        Node& material = *root.child("part")->child(part.name)->child("material");
        const auto [known, is_new] = files.emplace(part.material.name, part.material.file);
        if (!is_new && known->second != part.material.file)
            fail(material, "two materials of the run are named '" + part.material.name + "': " + known->second + " and " + part.material.file + "; rename one");
        material.text = part.material.name;
    }
    remove(root, "material");
}

}  // namespace

Case read_case(const std::string& file, const std::string& preset, const std::vector<std::string>& settings) {
    Node root = gather(file, preset, settings);
    check_parts(root);
    complete(root, case_schema().groups.front(), case_schema());

    Case result = Translator(root, file).translate();
    result.file = file;
    result.preset = preset;
    result.settings = settings;

    // Parts that stay out, and the boundaries bound to them, have been checked and go.
    const auto stays_out = [&](const std::string& part) {
        return std::none_of(result.parts.begin(), result.parts.end(), [&](const PartData& used) { return used.name == part; });
    };
    std::erase_if(root.child("part")->children, [&](const Node& part) { return stays_out(part.key); });
    std::erase_if(root.child("boundary")->children, [&](const Node& boundary) {
        const std::string part = boundary.at("part").text;
        return part != "*" && stays_out(part);
    });
    if (const Node* unread = first_unread(root))
        fail(*unread, "the key '" + unread->key + "' has no effect here, given the other keys of this table; take it out");

    name_materials(root, result);
    result.resolved = "# The case " + file + " as it was read, every value with its origin.\n";
    if (!preset.empty()) result.resolved += "# preset: " + preset + "\n";
    for (const std::string& setting : settings) result.resolved += "# --set " + one_line(setting) + "\n";
    result.resolved += "\n" + resolved(root, case_schema()) + materials_of(result);
    return result;
}

}  // namespace brisance
