// SPDX-License-Identifier: Apache-2.0
// Pass 1: F from the neighbours' displacements, objective strain increment, equation of state, strength law, T = P K^-1 - a (F - I).
#include "exec/launch.h"
#include "formulations/total_lagrangian/misfit.h"
#include "formulations/total_lagrangian/total_lagrangian.h"
#include "laws/crack_band.h"
#include "laws/point.h"
#include "math/eigen.h"
#include "math/increment.h"
#include "particles/periodic_images.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

/// A tile's sums over its neighbours.
template <class V>
struct Gathered {
    Mat3<V> r{};         // sum w (u_j - u_i) (x) xi
    Sym3<V> k{}, k_inverse{};
};

/// K and its inverse where no neighbour is missing.
template <class V, class R>
BRISANCE_HD Gathered<V> whole(const PairsView<R>& pairs, std::int32_t column) {
    const double* n = pairs.k_inverse + 6 * static_cast<std::int64_t>(column);
    const Sym3<double> k_inverse{n[0], n[1], n[2], n[3], n[4], n[5]}, k = inverse(k_inverse);
    Gathered<V> g;
    for (std::size_t a = 0; a < 6; ++a) {
        component(g.k, a) = broadcast<V>(R(component(k, a)));
        component(g.k_inverse, a) = broadcast<V>(R(component(k_inverse, a)));
    }
    return g;
}

/// The sums of the particles in slots base, base + 1, ... of a column.
template <class V, bool masked, class R>
BRISANCE_HD Gathered<V> gather(const SolidView<R>& b, const PairsView<R>& pairs, std::int64_t base, std::int32_t column) {
    const std::int64_t c = column;
    const R layer = static_cast<R>(b.dz);
    const R *ux = b.u[0] + base, *uy = b.u[1] + base, *uz = b.u[2] + base;
    const float* live = b.live + base;
    const V xi = load<V>(ux), yi = load<V>(uy), zi = load<V>(uz);
    Gathered<V> g;
    if constexpr (!masked) g = whole<V>(pairs, column);
    Sym3<V> K{};
    for (std::int64_t p = pairs.begin[c]; p < pairs.begin[c + 1]; ++p) {
        const ColumnPair<R>& pair = pairs.pairs[p];
        const R* w = pairs.w + pair.weights;
        V sx{}, sy{}, sz{}, tx{}, ty{}, tz{};   // sums of w du and of w z du
        V m0{}, m1{}, m2{};                     // sums of w, w z, w z^2
        R z = pair.z_first;
        for (int o = 0; o < pair.count; ++o, z += layer) {
            const std::int64_t j = pair.shift + o;
            const V dx = load<V>(ux + j) - xi, dy = load<V>(uy + j) - yi, dz = load<V>(uz + j) - zi;
            V weight = broadcast<V>(w[o]);
            if constexpr (masked) {
                weight = weight * load_float<V>(live + j);
                m0 += weight;
                m1 += weight * z;
                m2 += weight * (z * z);
            }
            const V wx = weight * dx, wy = weight * dy, wz = weight * dz;
            sx += wx;
            sy += wy;
            sz += wz;
            tx += wx * z;
            ty += wy * z;
            tz += wz * z;
        }
        g.r.xx += sx * pair.dx;
        g.r.xy += sx * pair.dy;
        g.r.xz += tx;
        g.r.yx += sy * pair.dx;
        g.r.yy += sy * pair.dy;
        g.r.yz += ty;
        g.r.zx += sz * pair.dx;
        g.r.zy += sz * pair.dy;
        g.r.zz += tz;
        if constexpr (masked) {
            K.xx += m0 * (pair.dx * pair.dx);
            K.yy += m0 * (pair.dy * pair.dy);
            K.zz += m2;
            K.xy += m0 * (pair.dx * pair.dy);
            K.xz += m1 * pair.dx;
            K.yz += m1 * pair.dy;
        }
    }
    if constexpr (masked) {
        // A particle with too few neighbours, or with neighbours in one plane, has no gradient: K^-1 = 0 leaves it F = I and T = 0, and the
        // guard takes it out. det K/(tr K/3)^3 is 1 inside and at a plane surface, 0.6 at an edge, 0.3 at a corner.
        const V own = load_float<V>(live);
        const V t = trace(K);
        const auto good = (own * det(K) > R(0.1) * t * t * t * R(1.0 / 27.0)) & (t > R(0.1));
        const V one = broadcast<V>(R(1)), zero{};
        const Sym3<V> safe{good ? K.xx : one, good ? K.yy : one, good ? K.zz : one, good ? K.xy : zero, good ? K.xz : zero, good ? K.yz : zero};
        const V on = good ? one : zero;
        g.k = safe;
        g.k_inverse = scaled(inverse(safe), on);
        g.r = on * g.r;
    }
    return g;
}
template <class V, class R>
BRISANCE_HD Gathered<V> gather(const SolidView<R>& b, const PairsView<R>& pairs, const Tile& t) {
    return t.masked ? gather<V, true>(b, pairs, t.base, t.column) : gather<V, false>(b, pairs, t.base, t.column);
}
/// The same where only K is wanted.
template <class V, class R>
BRISANCE_HD Gathered<V> gather_k(const SolidView<R>& b, const PairsView<R>& pairs, const Tile& t) {
    return t.masked ? gather<V, true>(b, pairs, t.base, t.column) : whole<V>(pairs, t.column);
}

