// SPDX-License-Identifier: Apache-2.0
#include "formulations/updated_lagrangian/updated_lagrangian.h"

#include "math/kernel.h"
#include "math/power.h"

#include <algorithm>
#include <cmath>

namespace brisance {

void light(FluidBody& b, const std::vector<Detonator>& detonators) {
    for (std::size_t i = 0; i < b.lit.size(); ++i) {
        b.lit[i] = 1e300;
        for (const Detonator& d : detonators) {
            double distance = 0;
            if (d.kind != 2) {
                double p[3], axis[3], length2 = 0, along = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    p[k] = b.x[k][i] - d.from[k];
                    axis[k] = d.to[k] - d.from[k];
                    length2 += axis[k] * axis[k];
                    along += p[k] * axis[k];
                }
                const double t = d.kind == 1 && length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double q = p[k] - t * axis[k];
                    distance += q * q;
                }
                distance = std::sqrt(distance);
            }
            b.lit[i] = std::min(b.lit[i], d.time + distance / b.material.burn->speed);
        }
    }
}

void FluidSolver::state(FluidBody& b, double time) {
    using V = Pack<double>;
    constexpr int width = lanes<double>;
    const double rho0 = b.material.density, floor = b.material.eos->pressure_floor();
    const double h0 = b.options.smoothing * b.spacing;
    const BurnLaw* burn = b.material.burn.get();
    // complete when the front has passed by one and a half spacings, as in LS-DYNA's burn fraction F1
    const double burn_rate = burn ? 2 * burn->speed / (3 * b.spacing) : 0;
    const std::int64_t n = b.size();
    exec::for_each((n + width - 1) / width, [&](std::int64_t block) {
        const std::int64_t first = block * width, last = std::min(first + width, n);
        alignas(64) double mu[width], energy[width];
        for (int l = 0; l < width; ++l) {
            const auto i = static_cast<std::size_t>(std::min(first + l, n - 1));
            mu[l] = b.rho_now[i] / rho0 - 1;
            energy[l] = b.e_now[i] * rho0;
        }
        EosTerms<V> t;
        b.material.eos->terms(mu, t);
        const V e = load<V>(energy), m = load<V>(mu);
        V p = eos_pressure(t, e);
        p = (p > floor) ? p : broadcast<V>(std::max(floor, -1e6));
        V c2 = eos_stiffness(t, m, e, p) / rho0;
        for (std::int64_t k = first; k < last; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const int l = static_cast<int>(k - first);
            double pressure = lane(p, l), sound = std::sqrt(std::max(lane(c2, l), 1e-12));
            if (burn) {
                const double since = time - b.lit[i];
                if (since > 0) {
                    const double compression = (1 - rho0 / b.rho_now[i]) / (1 - burn->cj_volume);
                    b.burnt[i] = std::clamp(std::max({since * burn_rate, compression, b.burnt[i]}), 0.0, 1.0);
                }
                pressure *= b.burnt[i];
                sound = std::max(sound, burn->speed * (1 - b.burnt[i]));
            }
            b.pressure[i] = pressure;
            b.sound[i] = sound;
            b.peak_pressure[i] = std::max(b.peak_pressure[i], pressure);
            b.h[i] = h0 * std::clamp(std::cbrt((b.rho_start.empty() ? rho0 : b.rho_start[i]) / b.rho_now[i]), b.options.h_min, b.options.h_max);
        }
    });
}

/// M^-1 as far as the neighbours bear it: an eigenvalue m becomes m (1 + e^2)/(m^2 + e^2). That is 1/m inside (m = 1), 1.88 in place of 2 at
/// a plane surface (m = 1/2), never more than 3.4, and 0 for a particle alone.
static Sym3<double> correction(const Sym3<double>& m) {
    constexpr double e2 = 0.15 * 0.15;
    const Mat3<double> full{m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz};
    Sym3<double> square = symmetric_product(full, full);
    square.xx += e2;
    square.yy += e2;
    square.zz += e2;
    const Mat3<double> c = full * inverse(square);
    return {(1 + e2) * c.xx, (1 + e2) * c.yy, (1 + e2) * c.zz, (1 + e2) * c.xy, (1 + e2) * c.xz, (1 + e2) * c.yz};
}

