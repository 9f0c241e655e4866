// SPDX-License-Identifier: Apache-2.0
// Hilbert's curve: an order of the plane in which near neighbours are near in memory.
#pragma once

#include "math/vec.h"

#include <cstddef>
#include <vector>

namespace brisance {

/// The permutation that sorts points along the curve: order[k] is the index of the k-th point.
std::vector<std::size_t> hilbert_order(const std::vector<Vec2>& points);

}  // namespace brisance
