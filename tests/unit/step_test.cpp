// SPDX-License-Identifier: Apache-2.0
// The step of a whole world: balances with long and short steps, output times, and the same bits however many threads there are.
#include "core_helpers.h"

#include <cstring>

using namespace brisance;
using namespace brisance::core_test;

namespace {

/// Hot gas between two plates, a fine copper one and a coarse granite one that takes long steps.
World<double> gas_between_plates(double zero_energy = 0.05) {
    SolidOptions o;
    o.zero_energy = zero_energy;
    World<double> w;
    w.period = 0.8;
    const Lattice coarse{8, 10, 2, 0.4, 0.4, false, false, true, 1.0, -2, 0};
    w.solids.push_back(block(elastic_granite(), o, coarse));
    const Lattice fine{5, 20, 4, 0.2, 0.2, false, false, true, -1.0, -2, 0};
    w.solids.push_back(block(library("copper_ofhc"), o, fine));
    w.fluids.push_back(fluid(ideal_gas(1.4, 1, 1), {}, {0.1, 10, 30, 8, 0, -1.5, 0}));
    w.contacts.push_back({ContactPair::fluid_solid, 0, 0});
    w.contacts.push_back({ContactPair::fluid_solid, 0, 1});
    w.contacts.push_back({ContactPair::solid_solid, 1, 0});
    return w;
}
/// A load of no pressure: a part with a load takes no long steps.
void keep_in_step(World<double>& w) {
    for (SolidPart<double>& s : w.solids) s.loads.push_back({{0}, {0.0, 1.0}, {0.0, 0.0}});
}

/// What contact has given a part up to now: without what a long step foresaw, or has not yet taken up.
double given(const SolidPart<double>& s) {
    double p = sums(s.body).px;
    for (double j : s.surface.jx) p -= j;
    return p;
}
double mean_way(const SolidPart<double>& s) {
    double sum = 0, mass = 0;
    each(s.body, [&](std::size_t i, const Column& c, Vec3<double>) {
        sum += s.body.mass(c) * s.body.u[0][i];
        mass += s.body.mass(c);
    });
    return sum / mass;
}

}  // namespace

TEST(Step, MixedWorldKeepsItsBalances) {
    World<double> w = gas_between_plates(0);
    begin(w);
    run(w, 1.5);
    const Audit a = audit(w);
    EXPECT_GT(w.short_steps, 2 * w.steps) << "the rock was to take long steps here";
    EXPECT_LT(a.momentum_residual, 1e-12);
    EXPECT_LT(std::abs(a.residual), 1e-12 * (w.start.internal[2]));
    EXPECT_GT(a.kinetic, 0.05 * w.start.internal[2]);
    EXPECT_EQ(a.torn, 0);
}

TEST(Step, LongStepsGiveWhatShortOnesDo) {
    // The difference is of first order in the long step: contact over half of it is foreseen.
    double off[2];
    for (int half = 0; half < 2; ++half) {
        World<double> fast = gas_between_plates(), slow = gas_between_plates();
        keep_in_step(fast);
        for (World<double>* w : {&fast, &slow}) {
            w->options.courant_solid *= half ? 0.5 : 1;
            w->options.courant_fluid *= half ? 0.5 : 1;
            begin(*w);
            run(*w, 1.5);
            EXPECT_LT(audit(*w).momentum_residual, 1e-12);
        }
        EXPECT_EQ(fast.short_steps, fast.steps);
        EXPECT_GT(slow.short_steps, 2 * slow.steps);
        for (std::size_t k = 0; k < 2 && half; ++k) {
            EXPECT_NEAR(given(slow.solids[k]), given(fast.solids[k]), 0.02 * std::abs(given(fast.solids[k])));
            EXPECT_NEAR(mean_way(slow.solids[k]), mean_way(fast.solids[k]), 0.02 * std::abs(mean_way(fast.solids[k])));
        }
        off[half] = std::abs(mean_way(slow.solids[0]) / mean_way(fast.solids[0]) - 1);
        std::printf("way of the rock with long steps of up to %d short ones: %.2f %% off\n", static_cast<int>(std::ceil(static_cast<double>(slow.short_steps) / static_cast<double>(slow.steps))), 100 * off[half]);
        const double e = fast.fluids[0].solver.sums(fast.fluids[0].body).internal;
        EXPECT_NEAR(slow.fluids[0].solver.sums(slow.fluids[0].body).internal, e, 0.003 * e);
    }
    EXPECT_LT(off[1], 0.6 * off[0]);
}

TEST(Step, ASolidThatTookAShortStepFindsBackToLongOnes) {
    World<double> w = gas_between_plates();
    keep_in_step(w);
    begin(w);
    run(w, 0.5);
    SolidPart<double>& rock = w.solids[0];
    const double short_one = rock.dt;
    for (SolidPart<double>& s : w.solids) s.loads.clear();
    for (int n = 0; n < 6; ++n) {
        const double before = rock.dt;
        step(w, 10.0);
        EXPECT_TRUE(rock.slow);
        EXPECT_LE(rock.dt, 1.5 * before * (1 + 1e-12)) << "at most half longer at a time";
    }
    EXPECT_GT(rock.dt, 2 * short_one);
    EXPECT_LT(audit(w).momentum_residual, 1e-12);
}

TEST(Step, ASolidAloneIsNeverSlow) {
    // also where its limit is far above what growth lets it take now
    World<double> w = gas_between_plates();
    w.fluids.clear();
    w.contacts.clear();
    w.solids.resize(1);
    begin(w);
    step(w, 10.0);
    for (w.dt_free *= 0.2; w.steps < 5;) {
        const double before = w.dt_free;
        step(w, 10.0);
        EXPECT_FALSE(w.solids[0].slow);
        EXPECT_LE(w.solids[0].dt, w.options.growth * before * (1 + 1e-12));
    }
}

TEST(Step, OutputTimesAreMetWithoutSplinters) {
    World<double> w = gas_between_plates();
    begin(w);
    double last = 1e300;
    for (int n = 1; n <= 12; ++n) {
        const double until = 0.0737 * n;
        while (w.time < until) {
            const double before = w.time;
            step(w, until);
            EXPECT_GT(w.time - before, 0);
            if (n > 2) {
                EXPECT_GT(w.dt, 0.2 * last);
            }
            last = w.dt;
        }
        EXPECT_EQ(w.time, until);
        for (const SolidPart<double>& s : w.solids) EXPECT_EQ(s.time, w.time);
    }
}

TEST(Step, SameBitsWithAnyNumberOfThreads) {
    const int before = exec::threads();
    std::vector<double> x;
    for (const int threads : {1, 2, 3}) {
        exec::set_threads(threads);
        World<double> w = gas_between_plates();
        begin(w);
        run(w, 0.25);
        std::vector<double> now(w.fluids[0].body.x[0].begin(), w.fluids[0].body.x[0].end());
        for (const SolidPart<double>& s : w.solids) now.insert(now.end(), s.body.u[0].begin(), s.body.u[0].end());
        now.push_back(audit(w).residual);
        if (threads == 1) x = now;
        ASSERT_EQ(x.size(), now.size());
        EXPECT_EQ(std::memcmp(x.data(), now.data(), x.size() * sizeof(double)), 0) << threads << " threads";
    }
    exec::set_threads(before);
}