namespace {

/// Particle i and a pack of its neighbours: grad_i W = -weight d.
template <class V>
struct Pairs {
    Vec3<V> d, v;          ///< x_i - x_j, v_i - v_j
    V h, r2, u;            ///< mean h, |d|^2, |d|/h
    V volume, weight;      ///< of j; -W'/r
};

/// `me` and `records`: x y z h, m/rho, v of the particle and of all entries.
template <class V>
BRISANCE_INLINE Pairs<V> pairs(const double* me, const double* records, const std::int32_t* list) {
    V r[8];
    load_records<V>(records, list, r);
    Pairs<V> p;
    p.d = {me[0] - r[0], me[1] - r[1], me[2] - r[2]};
    p.v = {me[5] - r[5], me[6] - r[6], me[7] - r[7]};
    p.h = 0.5 * (me[3] + r[3]);
    p.volume = r[4];
    p.r2 = dot(p.d, p.d);
    const V inverse_h = 1.0 / p.h, h2 = inverse_h * inverse_h;
    p.u = vmin(vsqrt(p.r2) * inverse_h, broadcast<V>(2.0));
    p.weight = kernel::sigma_3d * h2 * h2 * inverse_h * kernel::bond(p.u);
    return p;
}

}  // namespace

void FluidSolver::responses(FluidBody& b) {
    using V = Pack<double>;
    const std::int64_t entries = grid_.entries();
    q_.resize(static_cast<std::size_t>(b.size()));
    exec::for_each(entries, [&](std::int64_t k) {
        if (image(k)) return;
        const std::size_t i = particle(k);
        const double* me = &motion_[8 * static_cast<std::size_t>(k)];
        Sym3<V> m;
        Mat3<V> g;
        neighbours_.packs(k, [&](const std::int32_t* list) {
            const Pairs<V> p = pairs<V>(me, motion_.data(), list);
            const Vec3<V> w = (p.volume * p.weight) * p.d;
            m.xx += w.x * p.d.x;
            m.yy += w.y * p.d.y;
            m.zz += w.z * p.d.z;
            m.xy += w.x * p.d.y;
            m.xz += w.x * p.d.z;
            m.yz += w.y * p.d.z;
            g.xx += w.x * p.v.x;
            g.xy += w.x * p.v.y;
            g.xz += w.x * p.v.z;
            g.yx += w.y * p.v.x;
            g.yy += w.y * p.v.y;
            g.yz += w.y * p.v.z;
            g.zx += w.z * p.v.x;
            g.zy += w.z * p.v.y;
            g.zz += w.z * p.v.z;
        });
        const Sym3<double> l = correction({hsum(m.xx), hsum(m.yy), hsum(m.zz), hsum(m.xy), hsum(m.xz), hsum(m.yz)});
        const double divergence = l.xx * hsum(g.xx) + l.yy * hsum(g.yy) + l.zz * hsum(g.zz) + l.xy * hsum(g.xy + g.yx) + l.xz * hsum(g.xz + g.zx) +
                                  l.yz * hsum(g.yz + g.zy);
        const double closing = -std::min(divergence, 0.0) * me[3];
        correction_[i] = l;
        b.rho_rate[i] = -divergence;
        q_[i] = b.rho_now[i] * closing * (b.options.quadratic * closing + b.options.linear * b.sound[i]);
    });
    exec::for_each(entries, [&](std::int64_t k) {
        const std::size_t i = particle(k);
        const double x = sign(k, 0), y = sign(k, 1), z = sign(k, 2);
        const double turn[6] = {1, 1, 1, x * y, x * z, y * z};
        double* r = &response_[8 * static_cast<std::size_t>(k)];
        r[0] = b.rho_now[i];
        r[1] = b.sound[i];
        for (std::size_t a = 0; a < 6; ++a) r[2 + a] = turn[a] * (b.pressure[i] + q_[i]) * component(correction_[i], a);
    }, 1024);
}

