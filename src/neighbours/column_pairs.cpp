// SPDX-License-Identifier: Apache-2.0
#include "neighbours/column_pairs.h"

#include "math/kernel.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

/// Columns by square cell of the section.
class SectionGrid {
public:
    SectionGrid(const Array<Column>& columns, double cell) : cell_(cell) {
        min_x_ = min_y_ = 1e300;
        double max_x = -1e300, max_y = -1e300;
        for (const Column& c : columns) {
            min_x_ = std::min(min_x_, c.x);
            min_y_ = std::min(min_y_, c.y);
            max_x = std::max(max_x, c.x);
            max_y = std::max(max_y, c.y);
        }
        nx_ = 1 + static_cast<int>((max_x - min_x_) / cell);
        ny_ = 1 + static_cast<int>((max_y - min_y_) / cell);
        cells_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
        for (std::size_t i = 0; i < columns.size(); ++i) at(column_of(columns[i].x), row_of(columns[i].y)).push_back(static_cast<int>(i));
    }
    template <class F> void near(double x, double y, F&& f) const {
        for (int j = std::max(row_of(y) - 1, 0); j <= std::min(row_of(y) + 1, ny_ - 1); ++j)
            for (int i = std::max(column_of(x) - 1, 0); i <= std::min(column_of(x) + 1, nx_ - 1); ++i)
                for (int k : cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i)]) f(k);
    }

private:
    int column_of(double x) const { return static_cast<int>((x - min_x_) / cell_); }
    int row_of(double y) const { return static_cast<int>((y - min_y_) / cell_); }
    std::vector<int>& at(int i, int j) { return cells_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(i)]; }
    double cell_, min_x_, min_y_;
    int nx_, ny_;
    std::vector<std::vector<int>> cells_;
};

}  // namespace

int largest_offset(double smoothing) { return static_cast<int>(std::ceil(2 * smoothing)); }

template <class R>
ColumnPairs<R> find_column_pairs(Columns& body, double smoothing) {
    const Array<Column>& columns = body.columns;
    const double h_z = smoothing * body.dz;
    double largest = 0;
    for (const Column& c : columns) largest = std::max(largest, c.spacing);
    const SectionGrid grid(columns, 2 * smoothing * largest * 1.0001);

    ColumnPairs<R> out;
    out.begin.push_back(0);
    std::size_t bonds = 0;
    std::vector<int> candidates;
    for (std::size_t a = 0; a < columns.size(); ++a) {
        const Column& ca = columns[a];
        candidates.clear();
        grid.near(ca.x, ca.y, [&](int b) { candidates.push_back(b); });
        std::sort(candidates.begin(), candidates.end());  // a fixed order of summation
        Sym3<double> K{};
        Vec3<double> g{};
        const auto add = [&](int b, int first, int last) {
            // offsets first ... last of layers, those inside the support
            const Column& cb = columns[static_cast<std::size_t>(b)];
            const double dx = cb.x - ca.x, dy = cb.y - ca.y;
            const double h_xy = 0.5 * smoothing * (ca.spacing + cb.spacing);
            const double h = std::cbrt(h_xy * h_xy * h_z);
            const double volume = cb.area * body.dz;
            ColumnPair<R> pair{};
            pair.dx = static_cast<R>(dx);
            pair.dy = static_cast<R>(dy);
            pair.h = static_cast<R>(std::min(h_xy, h_z));
            pair.weights = static_cast<std::int32_t>(out.w.size());
            for (int o = first; o <= last; ++o) {
                const double z = cb.z0 - ca.z0 + o * body.dz;
                const double q = std::sqrt((dx * dx + dy * dy) / (h_xy * h_xy) + z * z / (h_z * h_z));
                if (q >= 2) continue;
                const double w = volume * kernel::sigma_3d / std::pow(h, 5) * kernel::bond(q);
                if (pair.count == 0) {
                    pair.shift = cb.start - ca.start + o;
                    pair.z_first = static_cast<R>(z);
                }
                ++pair.count;
                out.w.push_back(static_cast<R>(w));
                K.xx += w * dx * dx;
                K.yy += w * dy * dy;
                K.zz += w * z * z;
                K.xy += w * dx * dy;
                K.xz += w * dx * z;
                K.yz += w * dy * z;
                g = g + w * Vec3<double>{dx, dy, z};
            }
            if (pair.count == 0) return;
            bonds += static_cast<std::size_t>(pair.count);
            out.pairs.push_back(pair);
        };
        const int reach = body.pad;
        for (int b : candidates) {
            if (static_cast<std::size_t>(b) == a) {
                add(b, -reach, -1);
                add(b, 1, reach);
            } else {
                add(b, -reach, reach);
            }
        }
        out.begin.push_back(static_cast<std::int64_t>(out.pairs.size()));
        const Sym3<double> ki = inverse(K);
        out.k_inverse.insert(out.k_inverse.end(), {ki.xx, ki.yy, ki.zz, ki.xy, ki.xz, ki.yz});
        out.g_sum.insert(out.g_sum.end(), {g.x, g.y, g.z});
    }
    out.bonds_per_particle = static_cast<double>(bonds) / static_cast<double>(std::max<std::size_t>(columns.size(), 1));

    // A tile is whole when every slot that its lanes can reach holds a particle. Periodic images count: they are filled in later.
    if (body.periodic) {
        for (Tile& t : body.tiles) t.masked = false;
    } else {
        for (Tile& t : body.tiles) {
            t.masked = false;
            const std::size_t a = static_cast<std::size_t>(t.column);
            for (std::int64_t p = out.begin[a]; p < out.begin[a + 1] && !t.masked; ++p) {
                const ColumnPair<R>& pair = out.pairs[static_cast<std::size_t>(p)];
                for (std::int64_t j = t.base + pair.shift; j < t.base + pair.shift + body.width + pair.count - 1; ++j)
                    if (!(body.flags[static_cast<std::size_t>(j)] & slot_own)) {
                        t.masked = true;
                        break;
                    }
            }
        }
    }
    return out;
}

template ColumnPairs<double> find_column_pairs(Columns&, double);
template ColumnPairs<float> find_column_pairs(Columns&, double);

}  // namespace brisance
