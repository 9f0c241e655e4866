// SPDX-License-Identifier: Apache-2.0
// Each way in which the watchdog stops a run, brought about by what brings it about in practice. The message has to name the part, the
// particle, its place and state, the usual causes and the remedy.
#include "core_helpers.h"

#include "app/leaks.h"
#include "integrate/watchdog.h"

#include <functional>
#include <limits>

using namespace brisance;
using namespace brisance::core_test;

namespace {

/// Hot gas in a gap between two blocks of granite.
World<double> gas_in_a_gap(double gas_energy = 1) {
    World<double> w;
    w.period = 0.8;
    w.solids.push_back(block(elastic_granite(), {}, {6, 8, 4, 0.2, 0.2, false, false, true, 1.0, -0.8, 0}));
    w.solids.push_back(block(elastic_granite(), {}, {6, 8, 4, 0.2, 0.2, false, false, true, -1.2, -0.8, 0}));
    w.solids[0].body.name = "right";
    w.solids[1].body.name = "left";
    w.fluids.push_back(fluid(ideal_gas(1.4, 1, gas_energy), {}, {0.1, 10, 16, 8, 0, -0.8, 0}));
    w.fluids[0].body.name = "gas";
    for (std::size_t s = 0; s < 2; ++s) w.contacts.push_back({ContactPair::fluid_solid, 0, s});
    return w;
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const PhysicsStop& stop) {
        EXPECT_EQ(static_cast<int>(stop.code()), 3);
        return stop.what();
    }
    return "went on";
}

/// Steps and watches until the watchdog speaks or `until` is reached.
std::string march(World<double>& w, double until) {
    return message_of([&] {
        while (w.time < until) {
            step(w, until);
            watch(w, audit(w), find_leaks(w));
        }
    });
}

void expect_all(const std::string& message, std::initializer_list<const char*> fragments) {
    for (const char* f : fragments) EXPECT_NE(message.find(f), std::string::npos) << "wanted: " << f << "\nsaid: " << message;
    for (const char* f : {" at t = ", ", step ", "usual causes: ", "change: ", "v = (", "P = ", "material "}) EXPECT_NE(message.find(f), std::string::npos) << "wanted: " << f << "\nsaid: " << message;
}

}  // namespace

TEST(Watchdog, IsSilentInAGoodRun) {
    World<double> w = gas_in_a_gap();
    begin(w);
    EXPECT_EQ(march(w, 0.3), "went on");
    EXPECT_GT(audit(w).kinetic, 0.01 * w.start.internal[2]) << "nothing happened";
}

TEST(Watchdog, NaN) {
    World<double> w = gas_in_a_gap();
    begin(w);
    step(w, 1);
    w.fluids[0].body.e[77] = std::numeric_limits<double>::quiet_NaN();
    expect_all(message_of([&] { watch(w, audit(w)); }), {"1 particles hold a value that is no number", "first: part gas, particle 77, at (", "e = nan kJ/g", "courant_fluid"});
    // and left alone it spreads, with the same message
    EXPECT_NE(march(w, 0.1).find("no number"), std::string::npos);

    World<double> solid = gas_in_a_gap();
    begin(solid);
    step(solid, 1);
    const Column& c = solid.solids[0].body.layout.columns[9];
    solid.solids[0].body.u[2][static_cast<std::size_t>(c.start + 2)] = std::numeric_limits<double>::infinity();
    expect_all(message_of([&] { watch(solid, audit(solid)); }), {"first: part right, particle 2 of column 9, at rest at (", "u = (", "inf) mm"});
}

TEST(Watchdog, RunawayVelocity) {
    // gas of 500 kJ/g, a hundred times an explosive: it leaves its gap with tens of km/s
    World<double> w = gas_in_a_gap(500);
    w.contacts.clear();
    begin(w);
    expect_all(march(w, 1), {"a particle runs away with ", "(step.velocity_limit = 30 km/s)", "fastest: part gas, particle ", "at the start at ("});
}

TEST(Watchdog, CollapsedStep) {
    // one particle of gas as hot as the inside of a star
    World<double> w = gas_in_a_gap();
    w.options.minimum = 1e-6;
    w.fluids[0].body.e[500] = 1e12;
    begin(w);
    expect_all(message_of([&] { step(w, 1); }), {"the step fell to ", "(step.minimum = 1e-06 us), held by gas: wave", "who holds it: part gas, particle 500, at (", "h = "});

    World<double> solid = gas_in_a_gap();
    solid.options.minimum = 0.5;
    solid.fluids.clear();
    solid.contacts.clear();
    begin(solid);
    solid.solids[1].body.u[0][static_cast<std::size_t>(solid.solids[1].body.layout.columns[3].start)] = 0.05;
    expect_all(message_of([&] {
                   solid.options.minimum = 0;
                   step(solid, 1e-3);
                   solid.options.minimum = 0.5;
                   step(solid, 1);
               }),
               {"held by left: wave", "who holds it: part left, particle "});
}

TEST(Watchdog, EnergyResidual) {
    // a blow on a wall that no load and no contact gave: work that nobody did
    World<double> w = gas_in_a_gap();
    begin(w);
    EXPECT_EQ(march(w, 0.1), "went on");
    for (double& v : w.solids[0].body.v[0]) v -= 1;
    expect_all(march(w, 5), {"the energy balance broke: its residual is ", "(step.energy_residual_limit = 0.05)", "fastest: part ", "to two thirds"});
}

TEST(Watchdog, InvertedParticles) {
    // a block whose halves fly through each other
    World<double> w;
    w.period = 0.8;
    w.solids.push_back(block(elastic_granite(), {}, {10, 10, 4, 0.2, 0.2, false, false, true, -1, -1, 0}));
    w.solids[0].body.name = "rock";
    set_field(w.solids[0].body, w.solids[0].body.v, [](Vec3<double> x) { return Vec3<double>{x.x > 0 ? -9.0 : 9.0, 0, 0}; });
    begin(w);
    expect_all(march(w, 1), {" of 400 particles of part rock are torn: crushed flat, turned inside out", "(step.torn_limit = 0.01)", "first: part rock, particle ", "updated_lagrangian"});
}

TEST(Watchdog, Leaks) {
    // gas that no contact holds walks into the rock
    World<double> w = gas_in_a_gap();
    w.contacts.clear();
    begin(w);
    const Leaks none = find_leaks(w);
    EXPECT_EQ(none.count, 0);
    expect_all(march(w, 5), {" of 1280 fluid particles stand inside a solid (step.leak_limit = 0.01)", "first leaked: part gas, particle ", "contact.pairs"});
}
