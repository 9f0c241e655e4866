// SPDX-License-Identifier: Apache-2.0
// brisance check: what a case will need. Places and steps nothing of it.
#include "app/assembly.h"
#include "app/commands.h"
#include "app/loop_speed.h"
#include "base/memory.h"
#include "exec/device.h"

#include <fmt/format.h>

#include <cstdio>

namespace brisance {

namespace {

/// How long a case will take here, s: this machine's speed is measured for a moment.
double foretell(const Case& c, const Estimate& e) {
    // In a blast they get this much of the speed that they have by themselves: output takes its part, and contact is counted among what fluids
    // cost. Shares of cases/blast/air_copper.toml, of the solids in the preset quick, of the fluids in full (docs/performance.md).
    constexpr double solid_share = 0.75, fluid_share = 0.5;
    double seconds = 0;
    if (e.solid_steps > 0) seconds += e.solid_steps / (solid_share * loop_speed("bench/rock.toml", 1e5, c.precision, 24, 0.3).rate);
    if (e.fluid_steps > 0) seconds += e.fluid_steps / (fluid_share * loop_speed("bench/water.toml", 3e4, Precision::double_, 12, 0.3).rate);
    return seconds;
}

}  // namespace

int check_command(const CaseOptions& o) {
    const Case c = open_case(o);
    const Estimate e = estimate(c);
    const double memory = available_memory();
    const double seconds = foretell(c, e);
    if (o.json) {
        std::string parts;
        for (const Estimate::Part& p : e.parts)
            parts += fmt::format("{}{{\"name\": \"{}\", \"material\": \"{}\", \"particles\": {:.0f}, \"mass_mg\": {:.6g}, \"bytes\": {:.0f}, \"dt_us\": {:.4g}}}",
                                 parts.empty() ? "" : ", ", p.name, p.material, p.particles, p.mass, p.bytes, p.dt);
        fmt::print("{{\"parts\": [{}], \"particles\": {:.0f}, \"bytes\": {:.0f}, \"dt_us\": {:.4g}, \"steps\": {:.0f}, \"seconds\": {:.0f}, \"fits\": {}, \"device\": {}}}\n", parts,
                   e.particles, e.bytes, e.dt, e.steps, seconds, e.bytes <= memory ? "true" : "false", exec::on_device() ? '"' + exec::device_info().name + '"' : "null");
    } else {
        fmt::print("{}{}\n\n", c.title, c.preset.empty() ? "" : " (preset " + c.preset + ")");
        fmt::print("{:<12} {:<18} {:<18} {:>9} {:>9} {:>9} {:>13} {:>12} {:>10} {:>9}\n", "part", "material", "formulation", "spacing", "far", "along z",
                   "particles", "mass g", "MiB", "dt ns");
        for (const Estimate::Part& p : e.parts)
            fmt::print("{:<12} {:<18} {:<18} {:>9.3g} {:>9.3g} {:>9.3g} {:>13.0f} {:>12.5g} {:>10.0f} {:>9.2f}\n", p.name, p.material, p.formulation, p.spacing,
                       p.spacing_far, p.spacing_z, p.particles, 1e-3 * p.mass, p.bytes / 1048576, 1e3 * p.dt);
        fmt::print("\n{:.4g} particles, {:.3g} GiB (free: {:.3g} GiB)\n", e.particles, e.bytes / gibibyte, memory / gibibyte);
        if (exec::on_device()) {
            const exec::DeviceInfo d = exec::device_info();
            fmt::print("on {}, {:.3g} of {:.3g} GiB free\n", d.name, d.memory_free / gibibyte, d.memory / gibibyte);
        }
        fmt::print("first step {:.2f} ns, {:.0f} short steps to {:g} us; about {} on {} threads\n", 1e3 * e.dt, e.steps, c.until,
                   seconds < 3600 ? fmt::format("{:.0f} min", seconds / 60 + 1) : fmt::format("{:.1f} h", seconds / 3600), exec::threads());
        for (const PartData& p : c.parts)
            for (const std::string& r : make_material(p.material).remarks) fmt::print("{}: {}\n", p.material.name, r);
    }
    require_memory(c, e);
    return 0;
}

}  // namespace brisance
