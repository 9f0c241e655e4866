// SPDX-License-Identifier: Apache-2.0
#include "laws/point_path.h"

#include "base/error.h"
#include "laws/point.h"
#include "math/increment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

/// Logarithmic strains x, y, z and the shear gamma: F = (I + gamma e_x e_y) diag(exp(strain)).
struct Deformation {
    Vec3<double> log_strain{};
    double shear = 0;
    Mat3<double> gradient() const {
        const double x = std::exp(log_strain.x), y = std::exp(log_strain.y), z = std::exp(log_strain.z);
        return {x, shear * y, 0, 0, y, 0, 0, 0, z};
    }
    double volume() const { return std::exp(log_strain.x + log_strain.y + log_strain.z); }
};

/// Everything a point remembers.
struct State {
    Deformation shape;
    SolidPoint<double> point{};
    Mat3<double> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< of the step that led here
    double bulk = 0, energy = 0;  ///< GPa
    Sym3<double> stress() const {
        const Sym3<double>& s = point.s;
        return {s.xx - point.pressure, s.yy - point.pressure, s.zz - point.pressure, s.xy, s.xz, s.yz};
    }
    Mat3<double> piola() const { return stress() * cofactor(shape.gradient()); }  ///< P = J sigma F^-T, which works over dF
};

class Driver {
public:
    Driver(const Material& material, const PointPath& path) : m_(material), path_(path) {
        now_.energy = m_.eos->initial_energy();
        now_.point.scale = path.scale;
        if (m_.strength) {
            const std::vector<StateInfo> rows = m_.strength->state();
            for (std::size_t k = 0; k < rows.size(); ++k) now_.point.state[k] = rows[k].initial;
            columns_ = rows.size();
            if (path.damage > 0 && columns_ > 0 && rows[0].name == "damage") now_.point.state[0] = path.damage;
        }
        if (path.damage > 0 && now_.point.state[0] != path.damage) {
            throw InputError(fmt::format("a damage of {:g} at the start: the laws of {} have none", path.damage, m_.name));
        }
        now_ = moved(now_, now_.shape, 1);
        rest_stress_ = m_.burn ? 0.0 : now_.point.pressure;  // an explosive before it is lit bears nothing
    }

    std::vector<PathPoint> run() {
        note(0);
        for (std::size_t k = 0; k < path_.legs.size(); ++k) {
            const PathLeg& leg = path_.legs[k];
            const int number = static_cast<int>(k) + 1;
            switch (leg.kind) {
                case PathLeg::Kind::strain: strain(leg, number); break;
                case PathLeg::Kind::axial: axial(leg, number); break;
                case PathLeg::Kind::pressure: pressure(leg, number); break;
                case PathLeg::Kind::shock: shock(leg, number); break;
                case PathLeg::Kind::volume: volume(leg, number); break;
                case PathLeg::Kind::cj: chapman_jouguet_state(number); break;
            }
        }
        return std::move(rows_);
    }

private:
    /// The state after a step to another shape in the time dt.
    State moved(const State& from, const Deformation& shape, double dt) const {
        State s = prepared(from, shape, dt);
        const Mat3<double> df = shape.gradient() - from.shape.gradient();
        const double half = from.energy + 0.5 * ddot(from.piola(), df);
        s.bulk = advance(ErasedLaws(m_), s.point, shape.volume(), half);
        s.energy = half + 0.5 * ddot(s.piola(), df);
        return s;
    }

    /// The state after a shock from rest to this shape: E = E_0 + (sigma + sigma_0)(1 - V)/2, sigma the axial stress in compression.
    /// The law answers to E with a stress, so the two are iterated.
    State shocked(const State& from, const Deformation& shape, double dt) const {
        const State ready = prepared(from, shape, dt);
        const double swept = 0.5 * (1 - shape.volume()), e0 = m_.eos->initial_energy();
        const EosTerms<double> t = m_.eos->terms(ready.point.mu);
        State s = ready;
        // an impossible compression has no positive denominator
        double energy = (e0 + swept * (t.a + rest_stress_)) / std::max(1 - swept * t.b, 1e-6);
        for (int i = 0; i < 60; ++i) {
            s = ready;
            s.point.energy = energy;
            s.bulk = respond(ErasedLaws(m_), s.point, t);
            const double next = e0 + swept * (-s.stress().zz + rest_stress_);
            const double change = (next - energy) / std::max(1 - swept * t.b, 1e-6);
            energy += change;
            if (std::abs(change) <= 1e-15 * (1 + std::abs(energy))) break;
        }
        s.energy = energy;
        return s;
    }