FluidSolver::Powers FluidSolver::rates(FluidBody& b) {
    using V = Pack<double>;
    constexpr int width = lanes<double>;
    const std::int64_t n = b.size();
    double h_max = 0;
    for (double h : b.h) h_max = std::max(h_max, h);
    // Cells of half the largest support: few candidates per particle, and not many cells to look into.
    points_.build(b, 2 * h_max);
    grid_.build(points_.place(0), points_.place(1), points_.place(2), points_.size(), std::max(h_max, 1e-9), 2 * h_max, b.z_low, b.period);
    const std::int64_t entries = grid_.entries();
    const auto padded = static_cast<std::size_t>(entries + width);
    for (auto* a : {&sx_, &sy_, &sz_, &sh_}) a->resize(padded);
    for (auto* a : {&motion_, &response_}) a->resize(8 * padded);
    exec::for_each(entries, [&](std::int64_t k) {
        const auto s = static_cast<std::size_t>(k), e = static_cast<std::size_t>(grid_.index(k)), i = particle(k);
        sx_[s] = points_.place(0)[e];
        sy_[s] = points_.place(1)[e];
        sz_[s] = points_.place(2)[e] + grid_.shift(k);
        sh_[s] = b.h[i];
        const double record[8] = {sx_[s], sy_[s], sz_[s], sh_[s], b.mass[i] / b.rho_now[i], sign(k, 0) * b.v_now[0][i], sign(k, 1) * b.v_now[1][i], sign(k, 2) * b.v_now[2][i]};
        std::copy(record, record + 8, &motion_[8 * s]);
    }, 1024);
    for (std::size_t s = static_cast<std::size_t>(entries); s < padded; ++s) {  // out of everybody's reach, and nothing there
        constexpr double far = 1e50, nothing[8] = {far, 0, 0, 1, 0, 0, 0, 0}, unit[8] = {1, 1, 0, 0, 0, 0, 0, 0};
        sx_[s] = far;
        sy_[s] = sz_[s] = 0;
        sh_[s] = 1;
        std::copy(nothing, nothing + 8, &motion_[8 * s]);
        std::copy(unit, unit + 8, &response_[8 * s]);
    }
    mu_.resize(static_cast<std::size_t>(n));
    correction_.resize(static_cast<std::size_t>(n));
    neighbours_.build(grid_, sx_.data(), sy_.data(), sz_.data(), sh_.data(), h_max, [&](std::int64_t k) { return !image(k); });
    responses(b);

    // most fluids bear no tension: then there is nothing to resist
    const bool tension = b.options.artificial_stress && std::any_of(b.pressure.begin(), b.pressure.end(), [](double p) { return p < 0; });
    const auto resistance = [&](std::int64_t k) {  // -eps sigma/rho^2
        const std::size_t i = particle(k);
        return b.pressure[i] < 0 ? b.options.epsilon * b.pressure[i] / (b.rho_now[i] * b.rho_now[i]) : 0.0;
    };
    const double alpha = b.options.alpha, beta = b.options.beta;
    struct Acc {
        Powers p;
        Acc& operator+=(const Acc& o) {
            p.viscous += o.p.viscous;
            p.artificial += o.p.artificial;
            return *this;
        }
    };
    const Acc total = exec::sum(entries, Acc{}, [&](std::int64_t k) {
        if (image(k)) return Acc{};
        const std::size_t i = particle(k);
        const double *me = &motion_[8 * static_cast<std::size_t>(k)], *mine = &response_[8 * static_cast<std::size_t>(k)];
        const double rho = mine[0], c = mine[1], r_i = tension ? resistance(k) : 0.0;
        V ax{}, ay{}, az{}, heat{}, viscous{}, artificial{}, mu_largest{};
        neighbours_.packs(k, [&](const std::int32_t* list) {
            const Pairs<V> p = pairs<V>(me, motion_.data(), list);
            V other[8];  // rho, c, (P + q) L
            load_records<V>(response_.data(), list, other);
            const V vr = dot(p.v, p.d), mj = p.volume * other[0];
            const V mu = vmin(p.h * vr / (p.r2 + 0.01 * p.h * p.h), V{});
            const V pi = 2.0 * mu * (beta * mu - alpha * (0.5 * (c + other[1]))) / (rho + other[0]);
            V bracket = pi;
            if (tension) {
                alignas(64) double r_j[width];
                for (int l = 0; l < width; ++l) r_j[l] = list[l] < entries ? resistance(list[l]) : 0.0;
                const V w = kernel::shape(p.u), w0 = kernel::shape(vmin(b.spacing / p.h, broadcast<V>(2.0)));
                const V extra = -(r_i + load<V>(r_j)) * power(w / vmax(w0, broadcast<V>(1e-6)), b.options.n);
                bracket += extra;
                artificial -= 0.5 * mj * extra * p.weight * vr;
            }
            const Sym3<V> p_sum{mine[2] + other[2], mine[3] + other[3], mine[4] + other[4], mine[5] + other[5], mine[6] + other[6], mine[7] + other[7]};
            const V volume = p.volume * p.weight, along = mj * p.weight * bracket * rho;
            const Vec3<V> push = p_sum * p.d;
            ax += volume * push.x + along * p.d.x;
            ay += volume * push.y + along * p.d.y;
            az += volume * push.z + along * p.d.z;
            const V wv = mj * p.weight * vr;
            heat -= 0.5 * bracket * wv;
            viscous -= 0.5 * pi * wv;
            mu_largest = vmax(mu_largest, -mu);
        });
        b.acceleration[0][i] = hsum(ax) / rho;
        b.acceleration[1][i] = hsum(ay) / rho;
        b.acceleration[2][i] = hsum(az) / rho;
        b.e_rate[i] = (b.pressure[i] + q_[i]) / rho * b.rho_rate[i] + hsum(heat);
        mu_[i] = hmax(mu_largest);
        Acc a;
        a.p.viscous = b.mass[i] * (hsum(viscous) + q_[i] / rho * b.rho_rate[i]);
        a.p.artificial = b.mass[i] * hsum(artificial);
        return a;
    });
    return total.p;
}

