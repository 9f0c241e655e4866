// SPDX-License-Identifier: Apache-2.0
#include "app/leaks.h"

#include "math/kernel.h"
#include "math/pack.h"
#include "neighbours/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brisance {

namespace {

using V = Pack<double>;
constexpr int width = lanes<double>;

/// Where fluid may be near: wide cells over the box of a solid, marked where they or one of their neighbours hold fluid.
class Marks {
public:
    Marks(const double (&low)[3], const double (&high)[3], double cell, bool periodic) : cell_(cell) {
        for (int a = 0; a < 3; ++a) {
            low_[a] = low[a];
            n_[a] = a == 2 && periodic ? 1 : 1 + static_cast<std::int64_t>((high[a] - low[a]) / cell);
        }
        marked_.resize(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]));
    }
    void mark(double x, double y, double z) {
        const double p[3] = {x, y, z};
        std::int64_t from[3], to[3];
        for (int a = 0; a < 3; ++a) {
            const double q = std::floor((p[a] - low_[a]) / cell_);
            if (n_[a] > 1 && !(q >= -1 && q <= static_cast<double>(n_[a]))) return;
            const std::int64_t at = n_[a] > 1 ? static_cast<std::int64_t>(q) : 0;
            from[a] = std::max<std::int64_t>(at - 1, 0);
            to[a] = std::min(at + 1, n_[a] - 1);
        }
        for (std::int64_t k = from[2]; k <= to[2]; ++k)
            for (std::int64_t j = from[1]; j <= to[1]; ++j)
                for (std::int64_t i = from[0]; i <= to[0]; ++i) marked_[place(i, j, k)] = 1;
    }
    bool at(double x, double y, double z) const {
        const auto q = [&](double p, int a) { return n_[a] > 1 ? static_cast<std::int64_t>((p - low_[a]) / cell_) : 0; };
        return marked_[place(q(x, 0), q(y, 1), q(z, 2))] != 0;
    }

private:
    std::size_t place(std::int64_t i, std::int64_t j, std::int64_t k) const { return static_cast<std::size_t>((k * n_[1] + j) * n_[0] + i); }

    double low_[3], cell_;
    std::int64_t n_[3];
    std::vector<std::uint8_t> marked_;
};

/// The mass fraction of a solid: its particles near fluids, in the order of a grid, with a pack of room behind the last. Each solid has its own:
/// in one for all, a fine liner would be searched as far as the coarse rock behind it reaches.
class Colour {
public:
    template <class R>
    Colour(const SolidBody<R>& body, const World<R>& w) : hz_(1.2 * body.layout.dz), reach_(2 * hz_) {
        for (const Column& c : body.layout.columns) reach_ = std::max(reach_, 2.4 * c.spacing);
        double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
        each(body, [&](const Column&, const double (&p)[3]) {
            for (int a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], p[a]);
                high[a] = std::max(high[a], p[a]);
            }
        });
        if (low[0] > high[0]) return;
        Marks fluid(low, high, reach_, w.period > 0);
        for (const FluidPart& f : w.fluids)
            for (std::size_t i = 0; i < f.body.mass.size(); ++i) fluid.mark(f.body.x[0][i], f.body.x[1][i], f.body.x[2][i]);

        Array<double> at[3];
        std::vector<const Column*> column;
        each(body, [&](const Column& c, const double (&p)[3]) {
            if (!fluid.at(p[0], p[1], p[2])) return;
            for (std::size_t a = 0; a < 3; ++a) at[a].push_back(p[a]);
            column.push_back(&c);
        });
        grid_.build(at[0].data(), at[1].data(), at[2].data(), static_cast<std::int64_t>(column.size()), 0.5 * reach_, reach_, w.z_low, w.period);
        const auto entries = static_cast<std::size_t>(grid_.entries());
        for (auto* a : {&x_, &y_, &z_, &inverse_, &weight_}) a->resize(entries + width);
        for (std::size_t k = 0; k < entries; ++k) {
            const auto i = static_cast<std::size_t>(grid_.index(static_cast<std::int64_t>(k)));
            const double hx = 1.2 * column[i]->spacing;
            x_[k] = at[0][i];
            y_[k] = at[1][i];
            z_[k] = at[2][i] + grid_.shift(static_cast<std::int64_t>(k));
            inverse_[k] = 1 / (hx * hx);
            weight_[k] = body.volume(*column[i]) * kernel::sigma_3d / (hx * hx * hz_);
        }
    }

    double operator()(double x, double y, double z) const {
        V sum{};
        grid_.ranges(x, y, z, reach_, [&](std::int64_t first, std::int64_t last) {
            for (std::int64_t q = first; q < last; q += width) {
                const V dx = x - load<V>(&x_[static_cast<std::size_t>(q)]), dy = y - load<V>(&y_[static_cast<std::size_t>(q)]), dz = z - load<V>(&z_[static_cast<std::size_t>(q)]);
                const V q2 = (dx * dx + dy * dy) * load<V>(&inverse_[static_cast<std::size_t>(q)]) + dz * dz * (1 / (hz_ * hz_));
                sum += lanes_before<V>(q, last) ? load<V>(&weight_[static_cast<std::size_t>(q)]) * kernel::shape(vsqrt(q2)) : V{};
            }
        });
        return hsum(sum);
    }

private:
    /// f(column, place) for every particle.
    template <class R, class F>
    static void each(const SolidBody<R>& body, F&& f) {
        for (const Column& c : body.layout.columns)
            for (int k = 0; k < c.layers; ++k) {
                const auto i = static_cast<std::size_t>(c.start + k);
                if (!(body.layout.flags[i] & slot_own)) continue;
                f(c, {c.x + static_cast<double>(body.u[0][i]), c.y + static_cast<double>(body.u[1][i]), c.z0 + k * body.layout.dz + static_cast<double>(body.u[2][i])});
            }
    }

    double hz_, reach_;
    CellGrid grid_;
    Array<double> x_, y_, z_, inverse_, weight_;
};

}  // namespace

template <class R>
Leaks find_leaks(const World<R>& w) {
    if (w.fluids.empty()) return {};
    std::vector<Colour> solids;
    solids.reserve(w.solids.size());
    for (const SolidPart<R>& s : w.solids) solids.emplace_back(s.body, w);
    Leaks leaks;
    for (std::size_t part = 0; part < w.fluids.size(); ++part) {
        const FluidBody& f = w.fluids[part].body;
        std::vector<std::uint8_t> leaked(f.mass.size());
        exec::for_each(f.size(), [&](std::int64_t n) {
            const auto i = static_cast<std::size_t>(n);
            double all = 0, most = 0;
            for (const Colour& solid : solids) {
                const double colour = solid(f.x[0][i], f.x[1][i], f.x[2][i]);
                all += colour;
                most = std::max(most, colour);
            }
            // In one solid: at its wall the colour is a half. Between two: it is one; at a liner's inner wall a coarse rock behind it adds up to a third.
            leaked[i] = most > 0.6 || all > 0.85;
        });
        const std::int64_t count = std::count(leaked.begin(), leaked.end(), 1);
        if (count > 0 && leaks.count == 0) {
            leaks.part = part;
            leaks.particle = static_cast<std::size_t>(std::find(leaked.begin(), leaked.end(), 1) - leaked.begin());
        }
        leaks.count += count;
    }
    return leaks;
}

template Leaks find_leaks(const World<double>&);
template Leaks find_leaks(const World<float>&);

}  // namespace brisance
