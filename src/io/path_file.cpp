// SPDX-License-Identifier: Apache-2.0
// A path for a material point, as TOML: `rate`, `steps`, `scale`, and one [[leg]] after the other.
#include "io/path_file.h"

#include "base/error.h"
#include "base/text.h"
#include "io/config.h"

#include <filesystem>

namespace brisance {

using namespace config;

namespace {

const char* const no_other = "another kind of leg";

const Schema& path_schema() {
    static const Range stretch{-0.95, 100, false}, volume{0.05, 1e4, false}, steps{1, 1e7, false};
    static const std::vector<Key> of_a_step = {
        {.name = "rate", .type = Type::quantity, .meaning = "rate of the largest strain component", .absent = "that of the file", .dimension = dimension::rate, .range = positive},
        {.name = "steps", .type = Type::integer, .meaning = "equal steps of the leg", .absent = "those of the file", .range = steps},
    };
    static const Schema schema = [] {
        Group root{.name = "path", .heading = "a path file", .meaning = "", .keys = {
            {.name = "title", .type = Type::text, .meaning = "a name for tables and figures", .absent = "the name of the file"},
            {.name = "rate", .type = Type::quantity, .meaning = "rate of the largest strain component", .fallback = "\"1000 1/s\"", .dimension = dimension::rate, .range = positive},
            {.name = "steps", .type = Type::integer, .meaning = "equal steps of each leg", .fallback = "1000", .range = steps},
            {.name = "scale", .type = Type::number, .meaning = "strength scale of the place", .fallback = "1", .range = positive},
            {.name = "damage", .type = Type::number, .meaning = "damage at the start", .fallback = "0", .range = fraction},
            {.name = "leg", .type = Type::tables, .meaning = "where the point goes, one leg after the other", .group = "leg"},
        }};
        Group leg{.name = "leg", .heading = "[[leg]]", .meaning = "exactly one of the kinds", .keys = {
            {.name = "strain", .type = Type::number, .meaning = "engineering strains x, y, z at the end", .absent = no_other, .range = stretch, .count = Count::three},
            {.name = "shear", .type = Type::number, .meaning = "simple shear gamma in the plane xy at the end; alone or with `strain`", .absent = "as it was", .range = {-100, 100, false}},
            {.name = "axial", .type = Type::number, .meaning = "engineering strain z at the end, sides under the pressure `lateral`", .absent = no_other, .range = stretch},
            {.name = "lateral", .type = Type::quantity, .meaning = "pressure on the sides of an `axial` leg", .absent = "0", .dimension = dimension::pressure},
            {.name = "pressure", .type = Type::quantity, .meaning = "equal strains until this pressure", .absent = no_other, .dimension = dimension::pressure},
            {.name = "particle_velocity", .type = Type::quantity, .meaning = "along the Hugoniot to this particle velocity", .absent = no_other, .dimension = dimension::velocity, .range = positive},
            {.name = "volume", .type = Type::number, .meaning = "V/V_0 at the end, equal strains, adiabatic", .absent = no_other, .range = volume},
            {.name = "cj", .type = Type::flag, .meaning = "the Chapman-Jouguet state of an explosive; first leg only", .absent = no_other},
        }};
        leg.keys.insert(leg.keys.end(), of_a_step.begin(), of_a_step.end());
        return Schema{{root, leg}};
    }();
    return schema;
}

PathLeg read_leg(const Node& node, const PathLeg& before, const PointPath& path) {
    using Kind = PathLeg::Kind;
    static const std::vector<std::string> kinds{"strain", "axial", "pressure", "particle_velocity", "volume", "cj"};
    std::vector<std::string> given;
    for (const std::string& kind : kinds)
        if (node.has(kind)) given.push_back(kind);
    if (given.empty() && node.has("shear")) given.emplace_back("shear");
    if (given.size() != 1)
        fail(node, (given.empty() ? std::string("no kind") : "several kinds (" + joined(given) + ")") + "; a leg has exactly one of: " + joined(kinds) + ", shear");
    const std::string& kind = given.front();
    if (node.has("shear") && kind != "strain" && kind != "shear") fail(*node.find("shear"), "a shear goes with `strain`, or alone");
    if (node.has("lateral") && kind != "axial") fail(*node.find("lateral"), "only an `axial` leg has pressed sides");
    PathLeg leg = before;  // rate and steps of the file
    if (const Node* rate = node.find("rate")) leg.rate = rate->number;
    if (const Node* steps = node.find("steps")) leg.steps = static_cast<int>(steps->integer);
    if (kind == "strain" || kind == "shear") {
        leg.kind = Kind::strain;
        if (const Node* strain = node.find("strain")) leg.strain = strain->point();
        if (const Node* shear = node.find("shear")) leg.shear = shear->number;
        if (kind == "shear" && !path.legs.empty()) {
            if (path.legs.back().kind != Kind::strain) fail(node, "a shear alone follows a leg of `strain` or `shear`: give the strains too");
            leg.strain = path.legs.back().strain;
        }
        if (!node.has("shear"))
            for (const PathLeg& l : path.legs)
                if (l.kind == Kind::strain) leg.shear = l.shear;
    } else if (kind == "axial") {
        leg.kind = Kind::axial;
        leg.strain.z = node.find("axial")->number;
        if (const Node* lateral = node.find("lateral")) leg.lateral = lateral->number;
    } else if (kind == "pressure") {
        leg.kind = Kind::pressure;
        leg.target = node.find("pressure")->number;
    } else if (kind == "particle_velocity") {
        leg.kind = Kind::shock;
        leg.target = node.find("particle_velocity")->number;
        if (!path.legs.empty()) fail(*node.find("particle_velocity"), "a shock starts from the state at rest: it has to be the first leg");
    } else if (kind == "volume") {
        leg.kind = Kind::volume;
        leg.target = node.find("volume")->number;
    } else {
        leg.kind = Kind::cj;
        if (!node.find("cj")->flag) fail(*node.find("cj"), "has to be true where it is given");
        if (!path.legs.empty()) fail(*node.find("cj"), "the Chapman-Jouguet state follows from the state at rest: it has to be the first leg");
    }
    return leg;
}

}  // namespace

PointPath read_path(const std::string& file) {
    Node root = parse_file(file);
    set_paths(root);
    complete(root, path_schema().groups.front(), path_schema());
    PointPath path;
    const Node* title = root.find("title");
    path.name = title ? title->text : std::filesystem::path(file).stem().string();
    path.scale = root.at("scale").number;
    path.damage = root.at("damage").number;
    PathLeg plain;
    plain.rate = root.at("rate").number;
    plain.steps = static_cast<int>(root.at("steps").integer);
    if (root.at("leg").children.empty()) fail(root.at("leg"), "a path needs one leg or more");
    for (const Node& node : root.at("leg").children) path.legs.push_back(read_leg(node, plain, path));
    return path;
}

}  // namespace brisance
