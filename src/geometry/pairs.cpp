// SPDX-License-Identifier: Apache-2.0
#include "geometry/pairs.h"

#include <algorithm>
#include <cmath>

namespace brisance {
namespace {

/// The points of one octave of spacings, sorted into square cells of half the range of the largest of them.
class Octave {
public:
    Octave(const std::vector<Vec2>& points, const std::vector<double>& spacing, const std::vector<std::uint32_t>& members, double range) {
        min_ = points[members.front()];
        Vec2 max = min_;
        for (const std::uint32_t i : members) {
            min_ = {std::min(min_.x, points[i].x), std::min(min_.y, points[i].y)};
            max = {std::max(max.x, points[i].x), std::max(max.y, points[i].y)};
            largest_ = std::max(largest_, spacing[i]);
        }
        cell_ = 0.5 * range * largest_;
        columns_ = cell_of(max.x - min_.x) + 1;
        rows_ = cell_of(max.y - min_.y) + 1;
        begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        const auto cell_of_point = [&](std::uint32_t i) {
            return static_cast<std::size_t>(cell_of(points[i].y - min_.y) * columns_ + cell_of(points[i].x - min_.x));
        };
        for (const std::uint32_t i : members) ++begin_[cell_of_point(i) + 1];
        for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
        std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
        sorted_.resize(members.size());
        for (const std::uint32_t i : members) sorted_[at[cell_of_point(i)]++] = {points[i], spacing[i], i};
    }

    template <class Found>
    void search(Vec2 p, double spacing, std::uint32_t self, double range, Found found) const {
        const double reach = 0.5 * range * (spacing + largest_);
        const auto i0 = std::max(0L, cell_of(p.x - reach - min_.x)), i1 = std::min(columns_ - 1, cell_of(p.x + reach - min_.x));
        const auto j0 = std::max(0L, cell_of(p.y - reach - min_.y)), j1 = std::min(rows_ - 1, cell_of(p.y + reach - min_.y));
        if (i0 > i1) return;
        for (long j = j0; j <= j1; ++j) {
            const std::size_t from = begin_[static_cast<std::size_t>(j * columns_ + i0)];
            const std::size_t to = begin_[static_cast<std::size_t>(j * columns_ + i1) + 1];
            for (std::size_t k = from; k < to; ++k) {
                const Entry& e = sorted_[k];
                const Vec2 d = e.p - p;
                const double limit = 0.5 * range * (spacing + e.spacing);
                if (dot(d, d) < limit * limit && e.index != self) found(e.index);
            }
        }
    }

private:
    struct Entry {
        Vec2 p;
        double spacing;
        std::uint32_t index;
    };
    long cell_of(double length) const { return static_cast<long>(std::floor(length / cell_)); }

    Vec2 min_;
    double cell_ = 0, largest_ = 0;
    long columns_ = 0, rows_ = 0;
    std::vector<std::size_t> begin_;
    std::vector<Entry> sorted_;
};

}  // namespace

Pairs find_pairs(const std::vector<Vec2>& points, const std::vector<double>& spacing, double range) {
    Pairs pairs;
    pairs.begin.assign(points.size() + 1, 0);
    if (points.empty()) return pairs;

    const double least = *std::min_element(spacing.begin(), spacing.end());
    std::vector<std::vector<std::uint32_t>> members;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto octave = static_cast<std::size_t>(std::log2(spacing[i] / least));
        if (octave >= members.size()) members.resize(octave + 1);
        members[octave].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<Octave> octaves;
    for (const auto& m : members) {
        if (!m.empty()) octaves.emplace_back(points, spacing, m, range);
    }

    const auto search = [&](std::size_t i, auto found) {
        for (const Octave& octave : octaves) octave.search(points[i], spacing[i], static_cast<std::uint32_t>(i), range, found);
    };
#pragma omp parallel for schedule(static) if (points.size() > worth_threads)
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t count = 0;
        search(i, [&](std::uint32_t) { ++count; });
        pairs.begin[i + 1] = count;
    }
    for (std::size_t i = 0; i < points.size(); ++i) pairs.begin[i + 1] += pairs.begin[i];
    pairs.neighbour.resize(pairs.begin.back());
#pragma omp parallel for schedule(static) if (points.size() > worth_threads)
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t at = pairs.begin[i];
        search(i, [&](std::uint32_t j) { pairs.neighbour[at++] = j; });
    }
    return pairs;
}

}  // namespace brisance
