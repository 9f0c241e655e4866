// SPDX-License-Identifier: Apache-2.0
// What the tests of the numerical core share: materials, solids on lattices that may close upon themselves, clouds of columns, marching a
// single body, fluids in boxes that repeat across, and sums.
#pragma once

#include "integrate/world.h"
#include "law_helpers.h"
#include "math/eigen.h"
#include "particles/periodic_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace brisance::core_test {

using law_test::library;
using law_test::operator-;
using law_test::Random;
inline constexpr double pi = std::numbers::pi;

// ---- materials

inline LawData law(const std::string& name, const std::vector<std::tuple<std::string, double, Dimension>>& values) {
    LawData data{name, "test.toml:1:1", {}};
    for (const auto& [key, value, dimension] : values) data.parameters[key] = {value, dimension, std::to_string(value), "test", "c", "test.toml:2:1"};
    return data;
}
/// Barre granite without yield and with a linear equation of state: c_p = 4543.03 m/s, c_s = 2869.33 m/s, rho = 2.66 g/cm3.
inline Material elastic_granite() {
    MaterialData data = read_material("barre_granite");
    data.strength = law("elastic", {{"G", 21.9, dimension::pressure}});
    law_test::set(data.eos, {{"K2", 0}, {"K3", 0}});
    return make_material(data);
}
inline Material ideal_gas(double gamma, double density, double energy) {
    MaterialData data = read_material("water");
    data.name = "gas";
    data.density.value = density;
    data.eos = law("ideal_gas", {{"gamma", gamma, dimension::none}, {"E0", energy, dimension::pressure}});
    return make_material(data);
}
/// A solid that is all equation of state: its waves are those of the fluid.
inline Material without_strength(const std::string& name, double density) {
    MaterialData data = read_material(name);
    if (density > 0) data.density.value = density;
    data.strength = law("elastic", {{"G", 0.0, dimension::pressure}});
    return make_material(data);
}

// ---- solids

/// A solid from columns that have no slots yet. All columns have the same number of layers.
template <class R = double, class Present>
SolidPart<R> solid(const Material& material, const SolidOptions& options, std::vector<Column> columns, double dz, bool periodic, Present&& present) {
    SolidPart<R> s;
    s.body.name = "solid";
    s.body.material = material;
    s.body.options = options;
    Columns& layout = s.body.layout;
    layout.columns.assign(columns.begin(), columns.end());
    layout.dz = dz;
    layout.z_low = 1e300;
    for (const Column& c : columns) layout.z_low = std::min(layout.z_low, c.z0 - 0.5 * dz);
    layout.periodic = periodic;
    layout.width = tile_width<R>;
    layout.pad = largest_offset(options.smoothing);
    lay_out(layout, present);
    allocate(s.body);
    complete(s.body);
    s.pairs = find_column_pairs<R>(layout, options.smoothing);
    s.surface = make_surface(s.body);
    return s;
}
template <class R = double>
SolidPart<R> solid(const Material& material, const SolidOptions& options, std::vector<Column> columns, double dz, bool periodic) {
    return solid<R>(material, options, std::move(columns), dz, periodic, [](const Column&, int) { return true; });
}

struct Lattice {
    int nx = 6, ny = 6, layers = 8;
    double spacing = 1, dz = 1;
    bool wrap_x = false, wrap_y = false, periodic = false;  ///< closed in x, y, z
    double x = 0, y = 0, z = 0;                             ///< of the lower corner of the box, half a spacing before the first particle
};

