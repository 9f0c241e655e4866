// SPDX-License-Identifier: Apache-2.0
// A thin layer over TOML: a tree in which every value knows where it was written, and a table of keys ("schema") that says
// what may be written. Checking, defaults, the reference page and the resolved case all follow the same table.
#pragma once

#include "base/units.h"
#include "math/vec.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace brisance::config {

/// One value of a TOML file, with its origin.
struct Node {
    enum class Kind { flag, integer, number, text, list, table };

    Kind kind = Kind::table;
    std::string key;              ///< its name in the table that holds it; empty for the elements of a list
    std::string path;             ///< "part.rock.spacing", "gauge[1].at"; set by `set_paths`
    std::string where;            ///< "file:line:column", "--set key=value", or "default"
    std::string via;              ///< "preset quick" when a preset put it here
    bool flag = false;
    std::int64_t integer = 0;
    double number = 0;            ///< numbers; after `complete` also quantities, in internal units
    std::string text;
    std::vector<Node> children;   ///< of tables and lists, in the order of the file
    mutable bool read = false;    ///< `at`, `find` and `children_read` note that the program made use of the value

    bool is_table() const { return kind == Kind::table; }
    bool is_list() const { return kind == Kind::list; }
    bool is_text() const { return kind == Kind::text; }
    bool is_number() const { return kind == Kind::number || kind == Kind::integer; }
    bool is_default() const { return where == "default" || where.starts_with("default: "); }

    /// The value under `name`, marked as read; null when absent.
    const Node* find(std::string_view name) const;
    /// The same for a key that `complete` guarantees to be there.
    const Node& at(std::string_view name) const;
    /// Whether the key is there; does not mark it.
    bool has(std::string_view name) const;
    Node* child(std::string_view name);
    std::vector<std::string> names() const;

    std::vector<double> numbers() const;        ///< of a list, internal units
    std::vector<std::string> texts() const;     ///< of a list
    Vec3<double> point() const;                 ///< of a list of three
};

/// Reads a TOML file. Throws InputError on a missing file (said at `asked_at`) or on a syntax error.
Node parse_file(const std::string& path, const std::string& asked_at = "");

/// Reads one value as of "--set key=value": TOML, or a bare word or quantity taken as text.
Node parse_value(const std::string& value, const std::string& where);

/// Writes `from` over `into`: tables are merged key by key, everything else is replaced. Tables for which `is_choice(key)`
/// holds exactly one alternative; another alternative replaces them.
void merge(Node& into, const Node& from, const std::function<bool(const std::string&)>& is_choice);

/// Names every node by its place in the tree.
void set_paths(Node& root);

/// Throws InputError: "file:line:column: key = value: problem".
[[noreturn]] void fail(const Node& node, const std::string& problem);

/// As TOML on one line.
std::string to_toml(const Node& node);

/// "file:12:3 (preset quick)".
std::string origin(const Node& node);

// ---------------------------------------------------------------------------------------------------------------------------

enum class Type {
    text,
    choice,     ///< one of `choices`
    flag,
    integer,
    number,
    quantity,   ///< text with a unit of `dimension`
    angle,      ///< text with "deg" or "rad"
    material,   ///< read by material_file.cpp: a parameter or a law
    names,      ///< "all", or a list of pairs of names
    table,      ///< one table with the keys of `group`
    tables,     ///< a list of such tables: [[key]]
    named       ///< tables by a name that the user chooses: [key.name]
};

struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool open = false;   ///< `min` itself is not allowed
};
inline constexpr Range any{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range not_negative{0, std::numeric_limits<double>::infinity(), false};
inline constexpr Range at_least_one{1, std::numeric_limits<double>::infinity(), false};
inline constexpr Range fraction{0, 1, false};
inline constexpr Range count{1, 1e6, false};

/// How many values: one, a fixed number of them in a list, any number in a list, or either one or a list.
enum class Count { one, two, three, list, one_or_list };

/// One row of the table of keys. A key with neither `fallback` nor `absent` must be given.
struct Key {
    std::string name;
    Type type;
    std::string meaning;
    std::string fallback = "";                  ///< the default, as TOML
    std::string absent = "";                    ///< what happens without the key, in words
    Dimension dimension = dimension::none;
    Range range = any;
    Count count = Count::one;
    std::vector<std::string> choices = {};
    std::string group = "";                     ///< of tables: the keys inside
    bool or_flag = false;                       ///< true or false will do in place of the table

    bool required() const { return fallback.empty() && absent.empty(); }
};

/// The keys of one kind of table.
struct Group {
    std::string name;      ///< for references from `Key::group`
    std::string heading;   ///< "[part.NAME]"
    std::string meaning;
    std::vector<Key> keys;
    bool choice = false;   ///< exactly one of the keys is given
    bool open = false;     ///< further keys are allowed: parameters that only a law knows
};

struct Schema {
    std::vector<Group> groups;   ///< the first is the root
    const Group& group(std::string_view name) const;
    /// Whether some key of this name holds a table of alternatives.
    bool is_choice(const std::string& key) const;
};

enum class Check {
    whole,    ///< every mandatory key is there; defaults are filled in
    partial   ///< only what is there is checked: presets
};

/// Checks a table against its group, converts quantities, fills in defaults. Throws InputError.
void complete(Node& table, const Group& group, const Schema& schema, Check check = Check::whole);

/// Adds a value that follows from others, so that the resolved case shows it.
void supply(Node& table, const std::string& key, const std::string& toml, const std::string& reason);

/// The first value that was given but never read, or null.
const Node* first_unread(const Node& node);
void mark_all_read(const Node& node);

/// What may stand at a key: "a length such as "0.15 mm", > 0".
std::string allowed(const Key& key, const Schema& schema);

/// The tree in the order of the schema, with a comment after each value: its origin.
std::string resolved(const Node& root, const Schema& schema);

}  // namespace brisance::config