    /// Strain increment and rotated deviator of a step.
    State prepared(const State& from, const Deformation& shape, double dt) const {
        State s = from;
        const Increment<double> step = increment(from.shape.gradient(), shape.gradient());
        s.rotation = step.rotation;
        s.shape = shape;
        s.point.d = step.d;
        s.point.s = rotated(step.rotation, from.point.s);
        s.point.mu = 1 / shape.volume() - 1;
        s.point.dt = dt;
        return s;
    }

    static Vec3<double> logs(const Vec3<double>& e) { return {std::log1p(e.x), std::log1p(e.y), std::log1p(e.z)}; }
    static double largest(const Deformation& a, const Deformation& b) {
        return std::max({std::abs(a.log_strain.x - b.log_strain.x), std::abs(a.log_strain.y - b.log_strain.y),
                         std::abs(a.log_strain.z - b.log_strain.z), std::abs(a.shear - b.shear)});
    }
    static double duration(const Deformation& a, const Deformation& b, double rate) { return std::max(largest(a, b) / rate, 1e-9); }

    void strain(const PathLeg& leg, int number) {
        const Deformation from = now_.shape;
        const Vec3<double> to = logs(leg.strain);
        for (int i = 1; i <= leg.steps; ++i) {
            const double f = static_cast<double>(i) / leg.steps;
            take(moved_to({from.log_strain + f * (to - from.log_strain), from.shear + f * (leg.shear - from.shear)}, leg.rate), number);
        }
    }

    void axial(const PathLeg& leg, int number) {
        const double from = now_.shape.log_strain.z, to = std::log1p(leg.strain.z);
        double lateral_step = 0;
        for (int i = 1; i <= leg.steps; ++i) {
            const double z = from + (to - from) * i / leg.steps;
            const double dz = z - now_.shape.log_strain.z;
            // the time of the step is that of the axial strain, however the sides move
            const double dt = std::max(std::abs(dz) / leg.rate, 1e-9);
            const auto at = [&](double x) {
                Deformation shape = now_.shape;
                shape.log_strain = {shape.log_strain.x + x, shape.log_strain.y + x, z};
                return moved(now_, shape, dt);
            };
            const auto excess = [&](const State& s) { return 0.5 * (s.stress().xx + s.stress().yy) + leg.lateral; };
            // the last step is a good guess, but for the jump of a failure
            const double x = solve(at, excess, std::clamp(lateral_step, -std::abs(dz), std::abs(dz)), std::max(std::abs(dz), 1e-9));
            lateral_step = x;
            take(at(x), number);
        }
    }

    void pressure(const PathLeg& leg, int number) {
        const double from = now_.point.pressure;
        double step = 0;
        for (int i = 1; i <= leg.steps; ++i) {
            const double wanted = from + (leg.target - from) * i / leg.steps;
            const auto at = [&](double x) { return moved_to(grown(x), leg.rate); };
            const auto excess = [&](const State& s) { return wanted - s.point.pressure; };  // grows with the volume
            step = solve(at, excess, step, std::max(1e-9, std::abs(leg.target - from) / leg.steps / m_.bulk_modulus()));
            const State s = at(step);
            if (std::abs(s.point.pressure - wanted) > 1e-3 * std::abs(leg.target - from))
                throw InputError(fmt::format("leg {}: the pressure {:g} GPa cannot be reached: {} bears {:g} GPa at most", number, leg.target, m_.name,
                                             s.point.pressure));
            take(s, number);
        }
    }

    void shock(const PathLeg& leg, int number) {
        if (m_.burn) throw InputError(fmt::format("leg {}: {} is an explosive; drive it from its Chapman-Jouguet state", number, m_.name));
        double step = 0;
        for (int i = 1; i <= leg.steps; ++i) {
            const double wanted = leg.target * i / leg.steps;
            const auto at = [&](double x) {
                Deformation shape = now_.shape;
                shape.log_strain.z += x;
                return shocked(now_, shape, duration(now_.shape, shape, leg.rate));
            };
            const auto excess = [&](const State& s) { return wanted - jump(s).x; };
            step = solve(at, excess, step, 1e-4 + leg.target / leg.steps / m_.sound_speed());
            const State s = at(step);
            if (!(std::abs(jump(s).x - wanted) <= 1e-3 * leg.target))
                throw InputError(fmt::format("leg {}: there is no Hugoniot state of {} with a particle velocity of {:g} mm/us", number, m_.name, wanted));
            take(s, number);
            const Vec3<double> u = jump(now_);
            rows_.back().particle_velocity = u.x;
            rows_.back().shock_speed = u.y;
        }
    }

    void volume(const PathLeg& leg, int number) {
        const double from = std::log(now_.shape.volume()), to = std::log(leg.target);
        for (int i = 1; i <= leg.steps; ++i)
            take(moved_to(grown((from + (to - from) * i / leg.steps - std::log(now_.shape.volume())) / 3), leg.rate), number);
    }