/// Columns of a square lattice, with walls on its open sides.
inline std::vector<Column> lattice_columns(const Lattice& l) {
    std::vector<Column> columns;
    for (int i = 0; i < l.nx; ++i)
        for (int j = 0; j < l.ny; ++j) {
            Column c;
            c.x = l.x + (i + 0.5) * l.spacing;
            c.y = l.y + (j + 0.5) * l.spacing;
            c.z0 = l.z + 0.5 * l.dz;
            c.area = l.spacing * l.spacing;
            c.spacing = l.spacing;
            c.layers = l.layers;
            const bool x_end = !l.wrap_x && (i == 0 || i == l.nx - 1), y_end = !l.wrap_y && (j == 0 || j == l.ny - 1);
            if (x_end || y_end) {
                c.wall_layer = 0;
                c.wall_length = l.spacing;
                c.wall_distance = 0.5 * l.spacing;
                (x_end ? c.wall_normal_x : c.wall_normal_y) = (x_end ? i : j) == 0 ? -1 : 1;
            }
            columns.push_back(c);
        }
    return columns;
}

/// A block on a square lattice. Where it wraps in x or y, the bonds of the middle column of an open lattice are closed upon it.
template <class R = double>
SolidPart<R> block(const Material& material, const SolidOptions& options, const Lattice& l) {
    SolidPart<R> s = solid<R>(material, options, lattice_columns(l), l.dz, l.periodic);
    if (!l.wrap_x && !l.wrap_y) return s;
    const int m = static_cast<int>(std::ceil(2 * options.smoothing)) + 1, n = 2 * m + 1;
    Lattice open{n, n, l.layers, l.spacing, l.dz, false, false, l.periodic};
    const SolidPart<R> prototype = solid<R>(material, options, lattice_columns(open), l.dz, l.periodic);
    const auto middle = static_cast<std::size_t>(m * n + m);
    ColumnPairs<R>& pairs = s.pairs;
    pairs = {};
    pairs.w = prototype.pairs.w;
    pairs.begin.push_back(0);
    const Array<Column>& columns = s.body.layout.columns;
    for (int i = 0; i < l.nx; ++i)
        for (int j = 0; j < l.ny; ++j) {
            const Column& me = columns[static_cast<std::size_t>(i * l.ny + j)];
            Sym3<double> K{};
            Vec3<double> g{};
            for (std::int64_t p = prototype.pairs.begin[middle]; p < prototype.pairs.begin[middle + 1]; ++p) {
                ColumnPair<R> pair = prototype.pairs.pairs[static_cast<std::size_t>(p)];
                int oi = i + static_cast<int>(std::lround(static_cast<double>(pair.dx) / l.spacing));
                int oj = j + static_cast<int>(std::lround(static_cast<double>(pair.dy) / l.spacing));
                if (l.wrap_x) oi = ((oi % l.nx) + l.nx) % l.nx;
                if (l.wrap_y) oj = ((oj % l.ny) + l.ny) % l.ny;
                if (oi < 0 || oi >= l.nx || oj < 0 || oj >= l.ny) continue;
                pair.shift = columns[static_cast<std::size_t>(oi * l.ny + oj)].start - me.start + std::lround(static_cast<double>(pair.z_first) / l.dz);
                pairs.pairs.push_back(pair);
                for (int o = 0; o < pair.count; ++o) {
                    const double w = static_cast<double>(pairs.w[static_cast<std::size_t>(pair.weights + o)]);
                    const Vec3<double> xi{static_cast<double>(pair.dx), static_cast<double>(pair.dy), static_cast<double>(pair.z_first) + o * l.dz};
                    K = {K.xx + w * xi.x * xi.x, K.yy + w * xi.y * xi.y, K.zz + w * xi.z * xi.z, K.xy + w * xi.x * xi.y, K.xz + w * xi.x * xi.z, K.yz + w * xi.y * xi.z};
                    g = g + w * xi;
                }
            }
            pairs.begin.push_back(static_cast<std::int64_t>(pairs.pairs.size()));
            const Sym3<double> inv = inverse(K);
            pairs.k_inverse.insert(pairs.k_inverse.end(), {inv.xx, inv.yy, inv.zz, inv.xy, inv.xz, inv.yz});
            pairs.g_sum.insert(pairs.g_sum.end(), {g.x, g.y, g.z});
        }
    return s;
}

