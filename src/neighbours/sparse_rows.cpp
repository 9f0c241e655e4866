// SPDX-License-Identifier: Apache-2.0
#include "neighbours/sparse_rows.h"

#include "exec/launch.h"

namespace brisance {

namespace {

/// Marks the blocks that hold entries.
struct MarkKernel {
    UnsortedPoints points;
    CellGridView grid;
    std::int64_t* held;
    BRISANCE_HD void operator()(std::int64_t k) const {
        const UnsortedPoints::Cell c = points.cell(grid, k);
        exec::mark(held[grid.block_at(c.y, c.z)]);
    }
};

/// The row of an entry, and its cell there.
struct PlaceKernel {
    UnsortedPoints points;
    CellGridView grid;
    std::int32_t *row_of, *column_of;
    BRISANCE_HD void operator()(std::int64_t k) const {
        const UnsortedPoints::Cell c = points.cell(grid, k);
        row_of[k] = grid.block[grid.block_at(c.y, c.z)] * CellGridView::rows_of_a_block + CellGridView::row_in_block(c.y, c.z);
        column_of[k] = c.x;
    }
};

/// Entries by rows: those of row r are order[begin[r]] ... order[begin[r + 1] - 1].
struct ByRows {
    const std::int64_t* begin;
    const std::int32_t *order, *column_of;
};

/// From where to where a row has cells, and how many beginnings and ends that makes.
struct ExtentKernel {
    ByRows by;
    CellRow* rows;
    std::int64_t* cells;
    BRISANCE_HD void operator()(std::int64_t r) const {
        const std::int64_t first = by.begin[r], last = by.begin[r + 1];
        CellRow extent{0, 0, 0};
        for (std::int64_t k = first; k < last; ++k) {
            const std::int32_t i = by.column_of[by.order[k]];
            if (k == first || i < extent.first) extent.first = i;
            if (i >= extent.end) extent.end = i + 1;
        }
        rows[r] = extent;
        cells[r] = first < last ? extent.end - extent.first + 1 : 0;
    }
};

/// Sorts the entries of a row by their cells.
struct SortKernel {
    ByRows by;
    const std::int64_t* room;  ///< for the beginnings of a row's cells
    UnsortedPoints points;
    CellRow* rows;
    std::int64_t* begin;
    std::int32_t* index;
    double* shift;
    BRISANCE_HD void operator()(std::int64_t r) const {
        const std::int64_t first = by.begin[r], last = by.begin[r + 1];
        if (first == last) return;
        CellRow& cells = rows[r];
        cells.at = room[r] - cells.first;
        std::int64_t* const at = begin + cells.at;
        for (int i = cells.first; i <= cells.end; ++i) at[i] = 0;
        for (std::int64_t k = first; k < last; ++k) ++at[by.column_of[by.order[k]]];
        std::int64_t next = first;
        for (int i = cells.first; i < cells.end; ++i) {
            const std::int64_t count = at[i];
            at[i] = next;
            next += count;
        }
        // each beginning moves on while its cell fills, and ends where the next one began
        for (std::int64_t k = first; k < last; ++k) {
            const std::int64_t entry = by.order[k], to = at[by.column_of[entry]]++;
            index[to] = points.point(entry);
            shift[to] = points.shifted(entry);
        }
        for (int i = cells.end; i > cells.first; --i) at[i] = at[i - 1];
        at[cells.first] = first;
    }
};

}  // namespace

bool SparseRows::build(CellGridView& g, const UnsortedPoints& points, double most, std::int32_t* order, std::int32_t* index, double* shift) {
    const std::int64_t blocks = g.blocks(1) * g.blocks(2);
    if (8.0 * static_cast<double>(blocks) > most) return false;
    make_room(blocks_before_, static_cast<std::size_t>(blocks) + 1);
    make_room(block_, static_cast<std::size_t>(blocks));
    std::int64_t* const before = blocks_before_.data();
    std::int32_t* const block = block_.data();
    exec::launch(blocks + 1, BRISANCE_KERNEL(std::int64_t b) { before[b] = 0; }, 4096);
    exec::launch(g.entries, MarkKernel{points, g, before}, 1024);
    const std::int64_t rows = (exec::scan(before, blocks + 1) + 1) * CellGridView::rows_of_a_block;
    if (static_cast<double>(rows) > most) return false;
    exec::launch(blocks, BRISANCE_KERNEL(std::int64_t b) { block[b] = static_cast<std::int32_t>(before[b + 1] > before[b] ? before[b + 1] : 0); }, 4096);
    g.block = block;

    for (auto* a : {&row_of_, &column_of_}) make_room(*a, static_cast<std::size_t>(g.entries));
    make_room(rows_, static_cast<std::size_t>(rows));
    make_room(row_begin_, static_cast<std::size_t>(rows) + 1);
    make_room(cells_before_, static_cast<std::size_t>(rows));
    exec::launch(g.entries, PlaceKernel{points, g, row_of_.data(), column_of_.data()}, 1024);
    exec::bucket_sort(row_of_.data(), g.entries, rows, order, row_begin_.data());
    const ByRows by{row_begin_.data(), order, column_of_.data()};
    exec::launch(rows, ExtentKernel{by, rows_.data(), cells_before_.data()});
    const std::int64_t cells = exec::scan(cells_before_.data(), rows);
    if (static_cast<double>(cells) > 2 * most) return false;
    make_room(begin_, static_cast<std::size_t>(cells));
    exec::launch(rows, SortKernel{by, cells_before_.data(), points, rows_.data(), begin_.data(), index, shift});
    g.rows = rows_.data();
    g.begin = begin_.data();
    g.beginnings = cells;
    return true;
}

}  // namespace brisance