void FluidSolver::kick(FluidBody& b, double kick, const double* fx, const double* fy, const double* fz) {
    exec::for_each(b.size(), [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        const double outer[3] = {fx[i] / b.mass[i], fy[i] / b.mass[i], fz[i] / b.mass[i]};
        double missed = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double inner = b.acceleration[a][i], before = b.v[a][i];
            b.acceleration[a][i] += outer[a];
            b.v[a][i] += kick * b.acceleration[a][i];
            missed += inner * (0.5 * (before + b.v[a][i]) - b.v_now[a][i]);
        }
        const double growth = std::clamp(kick * b.rho_rate[i], -1.0, 1.0);
        b.rho[i] *= (1 + 0.5 * growth) / (1 - 0.5 * growth);
        b.e[i] += kick * (b.e_rate[i] - missed);
    }, 1024);
}

void FluidSolver::drift(FluidBody& b, double dt) {
    exec::for_each(b.size(), [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        for (std::size_t a = 0; a < 3; ++a) {
            b.x[a][i] += dt * b.v[a][i];
            b.v_now[a][i] = b.v[a][i] + 0.5 * dt * b.acceleration[a][i];
        }
        if (b.period > 0) {
            double& z = b.x[2][i];
            z -= b.period * std::floor((z - b.z_low) / b.period);
        }
        const double growth = std::clamp(0.5 * dt * b.rho_rate[i], -1.0, 1.0);
        b.rho_now[i] = b.rho[i] * (1 + 0.5 * growth) / (1 - 0.5 * growth);
        b.e_now[i] = b.e[i] + 0.5 * dt * b.e_rate[i];
    }, 1024);
}

double FluidSolver::stable_rate(const FluidBody& b) const {
    return exec::max(b.size(), 0.0, [&](std::int64_t k) { return stable_rate(b, static_cast<std::size_t>(k)); });
}

double FluidSolver::stable_rate(const FluidBody& b, std::size_t i) const {
    const double a = std::sqrt(b.acceleration[0][i] * b.acceleration[0][i] + b.acceleration[1][i] * b.acceleration[1][i] +
                               b.acceleration[2][i] * b.acceleration[2][i]);
    const FluidOptions& o = b.options;
    const double closing = std::max(b.rho_rate[i], 0.0) * b.h[i];
    return std::max((b.sound[i] * (1 + 0.6 * o.alpha + 1.2 * o.linear) + 0.6 * o.beta * mu_[i] + 1.2 * o.quadratic * closing) / b.h[i],
                    std::sqrt(a / b.h[i]));
}

BodySums FluidSolver::sums(const FluidBody& b) const {
    const double rho0 = b.material.density, e0 = b.material.eos->initial_energy() / rho0;
    return exec::sum(b.size(), BodySums{}, [&](std::int64_t k) {
        const auto i = static_cast<std::size_t>(k);
        BodySums s;
        const double m = b.mass[i], vx = b.v[0][i], vy = b.v[1][i], vz = b.v[2][i];
        s.mass = m;
        s.kinetic = 0.5 * m * (vx * vx + vy * vy + vz * vz);
        s.internal = m * b.e[i];
        s.px = m * vx;
        s.py = m * vy;
        s.pz = m * vz;
        if (b.material.burn) s.unburnt = m * e0 * (1 - b.burnt[i]);
        return s;
    });
}

}  // namespace brisance