/// Calls f(slot, column, reference position) for every particle.
template <class R, class F>
void each(const SolidBody<R>& b, F&& f) {
    for (const Column& c : b.layout.columns)
        for (int k = 0; k < c.layers; ++k) {
            const auto slot = static_cast<std::size_t>(c.start + k);
            if (b.layout.flags[slot] & slot_own) f(slot, c, Vec3<double>{c.x, c.y, c.z0 + k * b.layout.dz});
        }
}
/// u = f(X), or v = f(X).
template <class R, class F>
void set_field(const SolidBody<R>& b, std::array<Array<R>, 3>& field, F&& f) {
    each(b, [&](std::size_t i, const Column&, Vec3<double> x) {
        const Vec3<double> value = f(x);
        field[0][i] = static_cast<R>(value.x);
        field[1][i] = static_cast<R>(value.y);
        field[2][i] = static_cast<R>(value.z);
    });
    fill_images(b.layout, field);
}

/// Steps of one body that nothing touches, in the order of integrate/step.cpp.
template <class R>
class March {
public:
    explicit March(SolidPart<R>& part) : part_(part) {
        if (part.body.options.pairwise) {
            part.body.v_now = part.body.v;
            fill_images(part.body.layout, part.body.v_now);
        }
    }
    void operator()(double dt) {
        const double kick_time = 0.5 * (last_ + dt);
        viscous += kick(part_.body, part_.pairs, kick_time);
        drift(part_.body, dt, kick_time);
        time += dt;
        report = stress(part_.body, part_.pairs, time, dt, kick_time);
        viscous += report.bulk_viscous;
        last_ = dt;
    }
    double time = 0, viscous = 0;
    StressReport report;

private:
    SolidPart<R>& part_;
    double last_ = 0;
};

/// Cauchy deviators by slot, GPa.
template <class R>
std::vector<Sym3<double>> deviators(const SolidPart<R>& part) {
    const Columns& layout = part.body.layout;
    std::vector<Sym3<double>> s(static_cast<std::size_t>(layout.slots));
    for (const Tile& t : layout.tiles) deviators(part.body, part.pairs, t, s.data() + t.base);
    return s;
}

/// sum x (x) m v about the origin.
template <class R>
Vec3<double> angular_momentum(const SolidBody<R>& b) {
    Vec3<double> sum;
    each(b, [&](std::size_t i, const Column& c, Vec3<double> x) {
        const Vec3<double> at{x.x + static_cast<double>(b.u[0][i]), x.y + static_cast<double>(b.u[1][i]), x.z + static_cast<double>(b.u[2][i])};
        sum = sum + b.mass(c) * cross(at, Vec3<double>{static_cast<double>(b.v[0][i]), static_cast<double>(b.v[1][i]), static_cast<double>(b.v[2][i])});
    });
    return sum;
}

/// The forces per mass of a displacement field on a body without history, by the passes themselves.
template <class R>
void respond_to(SolidPart<R>& s, StressReport* report = nullptr) {
    SolidBody<R>& b = s.body;
    for (auto& a : b.R_sum) std::fill(a.begin(), a.end(), R(0));
    for (auto& a : b.T) std::fill(a.begin(), a.end(), R(0));
    for (auto& a : b.v) std::fill(a.begin(), a.end(), R(0));
    std::fill(b.energy.begin(), b.energy.end(), R(b.material.eos->initial_energy()));
    std::fill(b.power.begin(), b.power.end(), R(0));
    fill_images(b.layout, b.u);
    const StressReport r = stress(b, s.pairs, 0, 1, 0);
    if (report) *report = r;
    kick(b, s.pairs, 1);
}

// ---- fluids

