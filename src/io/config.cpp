// SPDX-License-Identifier: Apache-2.0
#include "io/config.h"

#include "base/error.h"
#include "base/text.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace brisance::config {

// --- the tree --------------------------------------------------------------------------------------------------------------

const Node* Node::find(std::string_view name) const {
    for (const Node& child : children)
        if (child.key == name) {
            child.read = true;
            return &child;
        }
    return nullptr;
}

const Node& Node::at(std::string_view name) const {
    if (const Node* child = find(name)) return *child;
    throw std::logic_error(path + ": the key '" + std::string(name) + "' is not in the table of keys");
}

bool Node::has(std::string_view name) const {
    return std::any_of(children.begin(), children.end(), [&](const Node& child) { return child.key == name; });
}

Node* Node::child(std::string_view name) {
    for (Node& child : children)
        if (child.key == name) return &child;
    return nullptr;
}

std::vector<std::string> Node::names() const {
    std::vector<std::string> all;
    for (const Node& child : children) all.push_back(child.key);
    return all;
}

std::vector<double> Node::numbers() const {
    std::vector<double> all;
    for (const Node& child : children) all.push_back(child.number);
    return all;
}

std::vector<std::string> Node::texts() const {
    std::vector<std::string> all;
    for (const Node& child : children) all.push_back(child.text);
    return all;
}

Vec3<double> Node::point() const { return {children.at(0).number, children.at(1).number, children.at(2).number}; }

// --- reading ---------------------------------------------------------------------------------------------------------------

namespace {

using Place = std::function<std::string(const toml::source_position&)>;

Node convert(const toml::node& value, const std::string& where, const Place& place) {
    Node node;
    node.where = where;
    if (const auto* table = value.as_table()) {
        node.kind = Node::Kind::table;
        std::vector<std::pair<toml::source_position, Node>> found;
        for (const auto& [key, child] : *table) {
            const toml::source_position position = key.source().begin;
            found.emplace_back(position, convert(child, place(position), place));
            found.back().second.key = std::string(key.str());
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto& [position, child] : found) node.children.push_back(std::move(child));
    } else if (const auto* list = value.as_array()) {
        node.kind = Node::Kind::list;
        for (const toml::node& child : *list) node.children.push_back(convert(child, place(child.source().begin), place));
    } else if (const auto* text = value.as_string()) {
        node.kind = Node::Kind::text;
        node.text = text->get();
    } else if (const auto* flag = value.as_boolean()) {
        node.kind = Node::Kind::flag;
        node.flag = flag->get();
    } else if (const auto* integer = value.as_integer()) {
        node.kind = Node::Kind::integer;
        node.integer = integer->get();
        node.number = static_cast<double>(node.integer);
    } else if (const auto* number = value.as_floating_point()) {
        node.kind = Node::Kind::number;
        node.number = number->get();
        if (!std::isfinite(node.number)) throw InputError(where + ": infinite numbers and nan are not allowed");
    } else {
        throw InputError(where + ": dates and times of day have no meaning here");
    }
    return node;
}

std::string line_of(const std::string& text, unsigned line) {
    std::istringstream lines(text);
    std::string found;
    for (unsigned i = 0; i < line; ++i)
        if (!std::getline(lines, found)) return {};
    return trimmed(found);
}

}  // namespace

Node parse_file(const std::string& path, const std::string& asked_at) {
    const std::string prefix = asked_at.empty() ? "" : asked_at + ": ";
    std::ifstream file(path, std::ios::binary);
    if (std::filesystem::is_directory(path)) throw InputError(prefix + path + ": is a folder, not a file");
    if (!file) throw InputError(prefix + path + ": no such file, or not readable");
    std::ostringstream content;
    content << file.rdbuf();
    const std::string text = content.str();
    const Place place = [&](const toml::source_position& at) {
        return path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
    };
    try {
        return convert(toml::parse(text), path + ":1:1", place);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        const std::string line = line_of(text, at.line);
        static const std::regex bare_quantity(R"(=\s*[-+0-9.eE]+\s*[A-Za-z%])");
        throw InputError(place(at) + ": not valid TOML: " + std::string(error.description()) +
                         (line.empty() ? "" : "; the line is: " + line) +
                         (std::regex_search(line, bare_quantity) ? "; a value with a unit is written in quotes: \"0.15 mm\"" : ""));
    }
}

