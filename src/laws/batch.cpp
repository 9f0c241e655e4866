// SPDX-License-Identifier: Apache-2.0
#include "laws/batch.h"

#include "base/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace brisance {

namespace {

using V = Pack<double>;

void set_lane(V& v, int l, double x) { std::memcpy(reinterpret_cast<char*>(&v) + static_cast<std::size_t>(l) * sizeof(x), &x, sizeof(x)); }

/// Strained in a few steps until the law has yielded, or not.
SolidPoint<double> point(const Material& m, std::uint64_t index, bool yields, bool failed) {
    const auto random = [&](std::uint64_t k) { return 2 * random_uniform(1994, k, index) - 1; };
    SolidPoint<double> p{};
    p.energy = m.eos->initial_energy();
    p.dt = 0.05;
    p.scale = 1 + 0.1 * random(0);
    const std::vector<StateInfo> rows = m.strength->state();
    for (std::size_t k = 0; k < rows.size(); ++k) p.state[k] = rows[k].initial;
    const auto strain = [&](double size) {
        p.d = {size * random(1), size * random(2), size * random(3), size * random(4), size * random(5), size * random(6)};
        p.mu = 0.05 + 0.005 * random(7);  // pressed, so that damage grows in steps
        p.pressure = m.eos->pressure(p.mu, p.energy);
    };
    if (failed && !rows.empty() && rows[0].name == "damage") p.state[0] = 1;
    for (int i = 0; i < (yields ? 4 : 1); ++i) {
        strain(yields ? 3e-3 : 1e-5);
        m.strength->update(p);
    }
    strain(yields ? 3e-3 : 1e-5);
    return p;
}

}  // namespace

LawBatch::LawBatch(const Material& material, int points) : material_(material) {
    const int width = lanes<double>;
    packs_.resize(static_cast<std::size_t>((points + width - 1) / width));
    for (std::size_t i = 0; i < packs_.size(); ++i)
        for (int l = 0; l < width; ++l) {
            const std::size_t n = i * static_cast<std::size_t>(width) + static_cast<std::size_t>(l);
            SolidPoint<double> p = point(material, n, n % 3 != 0, n % 3 == 2);
            auto& pack = packs_[i];
            for (std::size_t k = 0; k < 6; ++k) {
                set_lane(component(pack.d, k), l, component(p.d, k));
                set_lane(component(pack.s, k), l, component(p.s, k));
            }
            const std::pair<V*, double> rest[] = {{&pack.mu, p.mu}, {&pack.pressure, p.pressure}, {&pack.energy, p.energy}, {&pack.dt, p.dt}, {&pack.scale, p.scale}};
            for (const auto& [v, x] : rest) set_lane(*v, l, x);
            for (int k = 0; k < max_law_state; ++k) set_lane(pack.state[k], l, p.state[k]);
        }
}

double LawBatch::update() const {
    V sum{};
    for (const SolidPoint<V>& pack : packs_) {
        SolidPoint<V> p = pack;
        material_.strength->update_pack(p);
        sum += p.s.xx + p.pressure + p.state[0];
    }
    return hsum(sum);
}

double LawBatch::yielding() const {
    double n = 0;
    for (const SolidPoint<V>& pack : packs_) {
        SolidPoint<V> p = pack;
        material_.strength->update_pack(p);
        const V trial = mises(elastic_trial(pack, 2 * material_.strength->shear_modulus()));
        n += hsum((trial > p.yield) ? broadcast<V>(1.0) : V{});
    }
    return n / static_cast<double>(points());
}

double LawBatch::failed() const {
    double n = 0;
    for (const SolidPoint<V>& pack : packs_) n += hsum((pack.state[0] >= broadcast<V>(1.0)) ? broadcast<V>(1.0) : V{});
    return n / static_cast<double>(points());
}

double LawBatch::updates_per_second(double seconds) const {
    using clock = std::chrono::steady_clock;
    const auto since = [](clock::time_point t) { return std::chrono::duration<double>(clock::now() - t).count(); };
    double best = 0, spent = 0;
    volatile double sink = 0;
    while (spent < seconds) {
        const clock::time_point start = clock::now();
        for (int i = 0; i < 20; ++i) sink = sink + update();
        const double took = since(start);
        spent += took;
        best = std::max(best, 20.0 * static_cast<double>(points()) / took);
    }
    return best;
}

}  // namespace brisance
