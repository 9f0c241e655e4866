// SPDX-License-Identifier: Apache-2.0
// Numbers of points in columns that packs are read from: of all points in the order of a grid, and of those near a group of nodes.
#pragma once

#include "math/pack.h"
#include "neighbours/box.h"
#include "neighbours/cell_grid.h"

#include <array>
#include <cmath>

namespace brisance {

/// Groups that a thread takes at once.
inline constexpr int few_groups = 8;

/// Columns of numbers in the order of a grid's entries, with a pack of room behind the last.
template <int n>
struct SortedView {
    double* columns[n];
    BRISANCE_HD Pack<double> operator()(int c, std::int64_t k) const { return load<Pack<double>>(columns[c] + k); }
    BRISANCE_HD void put(std::int64_t k, const double (&row)[n]) const {
        for (int c = 0; c < n; ++c) columns[c][k] = row[c];
    }
};
/// Kept between steps for their memory.
template <int n>
class SortedColumns {
public:
    SortedView<n> room(std::int64_t entries) {
        SortedView<n> v;
        for (std::size_t c = 0; c < n; ++c) {
            make_room(columns_[c], static_cast<std::size_t>(entries + lanes<double>));
            v.columns[c] = columns_[c].data();
        }
        return v;
    }

private:
    std::array<Array<double>, n> columns_;
};

/// The square of how far a point is from a box.
template <class V>
BRISANCE_HD inline V apart2(const PointBox& box, V x, V y, V z) {
    const auto beyond = [&](V p, int a) { return vmax(vmax(box.min[a] - p, p - box.max[a]), V{}); };
    const V dx = beyond(x, 0), dy = beyond(y, 1), dz = beyond(z, 2);
    return dx * dx + dy * dy + dz * dz;
}
/// f(first, last) for the ranges of a grid that are within `reach` of a box.
template <class F>
BRISANCE_HD inline void ranges(const CellGridView& grid, const PointBox& box, double reach, F&& f) {
    const double low[3] = {box.min[0] - reach, box.min[1] - reach, box.min[2] - reach}, high[3] = {box.max[0] + reach, box.max[1] + reach, box.max[2] + reach};
    grid.ranges(low, high, f);
}

/// Those of the points that are near a group of nodes, close together. In a build for a device a thread has no room for them: then there are never all.
template <int n>
struct Gathered {
    static constexpr int most = lanes<double> > 1 ? 192 : 0;
    alignas(64) double room[n][most + lanes<double>];
    int count = 0;
    bool all = true;   ///< there was room

    BRISANCE_HD void take(const double (&row)[n]) {
        all = count < most;
        if constexpr (most > 0) {
            if (!all) return;
            for (int c = 0; c < n; ++c) room[c][count] = row[c];
            ++count;
        }
    }
    /// The entries k + l for each bit l that is set.
    BRISANCE_HD void take(const SortedView<n>& from, std::int64_t k, unsigned bits) {
        each_lane(bits, [&](int l) {
            double row[n];
            for (int c = 0; c < n; ++c) row[c] = from.columns[c][k + l];
            take(row);
        });
    }
    /// Those within `reach` of a box: `from` in the order of the grid, place first.
    BRISANCE_HD void take_near(const PointBox& box, double reach, const CellGridView& grid, const SortedView<n>& from) {
        using V = Pack<double>;
        ranges(grid, box, reach, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t k = first; k < last && all; k += lanes<double>)
                take(from, k, lane_bits((apart2(box, from(0, k), from(1, k), from(2, k)) < reach * reach) & lanes_before<V>(k, last)));
        });
    }
    BRISANCE_HD SortedView<n> view() {
        SortedView<n> v;
        for (int c = 0; c < n; ++c) {
            v.columns[c] = room[c];
            store(room[c] + count, Pack<double>{});  // what is read behind the last is a number
        }
        return v;
    }
};

}  // namespace brisance
