// SPDX-License-Identifier: Apache-2.0
// What a law says of its parameters, and the values that a material file gives it.
#pragma once

#include "base/units.h"

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace brisance {

/// One row of a law's parameter table. A parameter without a fallback must be given: no silent default for a physical constant.
struct ParameterInfo {
    std::string name;
    Dimension dimension;
    std::string meaning;
    double min = -std::numeric_limits<double>::infinity();  ///< allowed range, internal units, bounds included
    double max = std::numeric_limits<double>::infinity();
    std::optional<double> fallback = std::nullopt;  ///< only for switches and for terms whose absence means zero
};

/// A value in internal units, and where it comes from.
struct ParameterValue {
    double value = 0;
    Dimension dimension;     ///< of what was written; the law compares it with the one it wants
    std::string text;        ///< as written, with its unit
    std::string source;      ///< the publication or calculation behind it
    std::string confidence;  ///< S, a:KEY, b-H, b-M, b-L, c (see docs/materials.md)
    std::string where;       ///< file:line:column
};

using ParameterSet = std::map<std::string, ParameterValue>;

/// A law by name with its parameters, as a material file gives it.
struct LawData {
    std::string law;
    std::string where;  ///< file:line:column of the law's name
    ParameterSet parameters;
};

/// Everything a material file says: a density, an equation of state, and where it has them a strength law and a burn law.
struct MaterialData {
    std::string name, title, source, file;
    std::vector<std::string> notes;
    ParameterValue density;
    LawData eos;
    std::optional<LawData> strength;  ///< none: a fluid
    std::optional<LawData> burn;      ///< only explosives
};

}  // namespace brisance
