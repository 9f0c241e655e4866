// SPDX-License-Identifier: Apache-2.0
#include "neighbours/cell_grid.h"

#include "neighbours/box.h"

#include <algorithm>

namespace brisance {

namespace {

struct BoxKernel {
    UnsortedPoints raw;
    BRISANCE_HD PointBox operator()(std::int64_t k) const {
        const Vec3<double> p = raw.place(k);
        return box_of(p.x, p.y, p.z);
    }
};

struct CellKernel {
    UnsortedPoints raw;
    CellGridView grid;
    std::int32_t* cell_of;
    BRISANCE_HD void operator()(std::int64_t k) const {
        const UnsortedPoints::Cell c = raw.cell(grid, k);
        cell_of[k] = static_cast<std::int32_t>(grid.row(c.y, c.z) + c.x);
    }
};

struct OrderKernel {
    UnsortedPoints raw;
    const std::int32_t* order;
    std::int32_t* index;
    double* shift;
    BRISANCE_HD void operator()(std::int64_t k) const {
        index[k] = raw.point(order[k]);
        shift[k] = raw.shifted(order[k]);
    }
};

}  // namespace

void CellGrid::build(const double* x, const double* y, const double* z, std::int64_t n, double cell, double reach, double z_low, double period, bool full) {
    UnsortedPoints raw{x, y, z, nullptr, nullptr};
    std::int64_t entries = n;
    if (period > 0) {
        const int images = 1 + static_cast<int>(reach / period);
        for (std::int64_t room = n + n / 2 + 64;; room = entries) {  // more than enough, or what the first try has counted
            make_room(raw_index_, static_cast<std::size_t>(room));
            make_room(raw_shift_, static_cast<std::size_t>(room));
            std::int32_t* const index = raw_index_.data();
            double* const shift = raw_shift_.data();
            room = static_cast<std::int64_t>(std::min(raw_index_.size(), raw_shift_.size()));
            exec::launch(n, BRISANCE_KERNEL(std::int64_t i) {
                index[i] = static_cast<std::int32_t>(i);
                shift[i] = 0;
            }, 1024);
            entries = n;
            for (int s = -images; s <= images; ++s) {
                if (s == 0) continue;
                const double by = s * period;
                const std::int64_t ahead = entries;
                entries += exec::select(n, BRISANCE_KERNEL(std::int64_t i) {
                    const double zi = z[i] + by;
                    return !(zi < z_low - reach || zi > z_low + period + reach);
                }, BRISANCE_KERNEL(std::int64_t i, std::int64_t k) {
                    if (ahead + k >= room) return;
                    index[ahead + k] = static_cast<std::int32_t>(i);
                    shift[ahead + k] = by;
                });
            }
            if (entries <= room) break;
        }
        raw.index = raw_index_.data();
        raw.shift = raw_shift_.data();
    }
    const PointBox box = exec::launch_sum(entries, PointBox{}, BoxKernel{raw});
    CellGridView& g = view_;
    g.entries = entries;
    g.rows = nullptr;
    const auto size = static_cast<std::size_t>(entries);
    for (auto* a : {&order_, &index_}) make_room(*a, size);
    make_room(shift_, size);
    g.index = index_.data();
    g.shift = shift_.data();
    // at most some cells per entry: in a full grid, else in a sparse one, else they grow
    const double most = 16.0 * static_cast<double>(entries) + 4096;
    for (g.cell = cell;; g.cell *= 1.5) {
        double count = 1;
        for (int a = 0; a < 3; ++a) {
            g.min[a] = box.min[a];
            g.n[a] = entries == 0 ? 1 : 1 + static_cast<int>(std::min((box.max[a] - box.min[a]) / g.cell, 1e6));
            count *= g.n[a];
        }
        if (count <= most) return sort_all(raw);
        if (!full && sparse_.build(g, raw, most, order_.data(), index_.data(), shift_.data())) return;
    }
}

void CellGrid::sort_all(const UnsortedPoints& raw) {
    CellGridView& g = view_;
    make_room(begin_, static_cast<std::size_t>(g.cells()) + 1);
    make_room(cell_of_, static_cast<std::size_t>(g.entries));
    exec::launch(g.entries, CellKernel{raw, g, cell_of_.data()}, 1024);
    exec::bucket_sort(cell_of_.data(), g.entries, g.cells(), order_.data(), begin_.data());
    exec::launch(g.entries, OrderKernel{raw, order_.data(), index_.data(), shift_.data()}, 1024);
    g.begin = begin_.data();
    g.beginnings = g.cells() + 1;
}

}  // namespace brisance
