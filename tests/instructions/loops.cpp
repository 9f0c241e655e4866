// SPDX-License-Identifier: Apache-2.0
// The loops of a step on small bodies, for tools/instructions.py: what runs within `counted` is counted.
#include "../unit/core_helpers.h"

#include <cstdio>
#include <functional>
#include <map>

using namespace brisance;
using namespace brisance::core_test;

[[gnu::noinline]] void counted(const std::function<void()>& work) { work(); }

namespace {

/// Steps of a block with free sides that is squeezed from all of them, so that its law yields and fails.
void solid_loop(const std::string& material, double smoothing) {
    SolidOptions o;
    o.smoothing = smoothing;
    o.zero_energy = 0.4;
    o.linear = 0.12;
    o.quadratic = 1.5;
    o.failure.notice = 0.003;
    SolidPart<double> s = block(library(material), o, Lattice{12, 12, 32, 0.5, 0.5, false, false, false, -3, -3, -8});
    set_field(s.body, s.body.v, [](Vec3<double> x) { return Vec3<double>{-0.1 * x.x, -0.1 * x.y, 0.02 * x.z}; });
    March step(s);
    counted([&] {
        for (int k = 0; k < 30; ++k) step(0.03);
    });
}

void fluid_loop() {
    FluidPart f = disturbed_water({0.2, 14, 14, 14, 0, 0, 0, false}, 0.02, 1, 0.05);
    counted([&] {
        for (int k = 0; k < 8; ++k) {
            f.solver.state(f.body, 0.01 * k);
            f.solver.rates(f.body);
            f.solver.stable_rate(f.body);
            f.solver.kick(f.body, 0.01, f.forces.fx.data(), f.forces.fy.data(), f.forces.fz.data());
            f.solver.drift(f.body, 0.01);
        }
    });
}

/// Water that presses on a wall and on other water.
void contact_loop() {
    SolidPart<double> wall = block(library("copper_ofhc"), {}, Lattice{4, 24, 12, 0.25, 0.25, false, false, false, 0, -3, 0});
    respond_to(wall);
    FluidPart a = disturbed_water({0.125, 8, 40, 20, -0.95, -2.5, 0.2, false}, 0.0125, 2, 0.05), b = disturbed_water({0.125, 8, 40, 20, -1.9, -2.5, 0.2, false}, 0.0125, 3, 0.05);
    const ContactOptions o{1, 0.05, 0, 1e-3};
    ContactReport last;
    counted([&] {
        for (int k = 0; k < 8; ++k) {
            a.forces.begin(a.body);
            b.forces.begin(b.body);
            follow(wall.surface, wall.body, wall.pairs, 0);
            last = wall_contact(a.body, wall.surface, o, 0, 0, a.forces);
            node_contact(a.body, b.body, o, a.forces, b.forces);
            plan(wall.surface, 0.01);
            push(wall.surface, wall.body, 0.01);
        }
    });
    if (last.touching == 0) std::puts("nothing touches");
}

const std::map<std::string, void (*)()> loops{{"rock", [] { solid_loop("barre_granite", 1.1); }}, {"copper", [] { solid_loop("copper_ofhc", 1.3); }}, {"fluid", fluid_loop}, {"contact", contact_loop}};

}  // namespace

int main(int argc, char** argv) {
    const auto loop = argc == 2 ? loops.find(argv[1]) : loops.end();
    if (loop == loops.end()) {
        std::puts("loops rock|copper|fluid|contact");
        return 2;
    }
    exec::set_threads(1);
    loop->second();
    return 0;
}
