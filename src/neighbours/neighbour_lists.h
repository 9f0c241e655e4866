// SPDX-License-Identifier: Apache-2.0
// Who is near whom, for points that move freely: made anew each step from a cell grid, and read by every pass of the step.
#pragma once

#include "base/error.h"
#include "exec/launch.h"
#include "math/pack.h"
#include "neighbours/support_map.h"

#include <algorithm>
#include <limits>
#include <string>

namespace brisance {

/// The lists as kernels take them: where the record of each neighbour begins. Of the processor each is in one piece, a whole number of packs;
/// where a pack is one number, the first neighbours of all entries stand together, then the second, ...
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

/// Entries of a grid with their supports, in its order, with a pack of floats behind the last that is out of everybody's reach.
struct Supports {
    const float *x, *y, *z, *h;   ///< from the grid's corner; h: half of the support
    const double* records;        ///< of each entry, x y z h first
    double h_max;

    /// By how much a pair may be farther apart than these floats say: each place is off by 2^-24 of the grid, sums and products by as much of themselves.
    float slack(const CellGridView& grid) const {
        return static_cast<float>(0x1p-22 * (grid.cell * std::max({grid.n[0], grid.n[1], grid.n[2]}) + 4 * h_max));
    }
};

/// Lists the neighbours of an entry that is wanted, and says how many. A list that is full goes on counting.
/// In single precision, which takes twice as many at once: what it lists beyond the support by rounding has no weight.
template <class Wanted>
struct SearchKernel {
    CellGridView grid;
    Supports s;
    NeighbourListsView v;
    Wanted wanted;
    SupportMapView supports;
    float slack;
    BRISANCE_HD double operator()(std::int64_t i) const {
        using V = Pack<float>;
        constexpr int width = lanes<float>;
        v.count[i] = 0;
        if (!wanted(i)) return 0;
        const double* const at = s.records + record_length * i;
        const double reach = at[3] + supports.near(at[0], at[1], at[2]) + static_cast<double>(slack);
        const float x = s.x[i], y = s.y[i], z = s.z[i], h = s.h[i] + slack;
        const std::int64_t full = v.capacity - 2 * width;
        std::int64_t end = 0;
        grid.ranges(at[0], at[1], at[2], reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const V dx = x - load<V>(s.x + q), dy = y - load<V>(s.y + q), dz = z - load<V>(s.z + q), apart = h + load<V>(s.h + q);
                const V r2 = dx * dx + dy * dy + dz * dz;
                end += list_lanes<V>(v.at(i, end < full ? end : full), static_cast<std::int32_t>(q), (r2 < apart * apart) & lanes_before<V>(q, last) & other_lanes<V>(q, i));
            }
        });
        if (end > full) return static_cast<double>(end);
        v.count[i] = static_cast<std::int32_t>(end);
        for (std::int64_t n = end; n % v.width != 0; ++n) *v.at(i, n) = static_cast<std::int32_t>(record_length * v.entries);
        return static_cast<double>(end);
    }
};

class NeighbourLists {
public:
    /// For each entry i of the grid with wanted(i), the other entries j with |x_i - x_j| < h_i + h_j, and few that are farther by rounding.
    template <class Wanted>
    void build(const CellGridView& grid, const Supports& s, const Wanted& wanted) {
        NeighbourListsView& v = view_;
        v.entries = grid.entries;
        if (v.entries > most_entries) throw ResourceError("a fluid of " + std::to_string(v.entries) + " particles and images: its lists of neighbours number at most " + std::to_string(most_entries));
        make_room(count_, static_cast<std::size_t>(v.entries));
        supports_.build(grid, s.h, s.h_max);
        v.count = count_.data();
        for (;;) {
            make_room(lists_, static_cast<std::size_t>(v.entries * v.capacity + lanes<float>));
            v.lists = lists_.data();
            const auto most = static_cast<std::int64_t>(exec::launch_max(v.entries, 0.0, SearchKernel<Wanted>{grid, s, v, wanted, supports_.view(), s.slack(grid)}));
            if (most + 2 * lanes<float> <= v.capacity) return;
            v.capacity = (most + most / 8 + 3 * lanes<float>) / v.width * v.width;
        }
    }
    const NeighbourListsView& view() const { return view_; }

private:
    static constexpr std::int64_t most_entries = std::numeric_limits<std::int32_t>::max() / record_length - 1;
    NeighbourListsView view_{nullptr, nullptr, 0, 96};
    Array<std::int32_t> lists_, count_;
    SupportMap supports_;
};

}  // namespace brisance
