// SPDX-License-Identifier: Apache-2.0
// Pass 2: f_i/V_i = sum w (T_i + T_j) xi + sum w (a_i + a_j)(u_j - u_i) [+ viscosity], kick; and the drift.
//
// Pairwise viscosity in total-Lagrangian form, with x = x_j - x_i, v = v_j - v_i at t_n, only where x.v < 0:
//   mu = h x.v/(x^2 + 0.01 h^2),  q = rho (-alpha c mu + beta mu^2) >= 0,  f_ij/V_i = -w q x     (central: angular momentum is kept)
// and its heat -f_ij.v/2 to each of the two.
#include "exec/launch.h"
#include "formulations/total_lagrangian/total_lagrangian.h"
#include "particles/periodic_images.h"

#include <algorithm>

namespace brisance {

namespace {

template <class V>
struct Force {
    V x{}, y{}, z{};
    V vx{}, vy{}, vz{}, heat{};  // the viscous part
};

/// Constants of the pairwise viscosity.
template <class R>
struct Viscosity {
    R alpha_c = 0, beta = 0, rho = 0;
};

/// The force per volume on the particles in slots base, base + 1, ... of a column.
template <class V, bool masked, bool viscous, class R>
BRISANCE_HD Force<V> gather_force(const SolidView<R>& b, const PairsView<R>& pairs, std::int64_t i, std::int32_t column, const Viscosity<R>& visc) {
    const std::int64_t c = column;
    const R layer = static_cast<R>(b.dz);
    const R *t0 = b.T[0] + i, *t1 = b.T[1] + i, *t2 = b.T[2] + i, *t3 = b.T[3] + i, *t4 = b.T[4] + i, *t5 = b.T[5] + i, *t6 = b.T[6] + i,
            *t7 = b.T[7] + i, *t8 = b.T[8] + i;
    const R *ux = b.u[0] + i, *uy = b.u[1] + i, *uz = b.u[2] + i, *stiffness = b.stiffness + i;
    const float* live = b.live + i;
    const V xi = load<V>(ux), yi = load<V>(uy), zi = load<V>(uz), ai = load<V>(stiffness);
    [[maybe_unused]] const R *vx = nullptr, *vy = nullptr, *vz = nullptr;
    [[maybe_unused]] V vxi{}, vyi{}, vzi{};
    if constexpr (viscous) {
        vx = b.v_now[0] + i;
        vy = b.v_now[1] + i;
        vz = b.v_now[2] + i;
        vxi = load<V>(vx);
        vyi = load<V>(vy);
        vzi = load<V>(vz);
    }
    Force<V> f;
    V gx{}, gy{}, gz{};  // sum w xi of a masked tile
    V kx{}, ky{}, kz{};  // zero-energy control
    for (std::int64_t p = pairs.begin[c]; p < pairs.begin[c + 1]; ++p) {
        const ColumnPair<R>& pair = pairs.pairs[p];
        const R* w = pairs.w + pair.weights;
        V sxx{}, sxy{}, syx{}, syy{}, szx{}, szy{};
        [[maybe_unused]] V m0{}, m1{};
        R z = pair.z_first;
        for (int o = 0; o < pair.count; ++o, z += layer) {
            const std::int64_t j = pair.shift + o;
            V weight = broadcast<V>(w[o]);
            if constexpr (masked) {
                weight = weight * load_float<V>(live + j);
                m0 += weight;
                m1 += weight * z;
            }
            const V wz = weight * z;
            sxx += weight * load<V>(t0 + j);
            sxy += weight * load<V>(t1 + j);
            f.x += wz * load<V>(t2 + j);
            syx += weight * load<V>(t3 + j);
            syy += weight * load<V>(t4 + j);
            f.y += wz * load<V>(t5 + j);
            szx += weight * load<V>(t6 + j);
            szy += weight * load<V>(t7 + j);
            f.z += wz * load<V>(t8 + j);
            const V spring = weight * (ai + load<V>(stiffness + j));
            const V dx = load<V>(ux + j) - xi, dy = load<V>(uy + j) - yi, dz = load<V>(uz + j) - zi;
            kx += spring * dx;
            ky += spring * dy;
            kz += spring * dz;
            if constexpr (viscous) {
                const V x = dx + pair.dx, y = dy + pair.dy, zz = dz + z;
                const V dvx = load<V>(vx + j) - vxi, dvy = load<V>(vy + j) - vyi, dvz = load<V>(vz + j) - vzi;
                const V xv = vmin(x * dvx + y * dvy + zz * dvz, V{});
                const V mu = pair.h * xv / (x * x + y * y + zz * zz + R(0.01) * pair.h * pair.h);
                const V q = weight * (visc.rho * mu * (visc.beta * mu - visc.alpha_c));
                f.vx -= q * x;
                f.vy -= q * y;
                f.vz -= q * zz;
                f.heat -= R(0.5) * q * xv;
            }
        }
        f.x += sxx * pair.dx + sxy * pair.dy;
        f.y += syx * pair.dx + syy * pair.dy;
        f.z += szx * pair.dx + szy * pair.dy;
        if constexpr (masked) {
            gx += m0 * pair.dx;
            gy += m0 * pair.dy;
            gz += m1;
        }
    }
    if constexpr (!masked) {
        const double* g = pairs.g_sum + 3 * c;
        gx = broadcast<V>(R(g[0]));
        gy = broadcast<V>(R(g[1]));
        gz = broadcast<V>(R(g[2]));
    }
    f.x += load<V>(t0) * gx + load<V>(t1) * gy + load<V>(t2) * gz + kx;
    f.y += load<V>(t3) * gx + load<V>(t4) * gy + load<V>(t5) * gz + ky;
    f.z += load<V>(t6) * gx + load<V>(t7) * gy + load<V>(t8) * gz + kz;
    if constexpr (masked) {
        const V on = load_float<V>(live);
        f.x *= on;
        f.y *= on;
        f.z *= on;
        f.vx *= on;
        f.vy *= on;
        f.vz *= on;
        f.heat *= on;
    }
    return f;
}

/// v += kick f/m for the particles of a pack. Gives the viscous heat, J.
template <class V, bool viscous>
struct KickKernel {
    using R = ScalarOf<V>;
    SolidView<R> b;
    PairsView<R> pairs;
    Viscosity<R> viscosity;
    R kick, scale, inverse_density;

