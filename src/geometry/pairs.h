// SPDX-License-Identifier: Apache-2.0
// Which points of a cloud are near each other, where the spacing may vary by orders of magnitude.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace brisance {

/// From so many points on a loop over them is shared between threads.
inline constexpr std::size_t worth_threads = 6000;

/// Neighbours of each point, in an order that depends on the points alone.
struct Pairs {
    std::vector<std::size_t> begin;      ///< one more than points
    std::vector<std::uint32_t> neighbour;

    std::span<const std::uint32_t> of(std::size_t i) const { return {neighbour.data() + begin[i], begin[i + 1] - begin[i]}; }
};

/// All j != i with |x_j - x_i| < range (spacing_i + spacing_j) / 2.
Pairs find_pairs(const std::vector<Vec2>& points, const std::vector<double>& spacing, double range);

}  // namespace brisance
