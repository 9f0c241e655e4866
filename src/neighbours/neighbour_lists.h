// SPDX-License-Identifier: Apache-2.0
// Who is near whom, for points that move freely: made anew each step from a cell grid, and read by every pass of the step.
#pragma once

#include "exec/launch.h"
#include "math/pack.h"
#include "neighbours/cell_grid.h"

#include <algorithm>

namespace brisance {

/// The lists as kernels take them. Of the processor each is in one piece, a whole number of packs; where a pack is one number, the first
/// neighbours of all entries stand together, then the second, ...
struct NeighbourListsView {
    static constexpr int width = lanes<double>;
    std::int32_t* lists = nullptr;
    std::int32_t* count = nullptr;
    std::int64_t entries = 0, capacity = 0;

    BRISANCE_HD std::int32_t* at(std::int64_t i, std::int64_t n) const {
        if constexpr (width == 1) return lists + n * entries + i;
        else return lists + i * capacity + n;
    }
    /// f(list) for each pack of neighbours of entry i; the last is filled up with the entry behind all.
    template <class F>
    BRISANCE_HD void packs(std::int64_t i, F&& f) const {
        for (std::int32_t n = 0; n < count[i]; n += width) f(static_cast<const std::int32_t*>(at(i, n)));
    }
};

/// Entries of a grid with their supports, in its order, with a pack behind the last that is out of everybody's reach.
struct Supports {
    const double *x, *y, *z, *h;
    double h_max;
};

/// Lists the neighbours of an entry that is wanted, and says how many. A list that is full goes on counting.
template <class Wanted>
struct SearchKernel {
    CellGridView grid;
    Supports s;
    NeighbourListsView v;
    Wanted wanted;
    BRISANCE_HD double operator()(std::int64_t i) const {
        using V = Pack<double>;
        constexpr int width = NeighbourListsView::width;
        v.count[i] = 0;
        if (!wanted(i)) return 0;
        const double x = s.x[i], y = s.y[i], z = s.z[i], h = s.h[i];
        const std::int64_t full = v.capacity - 2 * width;
        std::int64_t end = 0;
        grid.ranges(x, y, z, h + s.h_max < 2 * s.h_max ? h + s.h_max : 2 * s.h_max, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const V dx = x - load<V>(s.x + q), dy = y - load<V>(s.y + q), dz = z - load<V>(s.z + q), reach = h + load<V>(s.h + q);
                const V r2 = dx * dx + dy * dy + dz * dz;
                end += list_lanes<V>(v.at(i, end < full ? end : full), static_cast<std::int32_t>(q), (r2 < reach * reach) & (r2 > 1e-24) & lanes_before<V>(q, last));
            }
        });
        if (end > full) return static_cast<double>(end);
        v.count[i] = static_cast<std::int32_t>(end);
        for (std::int64_t n = end; n % width != 0; ++n) *v.at(i, n) = static_cast<std::int32_t>(v.entries);
        return static_cast<double>(end);
    }
};

class NeighbourLists {
public:
    /// For each entry i of the grid with wanted(i), the entries j with 0 < |x_i - x_j| < h_i + h_j.
    template <class Wanted>
    void build(const CellGridView& grid, const Supports& s, const Wanted& wanted) {
        NeighbourListsView& v = view_;
        v.entries = grid.entries;
        make_room(count_, static_cast<std::size_t>(v.entries));
        v.count = count_.data();
        for (;;) {
            make_room(lists_, static_cast<std::size_t>(v.entries * v.capacity + v.width));
            v.lists = lists_.data();
            const auto most = static_cast<std::int64_t>(exec::launch_max(v.entries, 0.0, SearchKernel<Wanted>{grid, s, v, wanted}));
            if (most + 2 * v.width <= v.capacity) return;
            v.capacity = (most + most / 8 + 3 * v.width) / v.width * v.width;
        }
    }
    const NeighbourListsView& view() const { return view_; }

private:
    NeighbourListsView view_{nullptr, nullptr, 0, 96};
    Array<std::int32_t> lists_, count_;
};

}  // namespace brisance