    BRISANCE_HD double operator()(std::int64_t n) const {
        const Tile tile = b.pack(n);
        const std::int64_t i = tile.base;
        const Force<V> f = tile.masked ? gather_force<V, true, viscous>(b, pairs, i, tile.column, viscosity) : gather_force<V, false, viscous>(b, pairs, i, tile.column, viscosity);
        const V fs[3] = {f.x + f.vx, f.y + f.vy, f.z + f.vz}, viscous_part[3] = {f.vx, f.vy, f.vz};
        for (int k = 0; k < 3; ++k) {
            store(b.v[k] + i, load<V>(b.v[k] + i) + scale * fs[k]);
            if constexpr (viscous) {
                store(b.acceleration[k] + i, inverse_density * fs[k]);
                store(b.viscous_force[k] + i, viscous_part[k]);
            }
        }
        if constexpr (!viscous) return 0;
        const V gained = kick * f.heat;
        store(b.energy + i, load<V>(b.energy + i) + gained);
        double heat = 0;
        for (int l = 0; l < lanes<R>; ++l)
            if (b.flags[i + l] & slot_own) heat += static_cast<double>(lane(gained, l));
        return heat * b.volume(b.columns[tile.column]);
    }
};

template <class V>
struct DriftKernel {
    using R = ScalarOf<V>;
    SolidView<R> b;
    R dt;
    BRISANCE_HD void operator()(std::int64_t n) const {
        const std::int64_t i = b.pack(n).base;
        for (int k = 0; k < 3; ++k) store(b.u[k] + i, load<V>(b.u[k] + i) + dt * load<V>(b.v[k] + i));
    }
};

/// v_now is renewed only here, since neighbours read it during a kick: v at the t_n that the drift arrives at is v_n+1/2 + dt/2 a_n.
template <class V>
struct ExtrapolateKernel {
    using R = ScalarOf<V>;
    SolidView<R> b;
    R half, half_kick, full_kick;
    BRISANCE_HD void operator()(std::int64_t n) const {
        const std::int64_t i = b.pack(n).base;
        V missed{};
        for (int k = 0; k < 3; ++k) {
            const V v = load<V>(b.v[k] + i), a = load<V>(b.acceleration[k] + i), mean = v - half_kick * a;
            missed += load<V>(b.viscous_force[k] + i) * (mean - load<V>(b.v_now[k] + i));
            store(b.v_now[k] + i, v + half * a);
        }
        store(b.energy + i, load<V>(b.energy + i) - full_kick * missed);
    }
};

template <class R>
struct SumsKernel {
    SolidView<R> b;
    bool has_damage;
    double threshold;
    BRISANCE_HD BodySums operator()(std::int64_t n) const {
        const Tile tile = b.pack(n);
        const Column& c = b.columns[tile.column];
        BodySums s;
        for (std::int64_t i = tile.base; i < tile.base + lanes<R>; ++i) {
            if (!(b.flags[i] & slot_own)) continue;
            const double vx = static_cast<double>(b.v[0][i]), vy = static_cast<double>(b.v[1][i]), vz = static_cast<double>(b.v[2][i]);
            s.kinetic += 0.5 * (vx * vx + vy * vy + vz * vz);
            s.px += vx;
            s.py += vy;
            s.pz += vz;
            s.internal += static_cast<double>(b.energy[i]);
            s.mass += 1;
            s.damaged += (has_damage ? static_cast<double>(b.state[0][i]) : 0.0) > threshold;
        }
        const double m = b.mass(c);
        s.mass *= m;
        s.kinetic *= m;
        s.px *= m;
        s.py *= m;
        s.pz *= m;
        s.internal *= b.volume(c);
        return s;
    }
};

}  // namespace

template <class R>
void complete(SolidBody<R>& b) {
    fill_images(b.layout, {b.live.data()});
    fill_images(b.layout, {b.stiffness.data()});
    fill_images(b.layout, b.v);
}

template <class R>
double kick(SolidBody<R>& b, const ColumnPairs<R>& pairs, double kick) {
    using V = Pack<R>;
    const double rho = b.material.density;
    const R scale = static_cast<R>(kick / rho), inverse_density = static_cast<R>(1 / rho);
    if (!b.options.pairwise) {
        const KickKernel<V, false> kernel{view(b), view(pairs), {}, static_cast<R>(kick), scale, inverse_density};
        exec::launch(packs(b), kernel);
        return 0;
    }
    const Viscosity<R> viscosity{static_cast<R>(b.options.alpha * b.material.sound_speed()), static_cast<R>(b.options.beta), static_cast<R>(rho)};
    return exec::launch_sum(packs(b), KickKernel<V, true>{view(b), view(pairs), viscosity, static_cast<R>(kick), scale, inverse_density});
}

template <class R>
void drift(SolidBody<R>& b, double dt, double kick) {
    using V = Pack<R>;
    exec::launch(packs(b), DriftKernel<V>{view(b), static_cast<R>(dt)}, 256);
    fill_images(b.layout, b.u);
    fill_images(b.layout, b.v);
    if (!b.options.pairwise) return;
    exec::launch(packs(b), ExtrapolateKernel<V>{view(b), static_cast<R>(0.5 * dt), static_cast<R>(0.5 * kick), static_cast<R>(kick)}, 256);
    fill_images(b.layout, b.v_now);
}

template <class R>
BodySums sums(const SolidBody<R>& b) {
    return exec::launch_sum(packs(b), BodySums{}, SumsKernel<R>{view(b), !b.state.empty(), b.options.failure.threshold});
}

template void complete(SolidBody<double>&);
template void complete(SolidBody<float>&);
template double kick(SolidBody<double>&, const ColumnPairs<double>&, double);
template double kick(SolidBody<float>&, const ColumnPairs<float>&, double);
template void drift(SolidBody<double>&, double, double);
template void drift(SolidBody<float>&, double, double);
template BodySums sums(const SolidBody<double>&);
template BodySums sums(const SolidBody<float>&);

}  // namespace brisance
