// SPDX-License-Identifier: Apache-2.0
// A grid of which most cells are empty. Gas flung far out must neither fill the memory between it and the rest nor make the cells of the rest
// larger, so only blocks of eight by eight rows that hold points are there, and of a row the cells from its first point to its last. The points
// stand in the order of a full grid.
#pragma once

#include "exec/memory.h"
#include "neighbours/cell_grid_view.h"

namespace brisance {

class SparseRows {
public:
    /// Sorts the entries of a grid whose cells are set: index and shift in its order (`order`: room for as many numbers). False where that takes
    /// more than `most` rows, twice as many cells, or a table of blocks of an eighth as many.
    bool build(CellGridView& grid, const UnsortedPoints& points, double most, std::int32_t* order, std::int32_t* index, double* shift);

private:
    Array<CellRow> rows_;
    Array<std::int64_t> begin_, row_begin_, blocks_before_, cells_before_;
    Array<std::int32_t> block_, row_of_, column_of_;
};

}  // namespace brisance