template <class V, class R> BRISANCE_INLINE Mat3<V> load_matrix(R* const (&a)[9], std::int64_t i) {
    return {load<V>(a[0] + i), load<V>(a[1] + i), load<V>(a[2] + i), load<V>(a[3] + i), load<V>(a[4] + i),
            load<V>(a[5] + i), load<V>(a[6] + i), load<V>(a[7] + i), load<V>(a[8] + i)};
}
template <class V, class R> BRISANCE_INLINE void store_matrix(R* const (&a)[9], std::int64_t i, const Mat3<V>& m) {
    store(a[0] + i, m.xx);
    store(a[1] + i, m.xy);
    store(a[2] + i, m.xz);
    store(a[3] + i, m.yx);
    store(a[4] + i, m.yy);
    store(a[5] + i, m.yz);
    store(a[6] + i, m.zx);
    store(a[7] + i, m.zy);
    store(a[8] + i, m.zz);
}

template <class V> BRISANCE_INLINE Mat3<V> plus_identity(Mat3<V> m) {
    using R = ScalarOf<V>;
    m.xx += R(1);
    m.yy += R(1);
    m.zz += R(1);
    return m;
}

/// sigma = P F^T/J from P K^-1.
template <class V> BRISANCE_INLINE Sym3<V> cauchy(const Mat3<V>& pk, const Sym3<V>& k, const Mat3<V>& f) {
    return scaled(symmetric_product(pk * k, f), ScalarOf<V>(1) / det(f));
}
/// P K^-1, P = J sigma F^-T.
template <class V> BRISANCE_INLINE Mat3<V> piola(const Sym3<V>& sigma, const Mat3<V>& cof, const Sym3<V>& k_inverse) { return (sigma * cof) * k_inverse; }
/// The deviator of a stress. It is not kept: it is that of the stress in T, with the R_sum and the control's stiffness of the same instant.
template <class V> BRISANCE_INLINE Sym3<V> deviator(Sym3<V> s) {
    const V mean = ScalarOf<V>(1.0 / 3.0) * trace(s);
    s.xx -= mean;
    s.yy -= mean;
    s.zz -= mean;
    return s;
}

/// The stress that T holds, with the K that it was made with.
template <class V, class R> BRISANCE_HD Sym3<V> kept_stress(const SolidView<R>& b, std::int64_t i, const Gathered<V>& g) {
    const Mat3<V> h = load_matrix<V>(b.R_sum, i) * g.k_inverse;
    return cauchy(load_matrix<V>(b.T, i) + load<V>(b.stiffness + i) * h, g.k, plus_identity(h));
}