Node parse_value(const std::string& value, const std::string& where) {
    const Place place = [&](const toml::source_position&) { return where; };
    const std::string text = trimmed(value);
    try {
        const toml::table table = toml::parse("value = " + text);
        const toml::node* only = table.get("value");
        // A date is a word to us, and a line break would smuggle in further keys.
        if (table.size() == 1 && !only->is_date() && !only->is_time() && !only->is_date_time()) return convert(*only, where, place);
    } catch (const toml::parse_error& error) {
        if (text.empty()) throw InputError(where + ": the value is missing");
        if (std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
            throw InputError(where + ": not a valid TOML value: " + std::string(error.description()));
    }
    Node word;
    word.kind = Node::Kind::text;
    word.where = where;
    word.text = text;
    return word;
}

void merge(Node& into, const Node& from, const std::function<bool(const std::string&)>& is_choice) {
    if (!into.is_table() || !from.is_table()) {
        const std::string key = into.key;
        into = Node(from);
        into.key = key;
        return;
    }
    const bool other_alternative = is_choice(into.key) && !from.children.empty() && !into.children.empty() &&
                                   from.children.front().key != into.children.front().key;
    if (other_alternative) into.children.clear();
    // The position of a table is where it is written in full: the first place that names it.
    for (const Node& child : from.children) {
        if (Node* same = into.child(child.key))
            merge(*same, child, is_choice);
        else
            into.children.push_back(child);
    }
}

void set_paths(Node& root) {
    for (std::size_t i = 0; i < root.children.size(); ++i) {
        Node& child = root.children[i];
        if (root.is_list())
            child.path = root.path + "[" + std::to_string(i) + "]";
        else
            child.path = root.path.empty() ? child.key : root.path + "." + child.key;
        set_paths(child);
    }
}

// --- messages --------------------------------------------------------------------------------------------------------------

std::string origin(const Node& node) { return node.via.empty() ? node.where : node.where + " (" + node.via + ")"; }

void fail(const Node& node, const std::string& problem) {
    std::string value;
    if (!node.is_table()) {
        value = to_toml(node);
        if (value.size() > 100) value = value.substr(0, 97) + "...";
        value = " = " + value;
    }
    const std::string path = node.path.empty() ? "" : node.path + value + ": ";
    throw InputError(origin(node) + ": " + path + problem);
}

std::string to_toml(const Node& node) {
    const auto each = [&](const char* open, const char* close) {
        std::string all = open;
        for (const Node& child : node.children) {
            if (all.size() > std::string_view(open).size()) all += ", ";
            if (node.is_table()) all += child.key + " = ";
            all += to_toml(child);
        }
        return all + close;
    };
    switch (node.kind) {
        case Node::Kind::flag: return node.flag ? "true" : "false";
        case Node::Kind::integer: return std::to_string(node.integer);
        case Node::Kind::number: {
            const std::string digits = shortest(node.number);
            return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
        }
        case Node::Kind::text: return in_quotes(node.text);
        case Node::Kind::list: return each("[", "]");
        case Node::Kind::table: return each("{", "}");
    }
    return {};
}

// --- the schema ------------------------------------------------------------------------------------------------------------

const Group& Schema::group(std::string_view name) const {
    for (const Group& group : groups)
        if (group.name == name) return group;
    throw std::logic_error("no group of keys named '" + std::string(name) + "'");
}

bool Schema::is_choice(const std::string& key) const {
    for (const Group& g : groups)
        for (const Key& k : g.keys)
            if (k.name == key && k.type == Type::table && group(k.group).choice) return true;
    return false;
}

namespace {

std::string in_words(const Range& range) {
    const bool has_min = std::isfinite(range.min), has_max = std::isfinite(range.max);
    std::string words;
    if (has_min) words = (range.open ? "> " : ">= ") + shortest(range.min);
    if (has_max) words += (has_min ? " and <= " : "<= ") + shortest(range.max);
    return words;
}

std::string one_value(const Key& key, const Schema& schema) {
    std::string words;
    switch (key.type) {
        case Type::text: words = "a text in quotes"; break;
        case Type::choice: {
            std::vector<std::string> all;
            for (const std::string& choice : key.choices) all.push_back(in_quotes(choice));
            words = joined(all, " | ");
            break;
        }
        case Type::flag: words = "true | false"; break;
        case Type::integer: words = "a whole number"; break;
        case Type::number: words = "a number without unit"; break;
        case Type::quantity: words = dimension_name(key.dimension) + " such as " + in_quotes(dimension_example(key.dimension)); break;
        case Type::angle: words = "angle such as \"22.5 deg\""; break;
        case Type::material: words = "as in a material file; a value may stand without source and confidence"; break;
        case Type::names: words = "\"all\" | [[\"rock\", \"copper\"], ...]"; break;
        case Type::table:
        case Type::tables:
        case Type::named: {
            const Group& group = schema.group(key.group);
            std::vector<std::string> inner;
            for (const Key& k : group.keys) inner.push_back(k.name);
            words = std::string(group.choice ? "a table with one of " : "a table with the keys ") + joined(inner);
            if (key.or_flag) words = "true | false | " + words;
            if (key.type == Type::tables) words = "a list of tables: [[" + key.name + "]]";
            if (key.type == Type::named) words = "a table for each name: [" + key.name + ".NAME]";
            break;
        }
    }
    const std::string range = in_words(key.range);
    return range.empty() ? words : words + ", " + range;
}

}  // namespace

std::string allowed(const Key& key, const Schema& schema) {
    const std::string one = one_value(key, schema);
    switch (key.count) {
        case Count::one: return one;
        case Count::two: return "a list of two: " + one;
        case Count::three: return "a list of three: " + one;
        case Count::list: return "a list: " + one;
        case Count::one_or_list: return "one value or a list: " + one;
    }
    return one;
}

namespace {

class Checker {
public:
    Checker(const Schema& schema, Check check) : schema_(schema), check_(check) {}

    void table(Node& table, const Group& group) const {
        if (!table.is_table()) fail(table, "this has to be a table" + keys_of(group));
        unknown_keys(table, group);
        if (group.choice) return alternative(table, group);
        for (const Key& key : group.keys) {
            if (Node* given = table.child(key.name))
                value(*given, key);
            else if (check_ == Check::whole)
                missing(table, key);
        }
    }

private:
    static std::string keys_of(const Group& group) {
        std::vector<std::string> names;
        for (const Key& key : group.keys) names.push_back(key.name);
        return "; allowed in " + group.heading + ": " + joined(names);
    }

    void unknown_keys(const Node& table, const Group& group) const {
        if (group.open) return;
        std::vector<std::string> names;
        for (const Key& key : group.keys) names.push_back(key.name);
        for (const Node& child : table.children)
            if (std::find(names.begin(), names.end(), child.key) == names.end())
                fail(child, "unknown key '" + child.key + "'" + did_you_mean(child.key, names) + keys_of(group));
    }

    void alternative(Node& table, const Group& group) const {
        if (table.children.size() > 1 || (table.children.empty() && check_ == Check::whole))
            fail(table, "exactly one of the keys has to be given, not " + std::to_string(table.children.size()) + keys_of(group));
        for (Node& child : table.children)
            for (const Key& key : group.keys)
                if (key.name == child.key) value(child, key);
    }

    void missing(Node& table, const Key& key) const {
        if (key.required())
            fail(table, "the key '" + key.name + "' is missing: " + key.meaning + "; allowed: " + allowed(key, schema_));
        if (key.fallback.empty()) return;
        supply(table, key.name, key.fallback, "");
        value(table.children.back(), key);
    }

    void value(Node& node, const Key& key) const {
        switch (key.type) {
            case Type::table:
                if (key.or_flag && node.kind == Node::Kind::flag) {
                    if (!node.flag || check_ == Check::partial) return;
                    node.kind = Node::Kind::table;  // `true` stands for the table with its defaults
                }
                return table(node, schema_.group(key.group));
            case Type::tables:
                if (!node.is_list()) fail(node, "this has to be " + allowed(key, schema_));
                for (Node& child : node.children) table(child, schema_.group(key.group));
                return;
            case Type::named:
                if (!node.is_table()) fail(node, "this has to be " + allowed(key, schema_));
                for (Node& child : node.children) table(child, schema_.group(key.group));
                return;
            case Type::names: return pairs(node, key);
            case Type::material: return;
            default: break;
        }
        if (key.count == Count::one || (key.count == Count::one_or_list && !node.is_list())) return scalar(node, node, key);
        const std::size_t wanted = key.count == Count::two ? 2 : key.count == Count::three ? 3 : node.children.size();
        if (!node.is_list() || node.children.size() != wanted) fail(node, "wrong form; allowed: " + allowed(key, schema_));
        for (Node& child : node.children) scalar(child, child, key);
    }

    void pairs(const Node& node, const Key& key) const {
        bool right = node.is_text() && node.text == "all";
        if (node.is_list()) {
            right = true;
            for (const Node& pair : node.children)
                right = right && pair.is_list() && pair.children.size() == 2 && pair.children[0].is_text() && pair.children[1].is_text();
        }
        if (!right) fail(node, "wrong form; allowed: " + allowed(key, schema_));
    }

    void scalar(Node& node, const Node& named, const Key& key) const {
        const std::string also = "; allowed: " + allowed(key, schema_);
        switch (key.type) {
            case Type::text:
                if (!node.is_text()) fail(named, "this has to be a text in quotes" + also);
                return;
            case Type::choice:
                if (!node.is_text() || std::find(key.choices.begin(), key.choices.end(), node.text) == key.choices.end())
                    fail(named, "not one of the choices" + also + (node.is_text() ? did_you_mean(node.text, key.choices) : ""));
                return;
            case Type::flag:
                if (node.kind != Node::Kind::flag) fail(named, "this has to be true or false, without quotes");
                return;
            case Type::integer:
                if (node.kind != Node::Kind::integer) fail(named, "this has to be a whole number" + also);
                break;
            case Type::number:
                if (!node.is_number()) fail(named, "this has to be a number without unit and quotes" + also);
                break;
            case Type::quantity:
                if (node.is_number()) {
                    const std::string example = dimension_example(key.dimension);
                    fail(named, "a bare number for a " + dimension_name(key.dimension) + "; it needs its unit, such as " + in_quotes(example) + also);
                }
                if (!node.is_text()) fail(named, "wrong form" + also);
                node.number = quantity(node, key.dimension, also);
                break;
            case Type::angle:
                if (!node.is_text()) fail(named, "an angle needs its unit" + also);
                node.number = angle(node, also);
                break;
            default: throw std::logic_error("no scalar: " + key.name);
        }
        const Range& range = key.range;
        if (node.number < range.min || node.number > range.max || (range.open && node.number == range.min))
            fail(named, "out of range; it has to be " + in_words(range) + also);
    }

    static double quantity(const Node& node, Dimension dimension, const std::string& also) {
        try {
            return parse_quantity(node.text, dimension);
        } catch (const std::invalid_argument& error) {
            fail(node, error.what() + also);
        }
    }

    static double angle(const Node& node, const std::string& also) {
        try {
            const Quantity quantity = read_quantity(node.text);
            if (quantity.unit == "deg" || quantity.unit == "rad") return quantity.value;
            fail(node, "no angle; the unit has to be deg or rad" + also);
        } catch (const std::invalid_argument& error) {
            fail(node, error.what() + also);
        }
    }

    const Schema& schema_;
    Check check_;
};

}  // namespace

void complete(Node& table, const Group& group, const Schema& schema, Check check) { Checker(schema, check).table(table, group); }

void supply(Node& table, const std::string& key, const std::string& toml, const std::string& reason) {
    Node node = parse_value(toml, reason.empty() ? "default" : "default: " + reason);
    node.key = key;
    node.path = table.path.empty() ? key : table.path + "." + key;
    node.read = !reason.empty();
    set_paths(node);
    table.children.push_back(std::move(node));
}

const Node* first_unread(const Node& node) {
    for (const Node& child : node.children) {
        if (child.is_default()) continue;
        if (node.is_table() && !child.read) return &child;
        const bool holds_tables = child.is_table() || (child.is_list() && !child.children.empty() && child.children.front().is_table());
        if (holds_tables)
            if (const Node* unread = first_unread(child)) return unread;
    }
    return nullptr;
}

void mark_all_read(const Node& node) {
    node.read = true;
    for (const Node& child : node.children) mark_all_read(child);
}

// --- the resolved case -----------------------------------------------------------------------------------------------------

namespace {

bool is_list_of_tables(const Node& node) { return node.is_list() && !node.children.empty() && node.children.front().is_table(); }

/// The children in the order of the group; those that it does not name (parameters of laws) at the end.
std::vector<const Node*> in_order(const Node& table, const Group* group) {
    std::vector<const Node*> ordered;
    if (group)
        for (const Key& key : group->keys)
            for (const Node& child : table.children)
                if (child.key == key.name) ordered.push_back(&child);
    for (const Node& child : table.children)
        if (std::find(ordered.begin(), ordered.end(), &child) == ordered.end()) ordered.push_back(&child);
    return ordered;
}

const Key* key_of(const Group* group, const std::string& name) {
    if (group)
        for (const Key& key : group->keys)
            if (key.name == name) return &key;
    return nullptr;
}

void write(std::string& out, const Node& table, const std::string& path, const Group* group, const Schema& schema, const std::string& header) {
    const std::vector<const Node*> children = in_order(table, group);
    const auto is_section = [](const Node& node) { return node.is_table() || is_list_of_tables(node); };
    const bool has_values = std::any_of(children.begin(), children.end(), [&](const Node* n) { return !is_section(*n); });
    // A table that only holds tables needs no header of its own, but an element of a list does.
    if (!header.empty() && (has_values || children.empty() || header.starts_with("[["))) out += "\n" + header + "\n";
    for (const Node* child : children) {
        if (is_section(*child)) continue;
        const std::string line = child->key + " = " + to_toml(*child);
        out += line + std::string(line.size() < 48 ? 48 - line.size() : 2, ' ') + "# " + origin(*child) + "\n";
    }
    for (const Node* child : children) {
        if (!is_section(*child)) continue;
        const std::string inner = path.empty() ? child->key : path + "." + child->key;
        const Key* key = key_of(group, child->key);
        const Group* inner_group = key && !key->group.empty() ? &schema.group(key->group) : nullptr;
        if (child->is_list()) {
            for (const Node& element : child->children) write(out, element, inner, inner_group, schema, "[[" + inner + "]]");
        } else if (key && key->type == Type::named) {
            for (const Node& named : child->children) {
                const std::string name = inner + "." + named.key;
                write(out, named, name, inner_group, schema, "[" + name + "]");
            }
        } else {
            write(out, *child, inner, inner_group, schema, "[" + inner + "]");
        }
    }
}

}  // namespace

std::string resolved(const Node& root, const Schema& schema) {
    std::string out;
    write(out, root, "", &schema.groups.front(), schema, "");
    return out;
}

}  // namespace brisance::config
