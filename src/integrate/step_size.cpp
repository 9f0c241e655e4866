// SPDX-License-Identifier: Apache-2.0
#include "integrate/step_size.h"

#include "exec/launch.h"
#include "integrate/watchdog.h"

#include <algorithm>
#include <cmath>

namespace brisance {

namespace {

template <class R>
double solid_limit(const World<R>& w, const SolidPart<R>& s) {
    double rate = s.report.rate;
    if (rate == 0) {  // before the first stress pass
        const exec::HostAccess host;
        double least = s.body.layout.dz;
        for (const Column& c : s.body.layout.columns) least = std::min(least, c.spacing);
        rate = s.body.material.sound_speed() / least;
    }
    // pairwise viscosity damps the fastest motion, which shortens what an explicit step bears: with alpha = 1 a shock needs 0.45 in place
    // of 0.6 (tests/unit/physics/shock_test.cpp)
    const double viscous = s.body.options.pairwise ? 1 + 0.4 * s.body.options.alpha : 1;
    return w.options.courant_solid * stencil_tau(s.body.options.smoothing, s.body.options.zero_energy) / (rate * viscous);
}

/// Stable step of the fluids and of the solids that are not slow; notes who holds it.
template <class R>
double fast_limit(World<R>& w) {
    double dt = 1e300;
    const auto bound = [&](double limit, const std::string& who) {
        if (limit < dt) {
            dt = limit;
            w.limiter = who;
        }
    };
    for (const SolidPart<R>& s : w.solids)
        if (!s.slow) bound(solid_limit(w, s), s.body.name + ": wave");
    for (const FluidPart& f : w.fluids) {
        if (f.rate > 0) bound(w.options.courant_fluid / f.rate, f.body.name + ": wave");
        const double* const burnt = f.body.burnt.data();
        const bool burning = f.body.material.burn && exec::launch_max(f.body.size(), -1.0, BRISANCE_KERNEL(std::int64_t i) { return -burnt[i]; }) > -1;
        if (burning) bound(0.5 * f.body.spacing / f.body.material.burn->speed, f.body.name + ": burn");
    }
    if (w.dt_free > 0 && dt > w.options.growth * w.dt_free) {
        dt = w.options.growth * w.dt_free;
        w.limiter = "growth";
    }
    if (dt < w.options.minimum)
        throw collapsed_step(w, dt);
    return dt;
}

/// Output times are met exactly, in equal steps: what a step that changes exchanges with stiff springs does not balance.
double fit(double dt, double left) { return left / std::ceil(left / dt - 1e-9); }

}  // namespace

template <class R>
double choose_step(World<R>& w, double until) {
    for (SolidPart<R>& s : w.solids) s.slow = false;
    double fluids = 1e300, fluid_particles = 0;
    const double grown = w.dt_free > 0 ? w.options.growth * w.dt_free : 1e300;  // what the short step can be now, whatever fluids could take
    for (const FluidPart& f : w.fluids) {
        if (f.rate > 0) fluids = std::min({fluids, w.options.courant_fluid / f.rate, grown});
        fluid_particles += static_cast<double>(f.body.size());
    }
    // Solids with the longest limits are slow. How many: the division that costs least, particles times steps per time. It is told by the limits,
    // not by the step at hand: a solid that took a short one has to lengthen its own again, by at most half at a time.
    std::vector<std::size_t> order(w.solids.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return solid_limit(w, w.solids[a]) > solid_limit(w, w.solids[b]); });
    double best = 1e300, slow_step = 1e300;
    std::size_t slow_count = 0;
    for (std::size_t n = 0; n <= order.size(); ++n) {
        double fast = fluids, slow = 1e300, reached = 1e300, fast_particles = fluid_particles, slow_particles = 0;
        for (std::size_t k = 0; k < order.size(); ++k) {
            const SolidPart<R>& s = w.solids[order[k]];
            const double limit = solid_limit(w, s), count = static_cast<double>(s.body.layout.particles);
            if (k < n) {
                if (!s.loads.empty()) slow = 0;  // a prescribed load is followed in short steps
                slow = std::min(slow, limit);
                if (s.dt > 0) reached = std::min(reached, 1.5 * s.dt);
                slow_particles += count;
            } else {
                fast = std::min(fast, limit);
                fast_particles += count;
            }
        }
        if (n > 0 && !(slow > 2 * fast && fast < 1e299)) continue;
        slow = std::min(slow, most_short_steps * fast);
        const double cost = fast_particles / fast + (n > 0 ? slow_particles / slow : 0);
        if (cost < best) {
            best = cost;
            slow_count = n;
            slow_step = std::min(slow, reached);
        }
    }
    for (std::size_t k = 0; k < slow_count; ++k) w.solids[order[k]].slow = true;
    return slow_count == 0 ? choose_short_step(w, until) : fit(slow_step, until - w.time);
}

template <class R>
double choose_short_step(World<R>& w, double end) {
    w.dt_free = fast_limit(w);
    w.contact_dt = std::max(w.contact_dt, w.dt_free);
    return fit(w.dt_free, end - w.time);
}

template double choose_step(World<double>&, double);
template double choose_step(World<float>&, double);
template double choose_short_step(World<double>&, double);
template double choose_short_step(World<float>&, double);

}  // namespace brisance
