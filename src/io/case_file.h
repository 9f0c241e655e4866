// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/case.h"

#include <string>
#include <vector>

namespace brisance {

namespace config {
struct Node;
struct Schema;
}  // namespace config

/// Reads a case file with its includes, applies the preset (empty: none) and then each "key.path=value" in `settings`.
/// A path may begin with a part's name ("rock.spacing") in place of "part.rock.spacing". Values are TOML; a bare word or a
/// quantity with its unit is taken as a string.
/// Throws InputError with file, line, column, key, value, what is allowed, and the nearest spelling.
Case read_case(const std::string& file, const std::string& preset, const std::vector<std::string>& settings);

/// Finds materials/<name>.toml (or a path to a file) and reads it.
MaterialData read_material(const std::string& name_or_file);

/// The names of all material files in the library.
std::vector<std::string> list_materials();

/// The file of a material: a path ending in .toml, <name>.toml in the library, or <name>.toml in the folder `beside`. Empty: none.
std::string find_material(const std::string& name_or_file, const std::string& beside);

/// Reads a material that a case defines: what it changes of `base`, or without a base the whole of it.
MaterialData read_material_variant(const config::Node& variant, const MaterialData* base);

/// The one table of the keys of a case file: checks, defaults, the reference page and `Case::resolved` follow it.
const config::Schema& case_schema();

/// Every key of a case file with its dimension, default, allowed values and meaning, as Markdown: docs/reference/case-file.md.
std::string case_file_reference();

}  // namespace brisance