    void chapman_jouguet_state(int number) {
        if (!m_.burn) throw InputError(fmt::format("leg {}: {} has no burn law, so no Chapman-Jouguet state", number, m_.name));
        const CjState cj = chapman_jouguet(*m_.eos, m_.density);
        Deformation shape;
        shape.log_strain.z = std::log(cj.volume);
        take(shocked(now_, shape, 1), number);
        rows_.back().particle_velocity = jump(now_).x;
        rows_.back().shock_speed = jump(now_).y;
    }

    /// Particle velocity and shock speed of a jump from rest: u^2 = (sigma - sigma_0)(1 - V)/rho_0, U = (sigma - sigma_0)/(rho_0 u).
    Vec3<double> jump(const State& s) const {
        const double rise = -s.stress().zz - rest_stress_, swept = 1 - s.shape.volume();
        const double u = std::sqrt(std::max(rise * swept, 0.0) / m_.density);
        return {rise < 0 || swept < 0 ? -u : u, u > 0 ? rise / (m_.density * u) : m_.sound_speed(), 0};
    }

    Deformation grown(double x) const {
        Deformation shape = now_.shape;
        shape.log_strain = {shape.log_strain.x + x, shape.log_strain.y + x, shape.log_strain.z + x};
        return shape;
    }
    State moved_to(const Deformation& shape, double rate) const { return moved(now_, shape, duration(now_.shape, shape, rate)); }

    /// A root of excess(at(x)), which grows with x: from `guess`, with steps of `size` until the sign changes, then by bisection. Where a
    /// law jumps (sudden failure) it is the end of the jump that is nearer to zero; where it is flat, the first x that comes close.
    template <class At, class Excess> double solve(const At& at, const Excess& excess, double guess, double size) const {
        const double close = 1e-13 * m_.bulk_modulus();
        const auto f = [&](double x) { return excess(at(x)); };
        double low = guess, high = guess, f_low = f(guess), f_high = f_low;
        if (std::abs(f_low) <= close) return guess;
        for (double reach = size; f_low > 0 && reach < 2; reach *= 2) {
            high = low, f_high = f_low;
            low = guess - reach, f_low = f(low);
        }
        for (double reach = size; f_high < 0 && reach < 2; reach *= 2) {
            low = high, f_low = f_high;
            high = guess + reach, f_high = f(high);
        }
        // Illinois: false position that halves the weight of an end that stays
        for (int i = 0; i < 200 && high - low > 1e-16; ++i) {
            if (std::abs(f_low) <= close || std::abs(f_high) <= close || f_low * f_high > 0) break;
            double x = i % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
            if (!(x > low && x < high)) x = 0.5 * (low + high);
            if (!(x > low && x < high)) break;
            const double fx = f(x);
            (fx < 0 ? low : high) = x;
            (fx < 0 ? f_low : f_high) = fx;
        }
        return std::abs(f_low) < std::abs(f_high) ? low : high;
    }

    void take(const State& s, int leg) {
        time_ += s.point.dt;
        now_ = s;
        note(leg);
    }

    void note(int leg) {
        const SolidPoint<double>& p = now_.point;
        PathPoint r;
        r.leg = leg;
        r.time = time_;
        r.strain = {std::expm1(now_.shape.log_strain.x), std::expm1(now_.shape.log_strain.y), std::expm1(now_.shape.log_strain.z)};
        r.shear = now_.shape.shear;
        r.volume = now_.shape.volume();
        r.density = m_.density / r.volume;
        r.stress = now_.stress();
        r.pressure = p.pressure;
        r.mises = mises(p.s);
        r.yield = p.yield;
        r.energy = now_.energy;
        const double c2 = (now_.bulk + p.shear_stiffness * r.volume) / m_.density;
        r.sound_speed = std::sqrt(std::max(c2, 0.0));
        r.state.assign(p.state, p.state + columns_);
        for (double x : {r.stress.xx, r.stress.zz, r.stress.xy, r.pressure, r.energy, r.yield})
            if (!std::isfinite(x))
                throw PhysicsStop(fmt::format("{} on leg {}: a stress or the energy is not finite at V/V_0 = {:g} (P = {:g} GPa, E = {:g} GPa)", m_.name,
                                              leg, r.volume, r.pressure, r.energy));
        rows_.push_back(std::move(r));
    }

    const Material& m_;
    const PointPath& path_;
    State now_;
    double rest_stress_ = 0, time_ = 0;
    std::size_t columns_ = 0;
    std::vector<PathPoint> rows_;
};

}  // namespace

std::vector<PathPoint> drive(const Material& material, const PointPath& path) { return Driver(material, path).run(); }

}  // namespace brisance
