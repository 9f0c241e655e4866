// SPDX-License-Identifier: Apache-2.0
// Reads material files. A file names its laws and gives parameters with value, source and confidence; which parameters a law has,
// and in which dimension and range, is the law's business and checked there.
#include "base/error.h"
#include "base/text.h"
#include "io/case_file.h"
#include "io/config.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <stdexcept>

namespace brisance {

using namespace config;
namespace fs = std::filesystem;

namespace {

enum class Writer { library, user };

const Schema& material_schema() {
    static const Schema schema{{
        {.name = "material", .heading = "a material file", .meaning = "", .keys = {
            {.name = "name", .type = Type::text, .meaning = "the name of the file without .toml"},
            {.name = "title", .type = Type::text, .meaning = "one line for reports"},
            {.name = "source", .type = Type::text, .meaning = "where the set comes from, in one sentence"},
            {.name = "notes", .type = Type::text, .meaning = "remarks", .fallback = "[]", .count = Count::list},
            {.name = "density", .type = Type::material, .meaning = "density"},
            {.name = "eos", .type = Type::material, .meaning = "equation of state: `law` and its parameters"},
            {.name = "strength", .type = Type::material, .meaning = "strength law and its parameters", .absent = "a fluid"},
            {.name = "burn", .type = Type::material, .meaning = "burn law and its parameters", .absent = "no explosive"},
        }},
    }};
    return schema;
}

std::string required_text(const Node& table, const std::string& key, const std::string& meaning) {
    const Node* node = table.find(key);
    if (!node) fail(table, "the key '" + key + "' is missing: " + meaning);
    if (!node->is_text() || trimmed(node->text).empty()) fail(*node, "this has to be a text in quotes, not empty: " + meaning);
    return node->text;
}

/// Codes joined by commas: where a number comes from and how far it can be trusted (docs/materials.md).
void check_confidence(const Node& node) {
    static const std::regex code(R"(S|c|b-[HML](/[HML])?|a:[A-Za-z0-9_-]+(\[[^\]]*\])?)");
    std::string rest = node.text;
    for (std::size_t comma = 0; comma != std::string::npos;) {
        comma = rest.find(',');
        if (!std::regex_match(trimmed(rest.substr(0, comma)), code))
            fail(node, "not a confidence; allowed: S | a:KEY | b-H | b-M | b-L | b-H/M | c, or several of these with commas between");
        if (comma != std::string::npos) rest = rest.substr(comma + 1);
    }
}

ParameterValue read_value(const Node& node) {
    ParameterValue parameter;
    if (node.is_number()) {
        parameter.value = node.number;
        parameter.text = to_toml(node);
    } else if (node.is_text()) {
        try {
            const Quantity quantity = read_quantity(node.text);
            if (quantity.unit.empty()) fail(node, "a number without unit is written without quotes; with a unit like \"16 GPa\"");
            parameter.value = quantity.value;
            parameter.dimension = quantity.dimension;
            parameter.text = node.text;
        } catch (const std::invalid_argument& error) {
            fail(node, error.what());
        }
    } else {
        fail(node, "this has to be a number, or a quantity with its unit such as \"16 GPa\"");
    }
    return parameter;
}

ParameterValue read_parameter(const Node& node, Writer writer) {
    static const std::vector<std::string> keys{"value", "source", "confidence"};
    if (!node.is_table()) {
        if (writer == Writer::library) fail(node, "a parameter in a library file has the form {value = ..., source = \"...\", confidence = \"...\"}");
        ParameterValue parameter = read_value(node);
        parameter.source = "case file";
        parameter.confidence = "user";
        parameter.where = origin(node);
        return parameter;
    }
    for (const Node& child : node.children)
        if (std::find(keys.begin(), keys.end(), child.key) == keys.end())
            fail(child, "unknown key '" + child.key + "'" + did_you_mean(child.key, keys) + "; allowed in a parameter: " + joined(keys));
    const Node* value = node.find("value");
    if (!value) fail(node, "the key 'value' is missing");
    ParameterValue parameter = read_value(*value);
    const bool must = writer == Writer::library;
    parameter.source = must || node.has("source") ? required_text(node, "source", "where the value comes from") : "case file";
    parameter.confidence = "user";
    if (must || node.has("confidence")) {
        parameter.confidence = required_text(node, "confidence", "S | a:KEY | b-H | b-M | b-L | c");
        if (must || parameter.confidence != "user") check_confidence(node.at("confidence"));
    }
    parameter.where = origin(node);
    return parameter;
}

/// `base`: the law that is varied, or null.
LawData read_law(const Node& node, Writer writer, const LawData* base) {
    if (!node.is_table()) fail(node, "this has to be a table with `law` and its parameters");
    LawData law;
    if (base && (!node.has("law") || node.at("law").text == base->law)) law = *base;
    if (!base || node.has("law")) {
        law.law = required_text(node, "law", "the name of the law");
        law.where = origin(node.at("law"));
    }
    for (const Node& child : node.children) {
        if (child.key == "law") continue;
        ParameterValue parameter = read_parameter(child, writer);
        const auto old = law.parameters.find(child.key);
        if (old != law.parameters.end() && !(old->second.dimension == parameter.dimension))
            fail(child, "the base gives " + old->second.text + ", a " + dimension_name(old->second.dimension) + "; this is a " + dimension_name(parameter.dimension));
        law.parameters[child.key] = std::move(parameter);
    }
    return law;
}

ParameterValue read_density(const Node& node, Writer writer) {
    ParameterValue density = read_parameter(node, writer);
    if (!(density.dimension == dimension::density))
        fail(node, (density.dimension == dimension::none ? "a bare number for a density" : "a " + dimension_name(density.dimension) + " where a density belongs") +
                       std::string("; write for example \"") + dimension_example(dimension::density) + "\"");
    if (density.value <= 0) fail(node, "a density has to be > 0");
    return density;
}

void read_laws(MaterialData& material, const Node& node, Writer writer, const MaterialData* base) {
    if (const Node* density = node.find("density")) material.density = read_density(*density, writer);
    const auto law = [&](const char* key, const LawData* varied) { return read_law(node.at(key), writer, varied); };
    const auto base_of = [](const std::optional<LawData>& data) { return data ? &*data : nullptr; };
    if (node.has("eos")) material.eos = law("eos", base ? &base->eos : nullptr);
    if (node.has("strength")) material.strength = law("strength", base ? base_of(base->strength) : nullptr);
    if (node.has("burn")) material.burn = law("burn", base ? base_of(base->burn) : nullptr);
}

fs::path library() {
    if (const char* folder = std::getenv("BRISANCE_MATERIALS"); folder && *folder) return folder;
    return fs::path(BRISANCE_SOURCE_DIR) / "materials";
}

bool is_path(const std::string& name) { return name.ends_with(".toml") || name.find('/') != std::string::npos; }

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

}  // namespace

std::string find_material(const std::string& name_or_file, const std::string& beside) {
    std::vector<fs::path> candidates;
    if (is_path(name_or_file)) {
        candidates = {fs::path(beside) / name_or_file, fs::path(name_or_file)};
    } else {
        candidates = {library() / (name_or_file + ".toml"), fs::path(beside) / (name_or_file + ".toml")};
    }
    for (const fs::path& candidate : candidates)
        if (is_file(candidate)) return candidate.lexically_normal().string();
    return {};
}

std::vector<std::string> list_materials() {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(library(), error))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

MaterialData read_material(const std::string& name_or_file) {
    const std::string file = find_material(name_or_file, "");
    if (file.empty()) {
        const std::vector<std::string> names = list_materials();
        throw InputError("no material '" + name_or_file + "' in " + library().string() + did_you_mean(name_or_file, names) + "; there are: " + joined(names));
    }
    Node root = parse_file(file);
    set_paths(root);
    complete(root, material_schema().groups.front(), material_schema());
    MaterialData material;
    material.file = file;
    material.name = required_text(root, "name", "the name of the file without .toml");
    material.title = required_text(root, "title", "one line for reports");
    material.source = required_text(root, "source", "where the set comes from");
    material.notes = root.at("notes").texts();
    if (material.name != fs::path(file).stem().string())
        fail(root.at("name"), "the name has to be that of the file: " + in_quotes(fs::path(file).stem().string()));
    read_laws(material, root, Writer::library, nullptr);
    return material;
}

MaterialData read_material_variant(const Node& variant, const MaterialData* base) {
    MaterialData material;
    if (base) material = *base;
    material.name = variant.key;
    material.file = origin(variant);
    if (const Node* title = variant.find("title")) material.title = title->text;
    if (material.title.empty()) material.title = variant.key;
    if (const Node* source = variant.find("source"))
        material.source = source->text;
    else
        material.source = base ? "case file, varied from " + base->name + ": " + base->source : "case file";
    if (const Node* notes = variant.find("notes")) material.notes = notes->texts();
    if (!base)
        for (const char* key : {"density", "eos"})
            if (!variant.has(key)) fail(variant, "the key '" + std::string(key) + "' is missing; a material without `base` has to be complete");
    read_laws(material, variant, Writer::user, base);
    mark_all_read(variant);
    return material;
}

}  // namespace brisance