template <class V> BRISANCE_INLINE void set_lane(V& v, int l, ScalarOf<V> x) {
    std::memcpy(reinterpret_cast<char*>(&v) + static_cast<std::size_t>(l) * sizeof(x), &x, sizeof(x));
}

/// What the packs of a body add up to.
struct StressSums {
    double rate = 0, zero_energy_lost = 0, bulk_viscous = 0;
    std::int64_t fastest = -1, torn = 0;
    BRISANCE_HD StressSums& operator+=(const StressSums& o) {
        if (o.rate > rate) {
            rate = o.rate;
            fastest = o.fastest;
        }
        zero_energy_lost += o.zero_energy_lost;
        bulk_viscous += o.bulk_viscous;
        torn += o.torn;
        return *this;
    }
};

/// Numbers of a material that hold for all its particles, GPa, g/cm3, mm/us.
struct Moduli {
    double density, bulk, longitudinal, shear, sound;
    explicit Moduli(const Material& m)
        : density(m.density), bulk(m.bulk_modulus()), longitudinal(m.longitudinal_modulus()), shear(m.strength->shear_modulus()), sound(m.sound_speed()) {}
};

/// `softens`: tensile failure takes a fracture energy. Few cases want it, and its lines would cost the others registers.
template <class V, class Laws, bool softens>
struct StressKernel {
    using R = ScalarOf<V>;
    SolidView<R> b;
    PairsView<R> pairs;
    Laws laws;
    Moduli moduli;
    FailureRule rule;
    double axis_x, axis_y;
    double linear, quadratic;  // bulk viscosity
    float time;
    R dt, kick, a0;
    int n_state;

    StressKernel(SolidBody<R>& body, const ColumnPairs<R>& bonds, const Laws& its_laws, double time_, double dt_, double kick_)
        : b(view(body)), pairs(view(bonds)), laws(its_laws), moduli(body.material), rule(body.options.failure), axis_x(body.axis_x), axis_y(body.axis_y),
          linear(body.options.linear), quadratic(body.options.quadratic), time(static_cast<float>(time_)), dt(static_cast<R>(dt_)), kick(static_cast<R>(kick_)),
          a0(static_cast<R>(body.options.zero_energy * moduli.longitudinal)), n_state(static_cast<int>(body.state.size())) {}

