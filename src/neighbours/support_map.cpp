// SPDX-License-Identifier: Apache-2.0
#include "neighbours/support_map.h"

#include "exec/launch.h"

#include <algorithm>

namespace brisance {

namespace {

struct Block {
    int i, j, k;
};
BRISANCE_HD Block block_of(const SupportMapView& m, std::int64_t b) {
    return {static_cast<int>(b % m.n[0]), static_cast<int>(b / m.n[0] % m.n[1]), static_cast<int>(b / m.n[0] / m.n[1])};
}

/// The largest support in a block.
struct OwnKernel {
    SupportMapView map;
    const float* h;
    float* own;
    BRISANCE_HD void operator()(std::int64_t b) const {
        const CellGridView& g = map.grid;
        const Block at = block_of(map, b);
        const auto end = [&](int block, int axis) { return std::min((block + 1) * map.block, g.n[axis]); };
        float most = 0;
        for (int k = at.k * map.block; k < end(at.k, 2); ++k)
            for (int j = at.j * map.block; j < end(at.j, 1); ++j) {
                const std::int64_t* const row = g.begin + g.row(j, k);
                for (std::int64_t q = row[at.i * map.block]; q < row[end(at.i, 0)]; ++q) most = std::max(most, h[q]);
            }
        own[b] = most;
    }
};

struct AroundKernel {
    SupportMapView map;
    const float* own;
    float* largest;
    BRISANCE_HD void operator()(std::int64_t b) const {
        const Block at = block_of(map, b);
        float most = 0;
        for (int k = std::max(at.k - 1, 0); k <= std::min(at.k + 1, map.n[2] - 1); ++k)
            for (int j = std::max(at.j - 1, 0); j <= std::min(at.j + 1, map.n[1] - 1); ++j)
                for (int i = std::max(at.i - 1, 0); i <= std::min(at.i + 1, map.n[0] - 1); ++i) most = std::max(most, own[map.at(i, j, k)]);
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
    for (int a = 0; a < 3; ++a) {
        view_.n[a] = (grid.n[a] + view_.block - 1) / view_.block;
        blocks *= view_.n[a];
    }
    for (auto* a : {&own_, &largest_}) make_room(*a, static_cast<std::size_t>(blocks));
    exec::launch(blocks, OwnKernel{view_, h, own_.data()}, 1);
    exec::launch(blocks, AroundKernel{view_, own_.data(), largest_.data()});
    view_.largest = largest_.data();
}

}  // namespace brisance
