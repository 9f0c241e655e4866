// SPDX-License-Identifier: Apache-2.0
// A uniform grid of cells over a set of points, made anew each step by a stable counting sort: points of a cell stand together, in the
// order of their numbers. Cells along x are contiguous, so a row of cells is one range of points.
#pragma once

#include "exec/exec.h"

#include <array>
#include <cstdint>

namespace brisance {

class CellGrid {
public:
    /// Sorts n points. `cell` is the edge of a cell, mm. Where `period` > 0 the points are periodic in z from z_low on, and images
    /// within `reach` of the period's ends are added: entry k stands for point index(k), shifted by shift(k) along z.
    void build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low = 0, double period = 0);

    std::int64_t entries() const { return static_cast<std::int64_t>(index_.size()); }
    std::int64_t index(std::int64_t k) const { return index_[static_cast<std::size_t>(k)]; }
    double shift(std::int64_t k) const { return shift_[static_cast<std::size_t>(k)]; }
    bool image(std::int64_t k) const { return shift_[static_cast<std::size_t>(k)] != 0; }

    /// Calls f(first, last) for ranges of entries [first, last) that together hold all entries within `reach` of (x, y, z),
    /// in a fixed order.
    template <class F>
    void ranges(double x, double y, double z, double reach, F&& f) const {
        if (index_.empty()) return;
        const int i0 = clamp(x - reach, 0), i1 = clamp(x + reach, 0), j0 = clamp(y - reach, 1), j1 = clamp(y + reach, 1),
                  k0 = clamp(z - reach, 2), k1 = clamp(z + reach, 2);
        for (int k = k0; k <= k1; ++k)
            for (int j = j0; j <= j1; ++j) {
                const std::int64_t row = (static_cast<std::int64_t>(k) * n_[1] + j) * n_[0];
                const std::int64_t first = begin_[static_cast<std::size_t>(row + i0)], last = begin_[static_cast<std::size_t>(row + i1 + 1)];
                if (first < last) f(first, last);
            }
    }

private:
    int clamp(double p, std::size_t axis) const {
        const double q = (p - min_[axis]) / cell_;
        if (!(q > 0)) return 0;
        return q >= n_[axis] ? n_[axis] - 1 : static_cast<int>(q);
    }
    double cell_ = 1;
    std::array<double, 3> min_{};
    std::array<int, 3> n_{1, 1, 1};
    std::vector<std::int64_t> begin_;
    std::vector<std::int32_t> index_, cell_of_, raw_index_;
    std::vector<double> shift_, raw_shift_;
};

}  // namespace brisance