    BRISANCE_HD StressSums operator()(std::int64_t n) const {
        const Tile tile = b.pack(n);
        return update(tile, gather<V>(b, pairs, tile));
    }

private:
    BRISANCE_HD StressSums update(const Tile& tile, const Gathered<V>& g) const {
        const std::int64_t i = tile.base;
        const Column& column = b.columns[tile.column];
        const V zero{}, one = broadcast<V>(R(1)), on = load_float<V>(b.live + i);
        const auto alive = on > R(0);

        // kinematics
        const Mat3<V> r_old = load_matrix<V>(b.R_sum, i);
        const Mat3<V> h_old = r_old * g.k_inverse, h_new = g.r * g.k_inverse;  // F - I
        const Mat3<V> f_old = plus_identity(h_old), f_new = plus_identity(h_new);
        const Increment<V> step = increment(f_old, f_new);
        const Mat3<V> cof = cofactor(f_new);
        const V jacobian = f_new.xx * cof.xx + f_new.xy * cof.xy + f_new.xz * cof.xz;
        const V safe_j = vmax(jacobian, broadcast<V>(R(0.05)));

        // energy up to the last kick: the old stress worked over half of the drift before it and half of the one after
        const V a_old = load<V>(b.stiffness + i);
        const Mat3<V> dr = g.r - r_old, pk_old = load_matrix<V>(b.T, i) + a_old * h_old;
        const V work = ddot(pk_old, dr);
        V energy = load<V>(b.energy + i) + R(0.5) * kick * (load<V>(b.power + i) + work / dt);

        // pressure and strength
        SolidPoint<V> p{};
        p.d = step.d;
        const Sym3<V> sigma_old = cauchy(pk_old, g.k, f_old);
        p.s = rotated(step.rotation, deviator(sigma_old));
        // What the way from T to the stress and back loses by rounding has a sign: in single precision a stress at rest would be off by 1 % after
        // 10^5 steps. So it is carried over.
        constexpr bool single = sizeof(R) == sizeof(float);
        [[maybe_unused]] Mat3<V> lost;
        if constexpr (single) lost = pk_old - piola(sigma_old, cofactor(f_old), g.k_inverse);
        p.dt = broadcast<V>(dt);
        p.scale = b.scale ? load<V>(b.scale + i) : one;
        for (int k = 0; k < n_state; ++k)
            if (b.state[k]) p.state[k] = load<V>(b.state[k] + i);
        const V damage_old = n_state > 0 ? p.state[0] : zero;
        const V expansion = trace(step.d);
        [[maybe_unused]] V opening{}, lift{};
        if constexpr (softens) {
            opening = load<V>(b.opening + i);
            lift = R(moduli.bulk) * opening;
        }
        const V bulk = advance(laws, p, safe_j, energy, softens ? &lift : nullptr);
        if constexpr (softens) crack(p, column, opening);
        failure(p, tile, column, damage_old);

        // bulk viscosity: q = rho l (C_q l e^2 - C_l c e) in compression, e = tr D < 0
        StressSums report;
        const V modulus = bulk + p.shear_stiffness;
        const R rho = static_cast<R>(moduli.density);
        const V sound = vsqrt(modulus * vmax(one, safe_j) / rho);
        V q = zero;
        if (linear > 0 || quadratic > 0) {
            const R length = static_cast<R>(std::cbrt(b.volume(column)));  // l, as in LS-DYNA
            const V e = vmin(expansion / dt, zero);
            q = (rho / safe_j) * length * e * (R(quadratic) * length * e - R(linear) * sound);
        }

        // stress and what the sums need
        const V total = p.pressure + q;
        const Sym3<V> sigma{p.s.xx - total, p.s.yy - total, p.s.zz - total, p.s.xy, p.s.xz, p.s.yz};
        Mat3<V> pk = piola(sigma, cof, g.k_inverse);
        if constexpr (single) pk = pk + lost;
        const V k_on = alive ? one : zero;
        V a_keep = a0 * p.integrity * k_on;
        if constexpr (softens) {
            // What F does not see beside an opening crack is its opening, and no zero-energy mode: the control must not pull it shut. In
            // tension, beyond a fifth of the strain of failure, it is softened as (strain/misfit)^2, for good, so that its force falls as
            // the crack opens. Sum w xi xi being the unit tensor, misfit/3 is the square of a strain.
            const R strain = R(0.2 * rule.tensile / moduli.longitudinal);
            const V limit = broadcast<V>(R(3) * strain * strain);
            const V unseen = misfit<V>(b, pairs, tile, R(0), g.k_inverse);
            const V soft = ((unseen > limit) & (p.pressure < zero)) ? limit / vmax(unseen, limit) : one;
            a_keep = vmin(a_keep * soft, a_old);
        }
        const auto put = [&](int n, V pk_n, V h_n) { store(b.T[n] + i, (alive ? pk_n - a_keep * h_n : zero)); };
        put(0, pk.xx, h_new.xx);
        put(1, pk.xy, h_new.xy);
        put(2, pk.xz, h_new.xz);
        put(3, pk.yx, h_new.yx);
        put(4, pk.yy, h_new.yy);
        put(5, pk.yz, h_new.yz);
        put(6, pk.zx, h_new.zx);
        put(7, pk.zy, h_new.zy);
        put(8, pk.zz, h_new.zz);

        store_matrix(b.R_sum, i, g.r);
        const auto keep = [&](R* a, V x) { store(a + i, (alive ? x : load<V>(a + i))); };
        store_float(b.pressure + i, alive ? p.pressure : zero);
        if constexpr (softens) keep(b.opening, opening);
        keep(b.energy, energy);
        store(b.power + i, alive ? ddot(pk, dr) / dt : zero);
        store(b.stiffness + i, a_keep);
        for (int k = 0; k < n_state; ++k)
            if (b.state[k]) keep(b.state[k], p.state[k]);
        if (b.yield) store_float(b.yield + i, p.yield);

        // sums of the tile: only lanes that are particles
        const V own = owned(i) * k_on;
        const double volume = b.volume(column);
        const V softened = own * vmax(a_old - a_keep, zero);
        if (hmax(softened) > R(0))
            report.zero_energy_lost = 0.5 * volume * static_cast<double>(hsum(softened * misfit<V>(b, pairs, tile, dt, g.k_inverse)));
        report.bulk_viscous = volume * static_cast<double>(hsum(-own * q * safe_j * expansion));

        // stable step: the least stretch lambda_min from B = F^-1 F^-T
        const Mat3<V> ct = transpose(cof);
        const Sym3<V> B = scaled(symmetric_product(ct, ct), R(1) / (safe_j * safe_j));
        // (tr B^4 / 3)^(1/8) ~ 1/lambda_min: exact for equal stretches, 13 % below where only one is compressed to a half
        const Mat3<V> bb = Mat3<V>{B.xx, B.xy, B.xz, B.xy, B.yy, B.yz, B.xz, B.yz, B.zz} * B;
        const V inverse_stretch = vsqrt(vsqrt(vsqrt(R(1.0 / 3.0) * ddot(bb, bb))));
        const R spacing = static_cast<R>(std::min(column.spacing, b.dz));
        const V own_rate = sound * inverse_stretch * (R(1) / spacing);
        // rock that has failed and is not pressed bears nothing and is no spring
        const auto bears = (p.integrity > R(0)) | (total > R(0));
        const V rate = bears ? own_rate : zero;
        const R at_rest = static_cast<R>(moduli.sound) / spacing;

        // The guard: what has no meaning as a deformation any more, what has given away more energy than matter holds at room temperature
        // (copper: 0.7 % of its bulk modulus), and failed particles so distorted that they alone would hold the step.
        const V size = ddot(f_new, f_new);
        const auto ok = (trace(g.k_inverse) > R(0)) & (jacobian > R(0.4)) & (jacobian < R(8)) & (size < R(40)) & (energy > R(-0.02 * moduli.bulk)) & (energy < R(1e6)) &
                        ((p.integrity > R(0.5)) | (rate < R(3) * at_rest));
        const V bad = alive ? (ok ? zero : one) : zero;
        report.rate = static_cast<double>(hmax(own * (one - bad) * rate));
        report.fastest = i;
        report.torn = hmax(bad * owned(i)) > R(0) ? 1 : 0;
        if (report.torn > 0)
            for (int l = 0; l < lanes<R>; ++l)
                if (lane(bad, l) > R(0) && (b.flags[i + l] & slot_own))
                    b.flags[i + l] |= slot_torn;
        return report;
    }

