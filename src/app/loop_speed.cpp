// SPDX-License-Identifier: Apache-2.0
#include "app/loop_speed.h"

#include "app/assembly.h"
#include "base/memory.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

namespace brisance {

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

CaseOptions shipped_case(const std::string& file) {
    CaseOptions o;
    o.file = (std::filesystem::path(BRISANCE_SOURCE_DIR) / "cases" / file).string();
    return o;
}

CaseOptions sized_case(const std::string& file, double particles, double edge) {
    CaseOptions o = shipped_case(file);
    if (particles > 0) {
        const std::string part = std::filesystem::path(file).stem().string();
        o.settings.push_back(fmt::format("{}.spacing=\"{:.6g} mm\"", part, edge / std::cbrt(particles)));
    }
    return o;
}

namespace {

template <class R>
LoopSpeed speed(const Case& c, double seconds) {
    const double before = resident_memory();
    World<R> w = assemble<R>(c, [](const std::string&) {});
    begin(w);
    LoopSpeed m;
    for (const auto& s : w.solids) {
        m.particles += static_cast<double>(s.body.layout.particles);
        m.neighbours = s.pairs.bonds_per_particle;
    }
    for (const FluidPart& f : w.fluids) {
        m.particles += static_cast<double>(f.body.size());
        m.neighbours = f.solver.neighbours_per_particle();
    }
    for (int k = 0; k < 5; ++k) step(w, c.until);
    m.bytes = (resident_memory() - before) / m.particles;
    double spent = 0, steps = 0;
    while (spent < seconds && w.time < c.until) {
        spent += seconds_of([&] { step(w, c.until); });
        ++steps;
    }
    m.rate = steps * m.particles / spent;
    return m;
}

}  // namespace

LoopSpeed loop_speed(const std::string& file, double particles, Precision precision, double edge, double seconds, const std::string& preset) {
    CaseOptions o = sized_case(file, particles, edge);
    o.preset = preset;
    const Case c = open_case(o);
    require_memory(c, estimate(c));
    return precision == Precision::single ? speed<float>(c, seconds) : speed<double>(c, seconds);
}

}  // namespace brisance
