// SPDX-License-Identifier: Apache-2.0
// A grid of cells as kernels take it: full, every cell with its place, or sparse (neighbours/sparse_rows.h).
#pragma once

#include "math/vec.h"

#include <cstdint>

namespace brisance {

/// Of a sparse grid: cells [first, end) along x, the first and the last with points; none where nothing is.
struct CellRow {
    std::int64_t at;   ///< cell i begins at entry begin[at + i]
    std::int32_t first, end;
};

/// The grid as kernels take it: entry k stands for point index[k], shifted by shift[k] along z.
struct CellGridView {
    double cell = 1, min[3] = {0, 0, 0};
    int n[3] = {1, 1, 1};
    std::int64_t entries = 0;
    const std::int64_t* begin = nullptr;  ///< the first entry of every cell and, behind the last, the end; of a sparse grid behind the last of every row
    std::int64_t beginnings = 0;          ///< how many these are
    // of a sparse grid
    const CellRow* rows = nullptr;        ///< of each block in turn, y fastest; null: the grid is full
    const std::int32_t* block = nullptr;  ///< the number of each block, z fastest; 0: it is empty
    const std::int32_t* index = nullptr;
    const double* shift = nullptr;

    static constexpr int strip = 8;  ///< rows, a power of 2
    static constexpr int rows_of_a_block = strip * strip;  ///< along y and z
    bool sparse() const { return rows != nullptr; }
    /// Places for cells, the strip that is not full included.
    std::int64_t cells() const { return blocks(1) * strip * n[0] * n[2]; }
    /// The first cell of a row.
    BRISANCE_HD std::int64_t row(int j, int k) const { return ((static_cast<std::int64_t>(j / strip) * n[2] + k) * strip + j % strip) * n[0]; }
    /// Blocks of a sparse grid along an axis.
    BRISANCE_HD std::int64_t blocks(int axis) const { return (n[axis] + strip - 1) / strip; }
    BRISANCE_HD std::int64_t block_at(int j, int k) const { return static_cast<unsigned>(j) / strip * blocks(2) + static_cast<unsigned>(k) / strip; }
    BRISANCE_HD static int row_in_block(int j, int k) { return (k & (strip - 1)) * strip + (j & (strip - 1)); }
    /// The row (j, k) of a sparse grid; in a block that is empty null.
    BRISANCE_HD const CellRow* sparse_row(int j, int k) const {
        const std::int32_t here = block[block_at(j, k)];
        return here == 0 ? nullptr : rows + std::int64_t{here} * rows_of_a_block + row_in_block(j, k);
    }
    /// Calls f(row) for each of the rows j0 ... j1, k0 ... k1 that may hold entries.
    template <class F>
    BRISANCE_HD void each_row(int j0, int j1, int k0, int k1, F&& f) const {
        for (int k = k0; k <= k1; ++k)
            for (int j = j0; j <= j1; ++j) {
                if (!rows) f(CellRow{row(j, k), 0, n[0]});
                else if (const CellRow* const r = sparse_row(j, k)) f(*r);
                else j |= strip - 1;
            }
    }
    /// The entries of cells [i, end) of a row.
    struct Range {
        std::int64_t first, last;
    };
    BRISANCE_HD Range range(const CellRow& r, int i, int end) const {
        const int from = i > r.first ? i : r.first, to = end < r.end ? end : r.end;
        if (from >= to) return {0, 0};
        return {begin[r.at + from], begin[r.at + to]};
    }
    BRISANCE_HD int place(double p, int axis) const {
        const double q = (p - min[axis]) / cell;
        if (!(q > 0)) return 0;
        return q >= n[axis] ? n[axis] - 1 : static_cast<int>(q);
    }
    /// Calls f(first, last) for ranges of entries [first, last) that together hold all entries within `reach` of (x, y, z),
    /// in a fixed order.
    template <class F>
    BRISANCE_HD void ranges(double x, double y, double z, double reach, F&& f) const {
        const double low[3] = {x - reach, y - reach, z - reach}, high[3] = {x + reach, y + reach, z + reach};
        ranges(low, high, f);
    }
    /// The same for all entries in a box.
    template <class F>
    BRISANCE_HD void ranges(const double (&box_low)[3], const double (&box_high)[3], F&& f) const {
        if (entries == 0) return;
        const int i0 = place(box_low[0], 0), i1 = place(box_high[0], 0), j0 = place(box_low[1], 1), j1 = place(box_high[1], 1), k0 = place(box_low[2], 2), k1 = place(box_high[2], 2);
        // in a full grid: from a row to the next along y, within a strip and into the next one, and along z
        const std::int64_t along_z = static_cast<std::int64_t>(strip) * n[0], step = n[0], leap = n[2] * along_z - (strip - 1) * step;
        const std::int64_t* low = begin + row(j0, k0) + i0;
        const std::int64_t width = i1 + 1 - i0;
        for (int k = k0; k <= k1; ++k, low += along_z) {
            const std::int64_t* at = low;
            for (int j = j0; j <= j1; ++j) {
                Range r{};
                if (!rows) {
                    r = {at[0], at[width]};
                    at += (j & (strip - 1)) == strip - 1 ? leap : step;
                } else if (const CellRow* const here = sparse_row(j, k)) {
                    r = range(*here, i0, i1 + 1);
                } else {
                    j |= strip - 1;  // on to the next block
                }
                if (r.first < r.last) f(r.first, r.last);
            }
        }
    }
};

/// Points before they are sorted: the points themselves, or where there is a period those and their images.
struct UnsortedPoints {
    const double *x, *y, *z;
    const std::int32_t* index;  ///< null: entry k is point k
    const double* shift;
    BRISANCE_HD std::int32_t point(std::int64_t k) const { return index ? index[k] : static_cast<std::int32_t>(k); }
    BRISANCE_HD double shifted(std::int64_t k) const { return shift ? shift[k] : 0.0; }
    /// Where entry k is, and its cell in a grid.
    BRISANCE_HD Vec3<double> place(std::int64_t k) const {
        const std::int32_t i = point(k);
        return {x[i], y[i], z[i] + shifted(k)};
    }
    struct Cell {
        int x, y, z;
    };
    BRISANCE_HD Cell cell(const CellGridView& grid, std::int64_t k) const {
        const Vec3<double> p = place(k);
        return {grid.place(p.x, 0), grid.place(p.y, 1), grid.place(p.z, 2)};
    }
};

}  // namespace brisance
