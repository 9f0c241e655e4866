// SPDX-License-Identifier: Apache-2.0
#include "neighbours/support_map.h"

#include "exec/launch.h"

#include <algorithm>

namespace brisance {

namespace {

/// The largest supports in the blocks of a row of them along x.
struct OwnKernel {
    SupportMapView map;
    const float* h;
    float* own;
    BRISANCE_HD void operator()(std::int64_t r) const {
        const CellGridView& g = map.grid;
        const int j0 = static_cast<int>(r % map.n[1]) * map.block, k0 = static_cast<int>(r / map.n[1]) * map.block;
        float* const mine = own + r * map.n[0];
        for (int i = 0; i < map.n[0]; ++i) mine[i] = 0;
        g.each_row(j0, std::min(j0 + map.block, g.n[1]) - 1, k0, std::min(k0 + map.block, g.n[2]) - 1, [&](const CellRow& row) {
            for (int i = row.first / map.block; i * map.block < row.end; ++i) {
                const CellGridView::Range range = g.range(row, i * map.block, (i + 1) * map.block);
                for (std::int64_t q = range.first; q < range.last; ++q) mine[i] = std::max(mine[i], h[q]);
            }
        });
    }
};

struct AroundKernel {
    SupportMapView map;
    const float* own;
    float* largest;
    BRISANCE_HD void operator()(std::int64_t b) const {
        const int at[3] = {static_cast<int>(b % map.n[0]), static_cast<int>(b / map.n[0] % map.n[1]), static_cast<int>(b / map.n[0] / map.n[1])};
        float most = 0;
        for (int k = std::max(at[2] - 1, 0); k <= std::min(at[2] + 1, map.n[2] - 1); ++k)
            for (int j = std::max(at[1] - 1, 0); j <= std::min(at[1] + 1, map.n[1] - 1); ++j)
                for (int i = std::max(at[0] - 1, 0); i <= std::min(at[0] + 1, map.n[0] - 1); ++i) most = std::max(most, own[map.at(i, j, k)]);
        largest[b] = most;
    }
};

}  // namespace

void SupportMap::build(const CellGridView& grid, const float* h, double h_max) {
    view_ = {};
    view_.grid = grid;
    view_.h_max = h_max;
    if (grid.cell >= h_max) return;
    view_.block = 1 + static_cast<int>(2 * h_max / grid.cell);  // a pair is no farther apart than a block is wide
    std::int64_t blocks = 1;
    for (;; view_.block *= 2, blocks = 1) {
        for (int a = 0; a < 3; ++a) {
            view_.n[a] = (grid.n[a] + view_.block - 1) / view_.block;
            blocks *= view_.n[a];
        }
        if (blocks <= grid.entries + 64) break;  // most would hold nothing
    }
    for (auto* a : {&own_, &largest_}) make_room(*a, static_cast<std::size_t>(blocks));
    exec::launch(static_cast<std::int64_t>(view_.n[1]) * view_.n[2], OwnKernel{view_, h, own_.data()}, 1);
    exec::launch(blocks, AroundKernel{view_, own_.data(), largest_.data()});
    view_.largest = largest_.data();
}

}  // namespace brisance
