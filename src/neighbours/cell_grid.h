// SPDX-License-Identifier: Apache-2.0
// A uniform grid of cells over a set of points, made anew each step by a stable counting sort: points of a cell stand together, in the
// order of their numbers. Cells along x are contiguous, so a row of cells is one range of points. Rows stand in strips of some along y, each
// strip from one end of z to the other: what a walk through the points needs of their neighbours then stays in the cache.
#pragma once

#include "base/hd.h"
#include "exec/memory.h"

#include <cstdint>

namespace brisance {

/// The grid as kernels take it: entry k stands for point index[k], shifted by shift[k] along z.
struct CellGridView {
    double cell = 1, min[3] = {0, 0, 0};
    int n[3] = {1, 1, 1};
    std::int64_t entries = 0;
    const std::int64_t* begin = nullptr;
    const std::int32_t* index = nullptr;
    const double* shift = nullptr;

    static constexpr int strip = 8;  ///< rows, a power of 2
    /// Places for cells, the strip that is not full included.
    std::int64_t cells() const { return static_cast<std::int64_t>((n[1] + strip - 1) / strip) * strip * n[0] * n[2]; }
    /// The first cell of a row.
    BRISANCE_HD std::int64_t row(int j, int k) const { return ((static_cast<std::int64_t>(j / strip) * n[2] + k) * strip + j % strip) * n[0]; }
    BRISANCE_HD int place(double p, int axis) const {
        const double q = (p - min[axis]) / cell;
        if (!(q > 0)) return 0;
        return q >= n[axis] ? n[axis] - 1 : static_cast<int>(q);
    }
    /// Calls f(first, last) for ranges of entries [first, last) that together hold all entries within `reach` of (x, y, z),
    /// in a fixed order.
    template <class F>
    BRISANCE_HD void ranges(double x, double y, double z, double reach, F&& f) const {
        if (entries == 0) return;
        const int i0 = place(x - reach, 0), i1 = place(x + reach, 0), j0 = place(y - reach, 1), j1 = place(y + reach, 1), k0 = place(z - reach, 2), k1 = place(z + reach, 2);
        // from a row to the next along y, within a strip and into the next one, and along z
        const std::int64_t along_z = static_cast<std::int64_t>(strip) * n[0], step = n[0], leap = n[2] * along_z - (strip - 1) * step;
        const std::int64_t* low = begin + row(j0, k0) + i0;
        const std::int64_t width = i1 + 1 - i0;
        for (int k = k0; k <= k1; ++k, low += along_z) {
            const std::int64_t* at = low;
            for (int j = j0; j <= j1; ++j) {
                const std::int64_t first = at[0], last = at[width];
                if (first < last) f(first, last);
                at += (j & (strip - 1)) == strip - 1 ? leap : step;
            }
        }
    }
};

class CellGrid {
public:
    /// Sorts n points. `cell` is the edge of a cell, mm. Where `period` > 0 the points are periodic in z from z_low on, and images
    /// within `reach` of the period's ends are added.
    void build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low = 0, double period = 0);

    std::int64_t entries() const { return view_.entries; }
    const CellGridView& view() const { return view_; }
    // for the processor
    std::int64_t index(std::int64_t k) const { return view_.index[k]; }
    double shift(std::int64_t k) const { return view_.shift[k]; }
    bool image(std::int64_t k) const { return view_.shift[k] != 0; }
    template <class F>
    void ranges(double x, double y, double z, double reach, F&& f) const { view_.ranges(x, y, z, reach, static_cast<F&&>(f)); }

private:
    CellGridView view_;
    Array<std::int64_t> begin_;
    Array<std::int32_t> index_, order_, cell_of_, raw_index_;
    Array<double> shift_, raw_shift_;
};

}  // namespace brisance