    BRISANCE_HD V owned(std::int64_t i) const {
        V v{};
        if constexpr (lanes_of<V> == 1) v = R(b.flags[i] & slot_own);
        else
            for (int l = 0; l < lanes<R>; ++l) v[l] = R(b.flags[i + l] & slot_own);
        return v;
    }

    /// Cracks of a given fracture energy, lane by lane: few lanes have any.
    BRISANCE_HD void crack(SolidPoint<V>& p, const Column& column, V& opening) const {
        const R strength = static_cast<R>(rule.tensile);
        const V bound = R(2.0 / 3.0) * mises(p.s) - p.pressure;  // no principal stress is larger
        const auto busy = (bound > strength * p.scale * (broadcast<V>(R(1)) - p.state[0])) | ((opening > V{}) & (p.pressure > V{}));
        const V any = busy ? broadcast<V>(R(1)) : V{};
        if (!(hmax(any) > R(0))) return;
        const double width = crack_band_spacings * std::cbrt(b.volume(column)), k = moduli.bulk, g = moduli.shear;
        for (int l = 0; l < lanes<R>; ++l) {
            if (lane(any, l) == R(0)) continue;
            const double place = rule.tensile * static_cast<double>(lane(p.scale, l));
            Sym3<double> s;
            for (std::size_t c = 0; c < 6; ++c) component(s, c) = static_cast<double>(lane(component(p.s, c), l));
            double pressure = static_cast<double>(lane(p.pressure, l)), damage = static_cast<double>(lane(p.state[0], l)), open = static_cast<double>(lane(opening, l));
            open_crack({place, full_strain(rule.fracture_energy, place, width, 9 * k * g / (3 * k + g)), k, g}, s, pressure, damage, open);
            for (std::size_t c = 0; c < 6; ++c) set_lane(component(p.s, c), l, R(component(s, c)));
            set_lane(p.pressure, l, R(pressure));
            set_lane(p.state[0], l, R(damage));
            set_lane(opening, l, R(open));
            set_lane(p.integrity, l, R(std::min(static_cast<double>(lane(p.integrity, l)), 1 - damage)));
        }
    }

