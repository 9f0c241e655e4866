// SPDX-License-Identifier: Apache-2.0
// A uniform grid of cells over a set of points, made anew each step by a stable counting sort: points of a cell stand together, in the
// order of their numbers. Cells along x are contiguous, so a row of cells is one range of points. Rows stand in strips of some along y, each
// strip from one end of z to the other: what a walk through the points needs of their neighbours then stays in the cache.
// Where that would be many more cells than points the grid is sparse (neighbours/sparse_rows.h).
#pragma once

#include "neighbours/sparse_rows.h"

namespace brisance {

class CellGrid {
public:
    /// Sorts n points. `cell` is the edge of a cell, mm. Where `period` > 0 the points are periodic in z from z_low on, and images
    /// within `reach` of the period's ends are added. `full`: cells grow rather than that the grid is sparse.
    void build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low = 0, double period = 0, bool full = false);

    std::int64_t entries() const { return view_.entries; }
    const CellGridView& view() const { return view_; }
    // for the processor
    std::int64_t index(std::int64_t k) const { return view_.index[k]; }
    double shift(std::int64_t k) const { return view_.shift[k]; }
    bool image(std::int64_t k) const { return view_.shift[k] != 0; }
    template <class F>
    void ranges(double x, double y, double z, double reach, F&& f) const { view_.ranges(x, y, z, reach, static_cast<F&&>(f)); }

private:
    void sort_all(const UnsortedPoints& raw);

    CellGridView view_;
    SparseRows sparse_;
    Array<std::int64_t> begin_;
    Array<std::int32_t> index_, order_, cell_of_, raw_index_;
    Array<double> shift_, raw_shift_;
};

}  // namespace brisance
