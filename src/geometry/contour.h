// SPDX-License-Identifier: Apache-2.0
// Level lines of a function of the plane, by marching squares.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace brisance {

struct Polyline {
    std::vector<Vec2> vertices;
    bool closed = false;
};

/// Cells of a square grid: cell (i, j) spans origin + side * [i, i+1] x [j, j+1].
struct CellSet {
    Vec2 origin;
    double side = 0;
    struct Cell {
        std::int32_t i, j;
    };
    std::vector<Cell> cells;  ///< no cell twice
};

/// The lines f = 0 that run through the cells, each vertex on an edge of the grid, in the order in which the cells meet them.
std::vector<Polyline> contour(const CellSet& set, const std::function<double(Vec2)>& f);

}  // namespace brisance