    /// Failure beside the law's own, and what is noted for analysis.
    BRISANCE_HD void failure(SolidPoint<V>& p, const Tile& tile, const Column& column, const V& damage_old) const {
        const std::int64_t i = tile.base;
        const V zero{}, one = broadcast<V>(R(1));

        const double rx = column.x - axis_x, ry = column.y - axis_y, r = std::sqrt(rx * rx + ry * ry);
        const R nx = static_cast<R>(r > 0 ? rx / r : 1), ny = static_cast<R>(r > 0 ? ry / r : 0);
        const V radial = p.pressure - (p.s.xx * (nx * nx) + p.s.yy * (ny * ny) + p.s.xy * (R(2) * nx * ny));
        store_float(b.peak_pressure + i, vmax(load_float<V>(b.peak_pressure + i), p.pressure));
        store_float(b.peak_radial + i, vmax(load_float<V>(b.peak_radial + i), radial));
        if (n_state == 0) return;

        // Principal stresses are wanted only where a bound on them can exceed what was seen before, in whole rock.
        const V eq = mises(p.s);
        const V seen_1 = load_float<V>(b.sigma_1 + i), seen_tau = load_float<V>(b.tau_max + i);
        const V whole = (damage_old < R(rule.threshold)) ? one : zero;
        const V bound = vmax(R(2.0 / 3.0) * eq - p.pressure - seen_1, R(0.57735026919) * eq - seen_tau);
        const bool look = hmax(whole * bound) > R(0) && hmax(whole * eq) > static_cast<R>(rule.notice);
        if (look) {
            const Principal<V> s = principal(p.s);
            const V one_now = s.one - p.pressure, tau_now = R(0.5) * (s.one - s.three);
            store_float(b.sigma_1 + i, whole * vmax(seen_1, one_now) + (one - whole) * seen_1);
            store_float(b.tau_max + i, whole * vmax(seen_tau, tau_now) + (one - whole) * seen_tau);
            if (rule.tensile > 0 && rule.fracture_energy <= 0) p.state[0] = (one_now > R(rule.tensile) * p.scale) ? one : p.state[0];
            if (rule.shear > 0) p.state[0] = (tau_now > R(rule.shear) * p.scale) ? one : p.state[0];
        }
        if (rule.mode > 0) {
            // row 9 of the discrepancies: a failed particle bears no tension and no shear, or nothing at all
            const auto failed = p.state[0] >= one;
            const V keep = failed ? zero : one;
            p.s = scaled(p.s, keep);
            p.pressure = failed ? (rule.mode == 2 ? zero : vmax(p.pressure, zero)) : p.pressure;
            p.integrity = failed ? zero : p.integrity;
        }
        const V now = p.state[0];
        if (hmax(now - damage_old) > R(0))
            for (int l = 0; l < lanes<R>; ++l) {
                if (lane(now, l) >= R(rule.threshold) && b.failure_time[i + l] < 0) b.failure_time[i + l] = time;
            }
    }

};

