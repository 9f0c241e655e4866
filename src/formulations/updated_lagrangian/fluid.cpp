// SPDX-License-Identifier: Apache-2.0
#include "formulations/updated_lagrangian/updated_lagrangian.h"

#include "exec/launch.h"
#include "laws/laws.h"
#include "math/kernel.h"
#include "math/power.h"

#include <algorithm>
#include <cmath>

namespace brisance {

double lighting_time(const Vec3<double>& at, const std::vector<Detonator>& detonators, double speed) {
    double first = 1e300;
    for (const Detonator& d : detonators) {
        double distance = 0;
        if (d.kind != 2) {
            const Vec3<double> from{d.from[0], d.from[1], d.from[2]}, axis = Vec3<double>{d.to[0], d.to[1], d.to[2]} - from, p = at - from;
            const double length2 = dot(axis, axis), t = d.kind == 1 && length2 > 0 ? std::clamp(dot(p, axis) / length2, 0.0, 1.0) : 0.0;
            distance = norm(p - t * axis);
        }
        first = std::min(first, d.time + distance / speed);
    }
    return first;
}

void light(FluidBody& b, const std::vector<Detonator>& detonators) {
    for (std::size_t i = 0; i < b.lit.size(); ++i) b.lit[i] = lighting_time({b.x[0][i], b.x[1][i], b.x[2][i]}, detonators, b.material.burn->speed);
}

namespace {

/// P, c, h, and the fraction burnt of a pack of particles.
template <class Laws>
struct StateKernel {
    FluidView b;
    Laws laws;
    double rho0, h0, h_min, h_max;
    double time, speed, cj_volume;  ///< of the burn; speed 0: inert
    BRISANCE_HD void operator()(std::int64_t block) const {
        using V = Pack<double>;
        constexpr int width = lanes<double>;
        const std::int64_t first = block * width, last = std::min(first + width, b.n);
        alignas(64) double mu[width], energy[width];
        for (int l = 0; l < width; ++l) {
            const std::int64_t i = std::min(first + l, b.n - 1);
            mu[l] = b.rho_now[i] / rho0 - 1;
            energy[l] = b.e_now[i] * rho0;
        }
        const V e = load<V>(energy), m = load<V>(mu);
        const EosTerms<V> t = laws.terms(m);
        const V p = vmax(eos_pressure(t, e), broadcast<V>(laws.floor));
        const V c2 = eos_stiffness(t, m, e, p) / rho0;
        for (std::int64_t i = first; i < last; ++i) {
            const int l = static_cast<int>(i - first);
            double pressure = lane(p, l), sound = std::sqrt(std::max(lane(c2, l), 1e-12));
            if (speed > 0) {
                const double since = time - b.lit[i];
                if (since > 0) {
                    // complete when the front has passed by one and a half spacings, as in LS-DYNA's burn fraction F1
                    const double burn_rate = 2 * speed / (3 * b.spacing), compression = (1 - rho0 / b.rho_now[i]) / (1 - cj_volume);
                    b.burnt[i] = std::clamp(std::max(std::max(since * burn_rate, compression), b.burnt[i]), 0.0, 1.0);
                }
                pressure *= b.burnt[i];
                sound = std::max(sound, speed * (1 - b.burnt[i]));
            }
            b.pressure[i] = pressure;
            b.sound[i] = sound;
            b.peak_pressure[i] = std::max(b.peak_pressure[i], pressure);
            b.h[i] = h0 * std::clamp(std::cbrt(b.initial_density(i) / b.rho_now[i]), h_min, h_max);
        }
    }
};

}  // namespace

void FluidSolver::state(FluidBody& b, double time) {
    const BurnLaw* burn = b.material.burn.get();
    with_eos(b.material, [&](const auto& laws) {
        using Kernel = StateKernel<std::remove_cvref_t<decltype(laws)>>;
        exec::launch((b.size() + lanes<double> - 1) / lanes<double>,
                     Kernel{view(b), laws, b.material.density, b.options.smoothing * b.spacing, b.options.h_min, b.options.h_max, time, burn ? burn->speed : 0, burn ? burn->cj_volume : 0});
    });
}

namespace {

/// M^-1 as far as the neighbours bear it: an eigenvalue m becomes m (1 + e^2)/(m^2 + e^2). That is 1/m inside (m = 1), 1.88 in place of 2 at
/// a plane surface (m = 1/2), never more than 3.4, and 0 for a particle alone.
BRISANCE_HD Sym3<double> correction(const Sym3<double>& m) {
    constexpr double e2 = 0.15 * 0.15;
    const Mat3<double> full{m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz};
    Sym3<double> square = symmetric_product(full, full);
    square.xx += e2;
    square.yy += e2;
    square.zz += e2;
    const Mat3<double> c = full * inverse(square);
    return {(1 + e2) * c.xx, (1 + e2) * c.yy, (1 + e2) * c.zz, (1 + e2) * c.xy, (1 + e2) * c.xz, (1 + e2) * c.yz};
}

/// Particle i and a pack of its neighbours.
template <class V>
struct Pairs {
    Vec3<V> d, v;          ///< x_i - x_j, v_i - v_j
    V h, r2, r;            ///< mean h, |d|^2, |d|
    V volume;              ///< of j

