// SPDX-License-Identifier: Apache-2.0
// A bucket grid over points of a plane, for questions of the kind "who is within this distance".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace brisance::analysis {

class PointGrid {
public:
    /// x, y: coordinates, mm, which must outlive the grid. cell: edge of a bucket, mm; any positive value gives right answers.
    PointGrid(std::span<const double> x, std::span<const double> y, double cell) : x_(x), y_(y), cell_(cell) {
        if (x.empty()) return;
        x_0_ = *std::min_element(x.begin(), x.end());
        y_0_ = *std::min_element(y.begin(), y.end());
        nx_ = column(*std::max_element(x.begin(), x.end()), x_0_) + 1;
        ny_ = column(*std::max_element(y.begin(), y.end()), y_0_) + 1;
        first_.assign(static_cast<std::size_t>(nx_ * ny_) + 1, 0);
        for (std::size_t i = 0; i < x.size(); ++i) ++first_[bucket(i) + 1];
        for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
        members_.resize(x.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < x.size(); ++i) members_[next[bucket(i)]++] = i;
    }

    /// Calls visit(j) for each point j with |x_j - (x, y)| <= distance, in a fixed order.
    template <class Visit>
    void near(double x, double y, double distance, Visit visit) const {
        if (x_.empty()) return;
        const long from = std::max(0L, column(x - distance, x_0_)), to = std::min(nx_ - 1, column(x + distance, x_0_));
        for (long iy = std::max(0L, column(y - distance, y_0_)); iy <= std::min(ny_ - 1, column(y + distance, y_0_)); ++iy)
            for (long ix = from; ix <= to; ++ix) {
                const auto b = static_cast<std::size_t>(iy * nx_ + ix);
                for (std::size_t k = first_[b]; k < first_[b + 1]; ++k) {
                    const std::size_t j = members_[k];
                    const double dx = x_[j] - x, dy = y_[j] - y;
                    if (dx * dx + dy * dy <= distance * distance) visit(j);
                }
            }
    }

private:
    long column(double value, double origin) const { return static_cast<long>(std::floor((value - origin) / cell_)); }
    std::size_t bucket(std::size_t i) const { return static_cast<std::size_t>(column(y_[i], y_0_) * nx_ + column(x_[i], x_0_)); }

    std::span<const double> x_, y_;
    double cell_, x_0_ = 0, y_0_ = 0;
    long nx_ = 0, ny_ = 0;
    std::vector<std::size_t> first_, members_;
};

}  // namespace brisance::analysis