/// Takes the newly torn particles out of the sums: their neighbours' tiles become masked, keep their stress and get their R_sum and T afresh,
/// so that the change of the sums is not mistaken for a deformation. Rare, so the processor's.
template <class R>
void tear(SolidBody<R>& b, const ColumnPairs<R>& pairs, StressReport& report) {
    const exec::HostAccess host;
    using V = Pack<R>;
    std::vector<std::size_t> torn;
    std::vector<bool> is_touched(b.layout.tiles.size(), false);
    std::vector<std::size_t> first_tile(b.layout.columns.size() + 1, 0);
    for (const Tile& t : b.layout.tiles) ++first_tile[static_cast<std::size_t>(t.column) + 1];
    for (std::size_t c = 0; c < b.layout.columns.size(); ++c) first_tile[c + 1] += first_tile[c];
    const auto column_of = [&](std::int64_t slot) {
        const auto it = std::upper_bound(b.layout.columns.begin(), b.layout.columns.end(), slot,
                                         [](std::int64_t s, const Column& c) { return s < c.start; });
        return static_cast<std::size_t>(it - b.layout.columns.begin()) - 1;
    };
    for (std::size_t k = 0; k < b.layout.flags.size(); ++k) {
        if (!(b.layout.flags[k] & slot_torn) || b.live[k] == 0) continue;
        torn.push_back(k);
        const std::size_t c = column_of(static_cast<std::int64_t>(k));
        for (std::int64_t p = pairs.begin[c]; p < pairs.begin[c + 1]; ++p) {
            const ColumnPair<R>& pair = pairs.pairs[static_cast<std::size_t>(p)];
            const std::size_t other = column_of(b.layout.columns[c].start + pair.shift + pair.count);  // the offset after the last: from 0 to the pad
            for (std::size_t t = first_tile[other]; t < first_tile[other + 1]; ++t) is_touched[t] = true;
        }
        for (std::size_t t = first_tile[c]; t < first_tile[c + 1]; ++t) is_touched[t] = true;
    }
    const SolidView<R> body = view(b);
    const PairsView<R> bonds = view(pairs);
    std::vector<std::int64_t> touched;  // packs of tiles, numbered as the kernels do
    for (std::size_t t = 0; t < is_touched.size(); ++t)
        for (std::int64_t p = 0; is_touched[t] && p < std::int64_t{1} << body.packs_shift; ++p) touched.push_back((static_cast<std::int64_t>(t) << body.packs_shift) + p);
    std::vector<Sym3<V>> stress_of(touched.size());
    const auto each_touched = [&](auto&& f) {
        exec::for_each(static_cast<std::int64_t>(touched.size()), [&](std::int64_t n) { f(body.pack(touched[static_cast<std::size_t>(n)]), stress_of[static_cast<std::size_t>(n)]); });
    };
    each_touched([&](const Tile& pack, Sym3<V>& sigma) { sigma = kept_stress(body, pack.base, gather_k<V>(body, bonds, pack)); });
    for (const std::size_t k : torn) {
        b.live[k] = 0;
        b.pressure[k] = 0;
        b.power[k] = b.stiffness[k] = R(0);
    }
    for (std::size_t t = 0; t < is_touched.size(); ++t)
        if (is_touched[t]) b.layout.tiles[t].masked = true;
    fill_images(b.layout, {b.live.data()});
    each_touched([&](const Tile& pack, const Sym3<V>& sigma) {
        const std::int64_t i = pack.base;
        const Gathered<V> g = gather<V>(body, bonds, pack);
        const Mat3<V> h = g.r * g.k_inverse, t = piola(sigma, cofactor(plus_identity(h)), g.k_inverse) - load<V>(body.stiffness + i) * h;
        store_matrix(body.R_sum, i, g.r);
        store_matrix(body.T, i, t);
    });
    for (auto& a : b.T)  // theirs may be no number
        for (const std::size_t k : torn) a[k] = R(0);
    report.torn += static_cast<std::int64_t>(torn.size());
}

}  // namespace