    /// -W'/r, that is grad_i W = -weight d, with one division.
    BRISANCE_INLINE V weight() const {
        const V inverse_rh = 1.0 / (r * h), inverse_h = inverse_rh * r, h2 = inverse_h * inverse_h;
        return kernel::sigma_3d * h2 * h2 * inverse_h * kernel::bond(r * inverse_h, h * (h * inverse_rh));
    }
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
    p.r = vsqrt(vmax(p.r2, broadcast<V>(1e-24)));  // two in one place push nowhere
    return p;
}

/// Places, supports and motion of the entries, and a pack of floats behind the last: out of everybody's reach, and nothing there.
struct MotionKernel {
    FluidView b;
    FluidWork w;
    BRISANCE_HD void operator()(std::int64_t k) const {
        double record[8] = {1e30, 0, 0, 1, 0, 0, 0, 0};
        if (k < w.grid.entries) {
            const std::int32_t e = w.grid.index[k];
            const std::int64_t i = w.particle(k);
            const double now[8] = {w.points.place[0][e], w.points.place[1][e], w.points.place[2][e] + w.grid.shift[k], b.h[i], b.mass[i] / b.rho_now[i],
                                   w.sign(k, 0) * b.v_now[0][i], w.sign(k, 1) * b.v_now[1][i], w.sign(k, 2) * b.v_now[2][i]};
            for (int c = 0; c < 8; ++c) record[c] = now[c];
        } else {
            const double unit[8] = {1, 1, 0, 0, 0, 0, 0, 0};
            for (int c = 0; c < 8; ++c) w.response[record_length * k + c] = unit[c];
            w.resistance[k] = 0;
        }
        float* const place[3] = {w.x, w.y, w.z};
        for (int a = 0; a < 3; ++a) place[a][k] = static_cast<float>(record[a] - w.grid.min[a]);
        w.h[k] = static_cast<float>(record[3]);
        for (int c = 0; c < 8; ++c) w.motion[record_length * k + c] = record[c];
    }
};

struct Value {
    const double* a;
    BRISANCE_HD double operator()(std::int64_t i) const { return a[i]; }
};
struct Count {
    const std::int32_t* a;
    BRISANCE_HD std::int64_t operator()(std::int64_t i) const { return a[i]; }
};

struct OwnEntries {
    FluidWork w;
    BRISANCE_HD bool operator()(std::int64_t k) const { return !w.image(k); }
};

/// First pass: L, the divergence, and with it d rho/dt and q.
struct DivergenceKernel {
    FluidView b;
    FluidWork w;
    double linear, quadratic;
    BRISANCE_HD void operator()(std::int64_t k) const {
        using V = Pack<double>;
        if (w.image(k)) return;
        const std::int64_t i = w.particle(k);
        const double* me = w.motion + record_length * k;
        const double* motion = w.motion;
        Sym3<V> m;
        Mat3<V> g;
        w.neighbours.packs(k, [&](const std::int32_t* list) {
            const Pairs<V> p = pairs<V>(me, motion, list);
            const Vec3<V> u = (p.volume * p.weight()) * p.d;
            m.xx += u.x * p.d.x;
            m.yy += u.y * p.d.y;
            m.zz += u.z * p.d.z;
            m.xy += u.x * p.d.y;
            m.xz += u.x * p.d.z;
            m.yz += u.y * p.d.z;
            g.xx += u.x * p.v.x;
            g.xy += u.x * p.v.y;
            g.xz += u.x * p.v.z;
            g.yx += u.y * p.v.x;
            g.yy += u.y * p.v.y;
            g.yz += u.y * p.v.z;
            g.zx += u.z * p.v.x;
            g.zy += u.z * p.v.y;
            g.zz += u.z * p.v.z;
        });
        double s[12];
        hsums({m.xx, m.yy, m.zz, m.xy, m.xz, m.yz, g.xx, g.yy, g.zz, g.xy + g.yx, g.xz + g.zx, g.yz + g.zy}, s);
        const Sym3<double> l = correction({s[0], s[1], s[2], s[3], s[4], s[5]});
        const double divergence = l.xx * s[6] + l.yy * s[7] + l.zz * s[8] + l.xy * s[9] + l.xz * s[10] + l.yz * s[11];
        const double closing = -std::min(divergence, 0.0) * me[3];
        w.correction[i] = l;
        w.missing[i] = 1 - (s[0] + s[1] + s[2]) / 3;
        w.unseen[i] = 1 - (l.xx * s[0] + l.yy * s[1] + l.zz * s[2] + 2 * (l.xy * s[3] + l.xz * s[4] + l.yz * s[5])) / 3;
        b.rho_rate[i] = -divergence;
        w.q[i] = b.rho_now[i] * closing * (quadratic * closing + linear * b.sound[i]);
    }
};

/// rho, c, (P + q) L of every entry; and R = eps P/rho^2 where it is in tension and has something against it.
struct ResponseKernel {
    FluidView b;
    FluidWork w;
    double epsilon;  ///< 0: nothing is in tension
    BRISANCE_HD void operator()(std::int64_t k) const {
        const std::int64_t i = w.particle(k);
        const double x = w.sign(k, 0), y = w.sign(k, 1), z = w.sign(k, 2);
        const double turn[6] = {1, 1, 1, x * y, x * z, y * z};
        double* r = w.response + record_length * k;
        r[0] = b.rho_now[i];
        r[1] = b.sound[i];
        for (int a = 0; a < 6; ++a) r[2 + a] = turn[a] * (b.pressure[i] + w.q[i]) * component(w.correction[i], static_cast<std::size_t>(a));
        if (epsilon > 0) w.resistance[k] = b.pressure[i] < 0 ? epsilon * b.pressure[i] / (b.rho_now[i] * b.rho_now[i]) : 0.0;
    }
};

/// Second pass: the rates of v and e. Gives the powers. `tension`: there is some to resist; without, its lines would cost the others registers.
template <bool tension>
struct RatesKernel {
    FluidView b;
    FluidWork w;
    double alpha, beta, exponent;
    BRISANCE_HD FluidSolver::Powers operator()(std::int64_t k) const {
        using V = Pack<double>;
        if (w.image(k)) return {};
        const std::int64_t i = w.particle(k);
        const double *me = w.motion + record_length * k, *mine = w.response + record_length * k;
        const double rho = mine[0], c = mine[1];
        V ax{}, ay{}, az{}, heat{}, viscous{}, artificial{}, mu_largest{}, mu_felt{};
        w.neighbours.packs(k, [&](const std::int32_t* list) {
            const Pairs<V> p = pairs<V>(me, w.motion, list);
            V other[8];  // rho, c, (P + q) L
            load_records<V>(w.response, list, other);
            const V vr = dot(p.v, p.d), mj = p.volume * other[0];
            // the weight has to be that of the first pass to the last bit: what P dV gives there, its force takes here
            const V weight = p.weight(), apart = p.r2 + 0.01 * p.h * p.h, densities = rho + other[0], inverse = 1.0 / (apart * densities);
            const V mu = vmin(p.h * vr * (inverse * densities), V{});
            const V pi = 2.0 * mu * (beta * mu - alpha * (0.5 * (c + other[1]))) * (inverse * apart);
            V bracket = pi;
            if constexpr (tension) {
                constexpr int width = lanes<double>;
                alignas(64) double r_j[width];
                for (int l = 0; l < width; ++l) r_j[l] = w.resistance[list[l] / record_length];
                const V resistance = w.resistance[k] + load<V>(r_j);
                if (any_lane(resistance < V{})) {
                    const V wi = kernel::shape(p.r / p.h), w0 = kernel::shape(vmin(b.spacing / p.h, broadcast<V>(2.0)));
                    const V extra = -resistance * power(wi / vmax(w0, broadcast<V>(1e-6)), exponent);
                    bracket += extra;
                    artificial -= 0.5 * mj * extra * weight * vr;
                }
            }
            const Sym3<V> p_sum{mine[2] + other[2], mine[3] + other[3], mine[4] + other[4], mine[5] + other[5], mine[6] + other[6], mine[7] + other[7]};
            const V volume = p.volume * weight, along = mj * weight * bracket * rho;
            const Vec3<V> push = p_sum * p.d;
            ax += volume * push.x + along * p.d.x;
            ay += volume * push.y + along * p.d.y;
            az += volume * push.z + along * p.d.z;
            const V wv = mj * weight * vr;
            heat -= 0.5 * bracket * wv;
            viscous -= 0.5 * pi * wv;
            mu_largest = vmax(mu_largest, -mu);
            mu_felt -= mj * weight * (mu * (inverse * apart));
        });
        double s[6];
        hsums({ax, ay, az, heat, viscous, artificial}, s);
        for (int a = 0; a < 3; ++a) b.acceleration[a][i] = s[a] / rho;
        b.e_rate[i] = (b.pressure[i] + w.q[i]) / rho * b.rho_rate[i] + s[3];
        w.mu[i] = std::min(hmax(mu_largest), 1.2 * 2.0 * me[3] * me[3] * hsum(mu_felt));  // 2: the sum has rho_i + rho_j for their mean
        return {b.mass[i] * (s[4] + w.q[i] / rho * b.rho_rate[i]), b.mass[i] * s[5]};
    }
};

}  // namespace

FluidWork FluidSolver::sort(const FluidBody& b) {
    const FluidView body = view(b);
    const double h_max = exec::launch_max(body.n, 0.0, Value{body.h});
    // Cells of half the usual support: few candidates per particle. Where a pack takes sixteen, cells of all of it: rows of them fill the packs.
    const double h_mean = exec::launch_sum(body.n, Value{body.h}) / static_cast<double>(std::max<std::int64_t>(body.n, 1));
    const double cell = (lanes<float> < 16 ? 1 : 2) * (h_max < 1.25 * h_mean ? h_max : h_mean);
    points_.build(b, 2 * h_max);
    grid_.build(points_.place(0), points_.place(1), points_.place(2), points_.size(), std::max(cell, 1e-9), 2 * h_max, b.z_low, b.period);
    const auto padded = static_cast<std::size_t>(grid_.entries() + lanes<float>), n = static_cast<std::size_t>(body.n);
    for (auto* a : {&x_, &y_, &z_, &h_}) make_room(*a, padded);
    for (auto* a : {&motion_, &response_}) make_room(*a, record_length * padded);
    make_room(resistance_, padded);
    for (auto* a : {&mu_, &q_, &missing_, &unseen_}) make_room(*a, n);
    if (correction_.size() != n) {
        const exec::HostAccess host;
        correction_.resize(n);
    }
    FluidWork w{grid_.view(), points_.view(), {}, x_.data(), y_.data(), z_.data(), h_.data(), motion_.data(), response_.data(), resistance_.data(), correction_.data(), mu_.data(), q_.data(), missing_.data(), unseen_.data(), body.n};
    exec::launch(static_cast<std::int64_t>(padded), MotionKernel{body, w}, 1024);
    neighbours_.build(w.grid, {w.x, w.y, w.z, w.h, w.motion, h_max}, OwnEntries{w});
    w.neighbours = neighbours_.view();
    return w;
}

FluidSolver::Powers FluidSolver::rates(FluidBody& b) {
    const FluidView body = view(b);
    const FluidWork w = sort(b);
    exec::launch(w.grid.entries, DivergenceKernel{body, w, b.options.linear, b.options.quadratic});
    // most fluids bear no tension: then there is nothing to resist
    const bool tension = b.options.artificial_stress && b.options.epsilon > 0 && exec::launch_max(body.n, 0.0, BRISANCE_KERNEL(std::int64_t i) { return -body.pressure[i]; }) > 0;
    exec::launch(w.grid.entries, ResponseKernel{body, w, tension ? b.options.epsilon : 0.0}, 1024);
    if (tension) return exec::launch_sum(w.grid.entries, Powers{}, RatesKernel<true>{body, w, b.options.alpha, b.options.beta, b.options.n});
    return exec::launch_sum(w.grid.entries, Powers{}, RatesKernel<false>{body, w, b.options.alpha, b.options.beta, b.options.n});
}

double FluidSolver::equalise(FluidBody& body, const double* press, const double* near, double dt) {
    const FluidView b = view(body);
    const double *const missing = missing_.data(), *const unseen = unseen_.data();
    return exec::launch_sum(b.n, BRISANCE_KERNEL(std::int64_t i) {
        if (!(near[i] > 0 && missing[i] > 0.05 && unseen[i] > 0 && dt > 0)) return 0.0;
        const double blind = std::min(unseen[i] / missing[i], 1.0), rho = b.rho_now[i], above = b.pressure[i] - press[i] / near[i];
        if (above > 0 && rho <= b.initial_density(i)) return 0.0;
        const double impedance = std::sqrt(rho * (rho * b.sound[i] * b.sound[i] + std::abs(above)));
        const double growth = std::clamp(blind * blind * above / (b.current_spacing(i) * impedance), -0.1 / dt, 0.1 / dt);
        const double heat = -b.pressure[i] / rho * growth;
        b.rho_rate[i] -= growth;
        b.e_rate[i] += heat;
        return b.mass[i] * heat;
    });
}

void FluidSolver::kick(FluidBody& body, double kick, const double* fx, const double* fy, const double* fz) {
    const FluidView b = view(body);
    exec::launch(b.n, BRISANCE_KERNEL(std::int64_t i) {
        const double outer[3] = {fx[i] / b.mass[i], fy[i] / b.mass[i], fz[i] / b.mass[i]};
        double missed = 0;
        for (int a = 0; a < 3; ++a) {
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

void FluidSolver::drift(FluidBody& body, double dt) {
    const FluidView b = view(body);
    exec::launch(b.n, BRISANCE_KERNEL(std::int64_t i) {
        for (int a = 0; a < 3; ++a) {
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

namespace {

struct StableRate {
    FluidView b;
    const double *mu, *missing, *fx, *fy, *fz;
    double alpha, beta, linear, quadratic;
    BRISANCE_HD double operator()(std::int64_t i) const {
        if (fx && missing[i] > 0.999 && fx[i] == 0 && fy[i] == 0 && fz[i] == 0) return 0;
        const double a = std::sqrt(b.acceleration[0][i] * b.acceleration[0][i] + b.acceleration[1][i] * b.acceleration[1][i] +
                                   b.acceleration[2][i] * b.acceleration[2][i]);
        const double closing = std::max(b.rho_rate[i], 0.0) * b.h[i];
        return std::max((b.sound[i] * (1 + 0.6 * alpha + 1.2 * linear) + 0.6 * beta * mu[i] + 1.2 * quadratic * closing) / b.h[i], std::sqrt(a / b.h[i]));
    }
};
StableRate stable_rate_of(const FluidBody& b, const Array<double>& mu, const Array<double>& missing, const double* fx, const double* fy, const double* fz) {
    return {view(b), mu.data(), missing.data(), fx, fy, fz, b.options.alpha, b.options.beta, b.options.linear, b.options.quadratic};
}

struct FluidSumsKernel {
    FluidView b;
    double chemical;  ///< kJ/g, before the burn; 0: inert
    BRISANCE_HD BodySums operator()(std::int64_t i) const {
        BodySums s;
        const double m = b.mass[i], vx = b.v[0][i], vy = b.v[1][i], vz = b.v[2][i];
        s.mass = m;
        s.kinetic = 0.5 * m * (vx * vx + vy * vy + vz * vz);
        s.internal = m * b.e[i];
        s.px = m * vx;
        s.py = m * vy;
        s.pz = m * vz;
        s.unburnt = m * chemical * (1 - b.burnt[i]);
        return s;
    }
};

}  // namespace

double FluidSolver::stable_rate(const FluidBody& b, const double* fx, const double* fy, const double* fz) const {
    return exec::launch_max(b.size(), 0.0, stable_rate_of(b, mu_, missing_, fx, fy, fz));
}

std::size_t FluidSolver::fastest(const FluidBody& b, const double* fx, const double* fy, const double* fz) const {
    const exec::HostAccess host;
    const StableRate rate = stable_rate_of(b, mu_, missing_, fx, fy, fz);
    std::int64_t most = 0;
    for (std::int64_t i = 1; i < b.size(); ++i)
        if (rate(i) > rate(most)) most = i;
    return static_cast<std::size_t>(most);
}

double FluidSolver::neighbours_per_particle() const { 
    const NeighbourListsView& v = neighbours_.view();
    return static_cast<double>(exec::launch_sum(v.entries, std::int64_t{0}, Count{v.count})) / static_cast<double>(std::max<std::size_t>(correction_.size(), 1));
}

BodySums FluidSolver::sums(const FluidBody& b) const {
    return exec::launch_sum(b.size(), BodySums{}, FluidSumsKernel{view(b), b.material.burn ? b.material.eos->initial_energy() / b.material.density : 0});
}

}  // namespace brisance
