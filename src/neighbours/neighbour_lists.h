// SPDX-License-Identifier: Apache-2.0
// Who is near whom, for points that move freely: made anew each step from a cell grid, and read by every pass of the step.
#pragma once

#include "math/pack.h"
#include "neighbours/cell_grid.h"

#include <algorithm>

namespace brisance {

class NeighbourLists {
public:
    static constexpr int width = lanes<double>;

    /// For each entry i of the grid with wanted(i), the entries j with 0 < |x_i - x_j| < h_i + h_j. The arrays are sorted as the grid's
    /// entries are, with `width` more behind the last, out of everybody's reach.
    template <class Wanted>
    void build(const CellGrid& grid, const double* x, const double* y, const double* z, const double* h, double h_max, Wanted&& wanted) {
        using V = Pack<double>;
        entries_ = grid.entries();
        begin_.resize(static_cast<std::size_t>(entries_));
        count_.resize(static_cast<std::size_t>(entries_));
        lists_.resize(static_cast<std::size_t>(chunks()));
        exec::for_each(chunks(), [&](std::int64_t c) {
            std::vector<std::int32_t>& list = lists_[static_cast<std::size_t>(c)];  // keeps its memory from step to step
            std::size_t used = 0;
            for_chunk(c, [&](std::int64_t k) {
                const auto i = static_cast<std::size_t>(k);
                begin_[i] = static_cast<std::int32_t>(used);
                count_[i] = 0;
                if (!wanted(k)) return;
                std::size_t end = used;
                grid.ranges(x[i], y[i], z[i], std::min(2 * h_max, h[i] + h_max), [&](std::int64_t first, std::int64_t last) {
                    const std::size_t room = end + static_cast<std::size_t>(last - first) + 2 * static_cast<std::size_t>(width);
                    if (list.size() < room) list.resize(std::max(room, 2 * list.size()));
                    for (std::int64_t q = first; q < last; q += width) {
                        const auto j = static_cast<std::size_t>(q);
                        const V dx = x[i] - load<V>(&x[j]), dy = y[i] - load<V>(&y[j]), dz = z[i] - load<V>(&z[j]), reach = h[i] + load<V>(&h[j]);
                        const V r2 = dx * dx + dy * dy + dz * dz, number = static_cast<double>(q) + load<V>(lane_number);
                        end += static_cast<std::size_t>(
                            list_lanes<V>(&list[end], static_cast<std::int32_t>(q), (r2 < reach * reach) & (r2 > 1e-24) & (number < static_cast<double>(last))));
                    }
                });
                count_[i] = static_cast<std::int32_t>(end - used);
                while ((end - used) % static_cast<std::size_t>(width) != 0) list[end++] = static_cast<std::int32_t>(entries_);
                used = end;
            });
        }, 1);
    }

    /// f(list) for each pack of neighbours of entry i; the last is filled up with the entry behind all.
    template <class F>
    void packs(std::int64_t i, F&& f) const {
        const auto k = static_cast<std::size_t>(i);
        const std::int32_t* list = lists_[k / chunk].data() + begin_[k];
        for (std::int32_t n = 0; n < count_[k]; n += width) f(list + n);
    }

    /// Neighbours of all entries together.
    std::int64_t bonds() const {
        std::int64_t n = 0;
        for (std::int32_t k : count_) n += k;
        return n;
    }

private:
    static constexpr std::size_t chunk = 256;
    alignas(64) static constexpr double lane_number[8] = {0, 1, 2, 3, 4, 5, 6, 7};

    std::int64_t chunks() const { return (entries_ + static_cast<std::int64_t>(chunk) - 1) / static_cast<std::int64_t>(chunk); }
    template <class F>
    void for_chunk(std::int64_t c, F&& f) const {
        const std::int64_t first = c * static_cast<std::int64_t>(chunk), last = std::min(first + static_cast<std::int64_t>(chunk), entries_);
        for (std::int64_t k = first; k < last; ++k) f(k);
    }

    std::int64_t entries_ = 0;
    std::vector<std::vector<std::int32_t>> lists_;  ///< of 256 entries each
    std::vector<std::int32_t> begin_, count_;
};

}  // namespace brisance
