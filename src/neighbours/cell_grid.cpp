// SPDX-License-Identifier: Apache-2.0
#include "neighbours/cell_grid.h"

#include <algorithm>
#include <cmath>

namespace brisance {

void CellGrid::build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low, double period) {
    raw_index_.clear();
    raw_shift_.clear();
    for (std::int64_t i = 0; i < n; ++i) {
        raw_index_.push_back(static_cast<std::int32_t>(i));
        raw_shift_.push_back(0);
    }
    if (period > 0) {
        const int images = 1 + static_cast<int>(reach / period);
        for (int s = -images; s <= images; ++s) {
            if (s == 0) continue;
            for (std::int64_t i = 0; i < n; ++i) {
                const double zi = z[i] + s * period;
                if (zi < z_low - reach || zi > z_low + period + reach) continue;
                raw_index_.push_back(static_cast<std::int32_t>(i));
                raw_shift_.push_back(s * period);
            }
        }
    }
    const std::size_t entries = raw_index_.size();
    std::array<double, 3> max{-1e300, -1e300, -1e300};
    min_ = {1e300, 1e300, 1e300};
    for (std::size_t k = 0; k < entries; ++k) {
        const auto i = static_cast<std::size_t>(raw_index_[k]);
        const double p[3] = {x[i], y[i], z[i] + raw_shift_[k]};
        for (std::size_t a = 0; a < 3; ++a) {
            min_[a] = std::min(min_[a], p[a]);
            max[a] = std::max(max[a], p[a]);
        }
    }
    // A particle flung far out must not cost memory: cells grow until there are at most some per entry.
    cell_ = cell;
    double count = 0;
    for (;;) {
        count = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            n_[a] = entries == 0 ? 1 : 1 + static_cast<int>(std::min((max[a] - min_[a]) / cell_, 1e6));
            count *= n_[a];
        }
        if (count <= 64.0 * static_cast<double>(entries) + 4096) break;
        cell_ *= 1.5;
    }
    begin_.assign(static_cast<std::size_t>(count) + 1, 0);
    cell_of_.resize(entries);
    for (std::size_t k = 0; k < entries; ++k) {
        const auto i = static_cast<std::size_t>(raw_index_[k]);
        const int cx = clamp(x[i], 0), cy = clamp(y[i], 1), cz = clamp(z[i] + raw_shift_[k], 2);
        cell_of_[k] = static_cast<std::int32_t>((static_cast<std::int64_t>(cz) * n_[1] + cy) * n_[0] + cx);
        ++begin_[static_cast<std::size_t>(cell_of_[k]) + 1];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    index_.resize(entries);
    shift_.resize(entries);
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < entries; ++k) {
        const auto slot = static_cast<std::size_t>(next[static_cast<std::size_t>(cell_of_[k])]++);
        index_[slot] = raw_index_[k];
        shift_[slot] = raw_shift_[k];
    }
}

}  // namespace brisance
