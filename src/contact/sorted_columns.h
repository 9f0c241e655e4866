// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exec/launch.h"
#include "math/pack.h"

#include <array>

namespace brisance {

/// Columns of numbers in the order of a grid's entries, with a pack of room behind the last.
template <int n>
struct SortedView {
    double* columns[n];
    BRISANCE_HD Pack<double> operator()(int c, std::int64_t k) const { return load<Pack<double>>(columns[c] + k); }
    BRISANCE_HD void put(std::int64_t k, const double (&row)[n]) const {
        for (int c = 0; c < n; ++c) columns[c][k] = row[c];
    }
};
template <int n>
class Sorted {
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

}  // namespace brisance