struct FluidBox {
    double spacing = 1;
    int nx = 10, ny = 10, nz = 1;
    double x = 0, y = 0, z = 0;     ///< lower corner
    bool periodic = true;           ///< along z
};
inline FluidPart fluid(const Material& material, const FluidOptions& options, const FluidBox& box) {
    FluidPart f;
    FluidBody& b = f.body;
    b.name = "fluid";
    b.material = material;
    b.options = options;
    b.spacing = box.spacing;
    b.z_low = box.z;
    b.period = box.periodic ? box.nz * box.spacing : 0;
    resize(b, static_cast<std::size_t>(box.nx) * static_cast<std::size_t>(box.ny) * static_cast<std::size_t>(box.nz));
    std::size_t n = 0;
    for (int i = 0; i < box.nx; ++i)
        for (int j = 0; j < box.ny; ++j)
            for (int k = 0; k < box.nz; ++k, ++n) {
                b.x[0][n] = box.x + (i + 0.5) * box.spacing;
                b.x[1][n] = box.y + (j + 0.5) * box.spacing;
                b.x[2][n] = box.z + (k + 0.5) * box.spacing;
                b.mass[n] = material.density * std::pow(box.spacing, 3);
                b.rho[n] = material.density;
                b.e[n] = material.eos->initial_energy() / material.density;
            }
    b.reference = b.x;
    return f;
}

/// The state of the start as contact takes it.
inline void make_ready(FluidPart& f) {
    f.body.v_now = f.body.v;
    f.body.rho_now = f.body.rho;
    f.body.e_now = f.body.e;
    f.solver.state(f.body, 0);
    f.forces.begin(f.body);
}
/// Water whose particles have been moved by up to `size` mm and given up to `speed` km/s each way, at random.
inline FluidPart disturbed_water(const FluidBox& box, double size, std::uint64_t seed, double speed = 0.2) {
    FluidPart f = fluid(library("water"), {}, box);
    Random random(seed);
    for (std::size_t i = 0; i < f.body.mass.size(); ++i)
        for (std::size_t a = 0; a < 3; ++a) {
            f.body.x[a][i] += random.uniform(-size, size);
            f.body.v[a][i] = random.uniform(-speed, speed);
        }
    if (f.body.period > 0)
        for (double& z : f.body.x[2]) z -= f.body.period * std::floor((z - f.body.z_low) / f.body.period);
    make_ready(f);
    return f;
}

