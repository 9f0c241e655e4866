// SPDX-License-Identifier: Apache-2.0
#include "geometry/hilbert.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace brisance {
namespace {

constexpr std::uint32_t bits = 24;

/// Place of the cell (x, y) of a 2^bits grid along the curve: at each scale the quadrant counts, then the frame turns with it.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y) {
    std::uint64_t index = 0;
    for (std::uint32_t s = 1u << (bits - 1); s > 0; s /= 2) {
        const bool right = (x & s) != 0, up = (y & s) != 0;
        index = 4 * index + (right ? (up ? 2u : 3u) : (up ? 1u : 0u));
        if (!up) {
            if (right) {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return index;
}

}  // namespace

std::vector<std::size_t> hilbert_order(const std::vector<Vec2>& points) {
    if (points.empty()) return {};
    Vec2 min = points.front(), max = points.front();
    for (const Vec2 p : points) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y)};
    }
    const double width = std::max({max.x - min.x, max.y - min.y, 1e-300});
    const double scale = static_cast<double>((1u << bits) - 1) / width;

    std::vector<std::pair<std::uint64_t, std::size_t>> keyed(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 q = scale * (points[i] - min);
        keyed[i] = {hilbert_index(static_cast<std::uint32_t>(q.x), static_cast<std::uint32_t>(q.y)), i};
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::size_t> order(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = keyed[k].second;
    return order;
}

}  // namespace brisance
