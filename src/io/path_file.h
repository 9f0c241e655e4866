// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "laws/point_path.h"

#include <string>

namespace brisance {

/// Reads a path for `brisance material`: docs/material-point.md has all keys. Throws InputError with file, line, column, key, value and
/// what is allowed.
PointPath read_path(const std::string& file);

}  // namespace brisance