/// A fluid that repeats in y as well: real particles in one period and copies of them beside it, which take over the state of their
/// originals after every step. Nothing but the passes of the solver is used.
class Tube {
public:
    /// `body` holds the real particles, 0 <= y < period; neighbours stand within `reach`. Copies reach twice as far: the correction of a
    /// copy's gradients asks for the copy's own neighbours.
    Tube(FluidBody body, double period, double reach) : real_(static_cast<std::size_t>(body.size())), b(std::move(body)) {
        const int images = static_cast<int>(std::ceil(2 * reach / period));
        const FluidBody one = b;
        resize(b, real_ * static_cast<std::size_t>(2 * images + 1));
        for (int image = 0; image <= 2 * images; ++image) {
            const double shift = (image == 0 ? 0 : (image % 2 ? (image + 1) / 2 : -image / 2)) * period;
            for (std::size_t i = 0; i < real_; ++i) {
                const std::size_t k = static_cast<std::size_t>(image) * real_ + i;
                of_.push_back(i);
                shift_.push_back(shift);
                b.mass[k] = one.mass[i];
                b.lit[k] = one.lit[i];
                for (std::size_t a = 0; a < 3; ++a) b.v[a][k] = one.v[a][i];
                for (std::size_t a = 0; a < 3; ++a) b.x[a][k] = one.x[a][i] + (a == 1 ? shift : 0);
                b.rho[k] = one.rho[i];
                b.e[k] = one.e[i];
            }
        }
        b.reference = b.x;
        b.v_now = b.v;
        b.rho_now = b.rho;
        b.e_now = b.e;
        f_.assign(b.mass.size(), 0);
        fx_ = f_;
        solver_.state(b, 0);
        solver_.rates(b);
    }
    std::size_t size() const { return real_; }
    /// Advances to `end` with steps of the Courant factor, no longer than `longest`.
    void run(double end, double courant, double longest = 1e300) {
        while (time < end) {
            double dt = std::min(courant / solver_.stable_rate(b), longest);
            if (last_ > 0) dt = std::min(dt, 1.05 * last_);
            dt = std::min(dt, end - time);
            step(dt);
            if (end - time < 1e-9 * dt) time = end;
        }
    }
    void step(double dt) {
        const double kick_time = 0.5 * (last_ + dt);
        std::fill(fx_.begin(), fx_.end(), 0);
        for (const Platen& p : platens) {
            FluidForces forces;
            forces.begin(b);
            press(p, b, forces);
            for (std::size_t i = 0; i < fx_.size(); ++i) fx_[i] += forces.fx[i];
        }
        for (std::size_t i = 0; i < real_; ++i) {
            impulse += kick_time * fx_[i];
            work += 0.5 * kick_time * fx_[i] * b.v[0][i];
        }
        solver_.kick(b, kick_time, fx_.data(), f_.data(), f_.data());
        for (std::size_t i = 0; i < real_; ++i) work += 0.5 * kick_time * fx_[i] * b.v[0][i];
        solver_.drift(b, dt);
        for (std::size_t k = real_; k < of_.size(); ++k) {
            const std::size_t i = of_[k];
            for (std::size_t a = 0; a < 3; ++a) {
                b.x[a][k] = b.x[a][i] + (a == 1 ? shift_[k] : 0);
                b.v[a][k] = b.v[a][i];
                b.v_now[a][k] = b.v_now[a][i];
            }
            b.rho[k] = b.rho[i];
            b.rho_now[k] = b.rho_now[i];
            b.e[k] = b.e[i];
            b.e_now[k] = b.e_now[i];
            b.burnt[k] = b.burnt[i];
        }
        time += dt;
        last_ = dt;
        ++steps;
        solver_.state(b, time);
        solver_.rates(b);
    }
    /// Kinetic and internal energy, momentum of the real particles.
    BodySums sums() const {
        BodySums s;
        for (std::size_t i = 0; i < real_; ++i) {
            const double m = b.mass[i];
            s.kinetic += 0.5 * m * (b.v[0][i] * b.v[0][i] + b.v[1][i] * b.v[1][i] + b.v[2][i] * b.v[2][i]);
            s.internal += m * b.e[i];
            s.px += m * b.v[0][i];
            s.py += m * b.v[1][i];
            s.pz += m * b.v[2][i];
        }
        return s;
    }
    /// Mean of f(i) over real particles with low < x < high.
    template <class F> double mean(double low, double high, F&& f) const {
        double sum = 0, n = 0;
        for (std::size_t i = 0; i < real_; ++i)
            if (b.x[0][i] > low && b.x[0][i] < high) {
                sum += f(i);
                ++n;
            }
        return sum / n;
    }

private:
    std::size_t real_;
    std::vector<std::size_t> of_;
    std::vector<double> shift_, f_, fx_;
    FluidSolver solver_;
    double last_ = 0;

public:
    FluidBody b;
    std::vector<Platen> platens;   ///< across x
    double time = 0, impulse = 0, work = 0;
    int steps = 0;
};

// ---- worlds

/// Runs a world to a time.
template <class R>
void run(World<R>& w, double until) {
    while (w.time < until - 1e-12) step(w, until);
}

/// Where a monotonic front passes a level: the first crossing coming from the far side, by linear interpolation. Points are (x, value)
/// sorted by x.
inline double front(const std::vector<std::pair<double, double>>& profile, double level) {
    for (std::size_t i = profile.size() - 1; i-- > 0;)
        if (profile[i].second >= level && profile[i + 1].second < level)
            return profile[i].first + (profile[i].second - level) / (profile[i].second - profile[i + 1].second) * (profile[i + 1].first - profile[i].first);
    return -1e300;
}

}  // namespace brisance::core_test
