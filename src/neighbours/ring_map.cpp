// SPDX-License-Identifier: Apache-2.0
#include "neighbours/ring_map.h"

#include "exec/launch.h"

namespace brisance {

namespace {

/// 0 where a cell holds points, else one more than the map is deep.
struct OccupiedKernel {
    CellGridView grid;
    int depth;
    std::uint8_t* rings;
    BRISANCE_HD void operator()(std::int64_t r) const {
        const std::int64_t row = grid.row(static_cast<int>(r % grid.n[1]), static_cast<int>(r / grid.n[1]));
        const std::int64_t* const begin = grid.begin + row;
        std::uint8_t* const to = rings + row;
        const int n = grid.n[0], far = depth + 1;  // copies: what is written through a byte could be anything
        for (int i = 0; i < n; ++i) to[i] = static_cast<std::uint8_t>(begin[i] < begin[i + 1] ? 0 : far);
    }
};

/// Axis by axis, since a ring is a cube: the number of a cell is min over its row of max(steps along the row, the number there).
struct SpreadKernel {
    CellGridView grid;
    int depth, axis;
    const std::uint8_t* from;
    std::uint8_t* to;
    BRISANCE_HD void operator()(std::int64_t r) const {
        const int at[3] = {0, static_cast<int>(r % grid.n[1]), static_cast<int>(r / grid.n[1])}, n = grid.n[0];
        const std::int64_t row = grid.row(at[1], at[2]);
        std::uint8_t* const mine = to + row;
        for (int i = 0; i < n; ++i) mine[i] = from[row + i];
        for (int d = -depth; d <= depth; ++d) {
            int there[3] = {at[0], at[1], at[2]}, first = 0, last = n;
            there[axis] += d;
            if (axis == 0) {
                first = d < 0 ? -d : 0;
                last = d > 0 ? n - d : n;
            } else if (there[axis] < 0 || there[axis] >= grid.n[axis]) {
                continue;
            }
            const std::uint8_t* const others = from + grid.row(there[1], there[2]) + there[0];
            const auto steps = static_cast<std::uint8_t>(d < 0 ? -d : d);
            for (int i = first; i < last; ++i) {
                const std::uint8_t ring = others[i] > steps ? others[i] : steps;
                mine[i] = ring < mine[i] ? ring : mine[i];
            }
        }
    }
};

}  // namespace

void RingMap::build(const CellGridView& grid, int depth) {
    view_ = {grid, nullptr};
    if (depth == 0 || grid.sparse()) return;
    for (auto* a : {&rings_, &between_}) make_room(*a, static_cast<std::size_t>(grid.cells()));
    const std::int64_t rows = static_cast<std::int64_t>(grid.n[1]) * grid.n[2];
    exec::launch(rows, OccupiedKernel{grid, depth, between_.data()});
    exec::launch(rows, SpreadKernel{grid, depth, 0, between_.data(), rings_.data()});
    exec::launch(rows, SpreadKernel{grid, depth, 1, rings_.data(), between_.data()});
    exec::launch(rows, SpreadKernel{grid, depth, 2, between_.data(), rings_.data()});
    view_.rings = rings_.data();
}

}  // namespace brisance