template <class R>
StressReport stress(SolidBody<R>& body, const ColumnPairs<R>& pairs, double time, double dt, double kick) {
    const StressSums sums = with_laws<StressSums>(body.material, [&](const auto& laws) {
        using Laws = std::remove_cvref_t<decltype(laws)>;
        if (body.options.failure.fracture_energy > 0) return exec::launch_sum(packs(body), StressSums{}, StressKernel<Pack<R>, Laws, true>(body, pairs, laws, time, dt, kick));
        return exec::launch_sum(packs(body), StressSums{}, StressKernel<Pack<R>, Laws, false>(body, pairs, laws, time, dt, kick));
    });
    StressReport out;
    out.rate = sums.rate;
    out.fastest = sums.rate > 0 ? sums.fastest : -1;
    out.zero_energy_lost = sums.zero_energy_lost;
    out.bulk_viscous = sums.bulk_viscous;
    if (sums.torn > 0) tear(body, pairs, out);
    auto& T = body.T;
    fill_images(body.layout, {T[0].data(), T[1].data(), T[2].data(), T[3].data(), T[4].data(), T[5].data(), T[6].data(), T[7].data(),
                              T[8].data(), body.stiffness.data()});
    return out;
}

namespace {

/// What the control of a pack's particles has stored, J.
template <class V>
struct ControlKernel {
    using R = ScalarOf<V>;
    SolidView<R> b;
    PairsView<R> pairs;
    R dt;
    BRISANCE_HD double operator()(std::int64_t n) const {
        const Tile tile = b.pack(n);
        const V stored = load<V>(b.stiffness + tile.base) * misfit<V>(b, pairs, tile, dt, gather_k<V>(b, pairs, tile).k_inverse);
        double sum = 0;
        for (int l = 0; l < lanes<R>; ++l)
            if (b.flags[tile.base + l] & slot_own) sum += static_cast<double>(lane(stored, l));
        return 0.5 * b.volume(b.columns[tile.column]) * sum;
    }
};

}  // namespace

template <class R>
double control_energy(const SolidBody<R>& b, const ColumnPairs<R>& pairs, double dt) {
    return exec::launch_sum(packs(b), ControlKernel<Pack<R>>{view(b), view(pairs), static_cast<R>(dt)});
}

template <class R>
void deviators(const SolidBody<R>& body, const ColumnPairs<R>& pairs, const Tile& tile, Sym3<double>* s) {
    using V = Pack<R>;
    const SolidView<R> b = view(body);
    for (int first = 0; first < body.layout.width; first += lanes<R>) {
        const Tile pack{tile.base + first, tile.column, tile.masked};
        const Sym3<V> of_pack = deviator(kept_stress(b, pack.base, gather_k<V>(b, view(pairs), pack)));
        for (int l = 0; l < lanes<R>; ++l)
            for (std::size_t a = 0; a < 6; ++a) component(s[first + l], a) = static_cast<double>(lane(component(of_pack, a), l));
    }
}

template void deviators(const SolidBody<double>&, const ColumnPairs<double>&, const Tile&, Sym3<double>*);
template void deviators(const SolidBody<float>&, const ColumnPairs<float>&, const Tile&, Sym3<double>*);
template double control_energy(const SolidBody<double>&, const ColumnPairs<double>&, double);
template double control_energy(const SolidBody<float>&, const ColumnPairs<float>&, double);
template StressReport stress(SolidBody<double>&, const ColumnPairs<double>&, double, double, double);
template StressReport stress(SolidBody<float>&, const ColumnPairs<float>&, double, double, double);

}  // namespace brisance
