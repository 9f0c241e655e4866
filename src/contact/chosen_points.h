// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exec/launch.h"
#include "neighbours/ring_map.h"

namespace brisance {

struct Gather {
    const double* from[3];
    const std::int32_t* list;
    double* to[3];
    BRISANCE_HD void operator()(std::int64_t k) const {
        for (int a = 0; a < 3; ++a) to[a][k] = from[a][list[k]];
    }
};

/// Some points of many, in a grid of their own. Kept between steps for its memory.
class ChosenPoints {
public:
    /// Room for the numbers of up to n points, which the caller writes.
    std::int32_t* list(std::int64_t n) {
        make_room(list_, static_cast<std::size_t>(n));
        return list_.data();
    }
    /// Sorts the first n of the list; index k of the grid is entry k of the list. `reach` as CellGrid::build has it, `looks`:
    /// how many will ask what is near them. Where they are many, a map of `depth` rings tells most of them that nothing is. `full`: as CellGrid::build
    /// has it; a sparse grid has no map.
    void build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low, double period, std::int64_t looks, int depth = 3, bool full = false) {
        for (auto* a : {&x_, &y_, &z_}) make_room(*a, static_cast<std::size_t>(n));
        exec::launch(n, Gather{{x, y, z}, list_.data(), {x_.data(), y_.data(), z_.data()}}, 1024);
        grid_.build(x_.data(), y_.data(), z_.data(), n, cell, reach, z_low, period, full);
        rings_.build(grid_.view(), looks > 2 * grid_.view().cells() ? depth : 0);
    }
    /// The grid and its map.
    const RingMapView& view() const { return rings_.view(); }

private:
    Array<std::int32_t> list_;
    Array<double> x_, y_, z_;
    CellGrid grid_;
    RingMap rings_;
};

}  // namespace brisance
