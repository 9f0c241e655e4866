// SPDX-License-Identifier: Apache-2.0
// brisance bench: what this machine can do at most, and what each part of a step makes of it.
// Every measurement is a process of its own, so that none inherits the memory or the warm caches of another.
#include "app/assembly.h"
#include "app/ceilings.h"
#include "app/commands.h"
#include "app/loop_speed.h"
#include "app/recorder.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/version.h"
#include "io/case_file.h"
#include "io/run_directory.h"
#include "laws/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numeric>
#include <unistd.h>

namespace brisance {

namespace {

/// What a measurement found; zero where it says nothing of it.
struct Measured {
    double rate = 0;        ///< per second
    double particles = 0, neighbours = 0;
    double bytes = 0;       ///< per particle, resident
    double share = 0;       ///< see Row::what
};

/// One line of the table.
struct Row {
    std::string name, what;
    /// Floating-point operations for one neighbour in the sums of one particle's step: what the method needs, a multiply-add counted as
    /// two, square root and division as one. Laws and kicks are left out.
    double per_neighbour = 0;
    std::function<Measured(const BenchOptions&)> measure;
};

Measured loop(const std::string& file, const BenchOptions& b, Precision precision, double edge, const std::string& preset = "") {
    const LoopSpeed l = loop_speed(file, b.particles, precision, edge, 3, preset);
    return {l.rate, l.particles, l.neighbours, l.bytes};
}

/// The blast from lighting to 12 us, when the pulse is in the rock: particle-steps of all parts, and the share of contact.
Measured blast(const BenchOptions&) {
    CaseOptions o = shipped_case("blast/air_copper.toml");
    o.preset = "quick";
    const Case c = open_case(o);
    World<double> w = assemble<double>(c, [](const std::string&) {});
    begin(w);
    Measured m;
    for (const auto& s : w.solids) m.particles += static_cast<double>(s.body.layout.particles);
    for (const FluidPart& f : w.fluids) m.particles += static_cast<double>(f.body.size());
    const double spent = seconds_of([&] { while (w.time < 12) step(w, 12); });
    m.rate = static_cast<double>(w.steps) * m.particles / spent;
    for (const auto& [name, seconds] : w.seconds)
        if (name == "contact") m.share = seconds / spent;
    return m;
}

/// A snapshot of the rock, with the row of the audit.
Measured output(const BenchOptions&) {
    CaseOptions o = shipped_case("bench/rock.toml");
    o.settings.emplace_back("output.snapshots=[\"0 us\"]");
    const Case c = open_case(o);
    World<double> w = assemble<double>(c, [](const std::string&) {});
    begin(w);
    char name[] = "/tmp/brisance-bench-XXXXXX";
    if (!mkdtemp(name)) throw ResourceError("no folder can be made in /tmp for the measurement of output");
    Measured m;
    m.particles = static_cast<double>(w.solids[0].body.layout.particles);
    {
        const RunDirectory directory(std::filesystem::path(name), true);
        Recorder<double> recorder(c, w, directory);
        m.rate = m.particles / seconds_of([&] { recorder.record(w); });
    }
    std::filesystem::remove_all(name);
    return m;
}

/// Placement of the rock, its columns' pairs included.
Measured placement(const BenchOptions& b) {
    const Case c = open_case(sized_case("bench/rock.toml", b.particles, 24));
    Measured m;
    const double spent = seconds_of([&] { m.particles = static_cast<double>(assemble<double>(c, [](const std::string&) {}).solids[0].body.layout.particles); });
    m.rate = m.particles / spent;
    return m;
}

/// All threads at once, each on points of its own.
Measured law(const std::string& material) {
    const Material m = make_material(read_material(material));
    std::vector<double> rates(static_cast<std::size_t>(exec::threads()));
    exec::for_each(exec::threads(), [&](std::int64_t t) { rates[static_cast<std::size_t>(t)] = LawBatch(m, 512).updates_per_second(1.0); }, 1);
    return {std::accumulate(rates.begin(), rates.end(), 0.0)};
}

const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"bandwidth", "bytes/s, a = b + s c", 0, [](const BenchOptions&) { return Measured{measure_bandwidth()}; }},
        {"arithmetic", "operations/s in double, multiply-adds in registers", 0, [](const BenchOptions&) { return Measured{measure_arithmetic<double>()}; }},
        {"arithmetic_single", "operations/s in single", 0, [](const BenchOptions&) { return Measured{measure_arithmetic<float>()}; }},
        // stress: u_j - u_i, w times it, sums of both and of z times it: 15; forces: 9 multiply-adds with T, u_j - u_i, the control: 29
        {"rock", "particle-steps/s, JH-2, double", 44, [](const BenchOptions& b) { return loop("bench/rock.toml", b, Precision::double_, 24); }},
        {"rock_single", "particle-steps/s, JH-2, single", 44, [](const BenchOptions& b) { return loop("bench/rock.toml", b, Precision::single, 24); }},
        // and the pairwise viscosity: 36
        {"copper", "particle-steps/s, Johnson-Cook, double", 80, [](const BenchOptions& b) { return loop("bench/copper.toml", b, Precision::double_, 8); }},
        // twice distance, kernel and its gradient: 52; M and grad v: 34; pressure, viscosity, heat: 64
        {"water", "particle-steps/s, neighbour search included, double", 150, [](const BenchOptions& b) { return loop("bench/water.toml", b, Precision::double_, 12); }},
        {"water_short", "the same with a smoothing length of 1.2 spacings", 150, [](const BenchOptions& b) { return loop("bench/water.toml", b, Precision::double_, 12, "short"); }},
        {"blast", "particle-steps/s, quick case to 12 us; share: contact's of the time", 0, blast},
        {"law_jh2", "updates/s, a third each elastic, yielding, failed", 0, [](const BenchOptions&) { return law("barre_granite"); }},
        {"law_johnson_cook", "updates/s, a third each elastic, yielding, failed", 0, [](const BenchOptions&) { return law("copper_ofhc"); }},
        {"law_hjc", "updates/s, a third each elastic, yielding, failed", 0, [](const BenchOptions&) { return law("concrete_hjc"); }},
        {"placement", "particles/s placed, with their neighbours", 0, placement},
        {"output", "particles/s into a snapshot", 0, output},
    };
    return all;
}

const Row& row(const std::string& name) {
    for (const Row& r : rows())
        if (r.name == name) return r;
    std::string names;
    for (const Row& r : rows()) names += (names.empty() ? "" : ", ") + r.name;
    throw InputError(fmt::format("bench: no measurement '{}'; there are: {}", name, names));
}

/// The measurement in a process of its own.
Measured elsewhere(const Row& r, int threads, const BenchOptions& o) {
    const std::string command = fmt::format("/proc/{}/exe bench {} --inside --threads {} --particles {:.0f}", getpid(), r.name, threads, o.particles);
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) throw ResourceError("cannot start a process for the measurement");
    Measured m;
    const bool read = std::fscanf(pipe, "%lf %lf %lf %lf %lf", &m.rate, &m.particles, &m.neighbours, &m.bytes, &m.share) == 5;
    if (pclose(pipe) != 0 || !read) throw ResourceError(fmt::format("bench: the measurement '{}' failed", r.name));
    return m;
}

/// The run with the median rate.
Measured median(std::vector<Measured> runs) {
    std::sort(runs.begin(), runs.end(), [](const Measured& a, const Measured& b) { return a.rate < b.rate; });
    return runs[runs.size() / 2];
}

}  // namespace

int bench_command(const BenchOptions& o) {
    if (o.inside) {
        exec::set_threads(o.threads);
        const Measured m = row(o.names.at(0)).measure(o);
        fmt::print("{} {} {} {} {}\n", m.rate, m.particles, m.neighbours, m.bytes, m.share);
        return 0;
    }
    std::vector<Row> wanted;
    for (const Row& r : rows())
        if (o.names.empty() || std::find(o.names.begin(), o.names.end(), r.name) != o.names.end()) wanted.push_back(r);
    for (const std::string& name : o.names) row(name);
    const int most = o.threads > 0 ? o.threads : exec::threads();
    std::vector<int> counts{1};
    while (2 * counts.back() < most) counts.push_back(2 * counts.back());
    if (most > 1) counts.push_back(most);

    if (!o.json) {
        fmt::print("{}, {} threads at most, median of {}\n\n", this_machine(most).cpu, most, o.repeat);
        fmt::print("{:<17} {:>7} {:>10} {:>7} {:>8} {:>7} {:>8} {:>11} {:>10} {:>6}  {}\n", "", "threads", "rate", "gain", "number", "bonds", "bytes", "arithmetic", "bandwidth", "share", "");
        std::fflush(stdout);
    }
    std::string json;
    std::vector<double> bandwidth(counts.size()), arithmetic(counts.size()), arithmetic_single(counts.size());
    for (const Row& r : wanted) {
        double alone = 0;
        for (std::size_t k = 0; k < counts.size(); ++k) {
            std::vector<Measured> runs;
            for (int n = 0; n < o.repeat; ++n) runs.push_back(elsewhere(r, counts[k], o));
            const Measured m = median(runs);
            if (r.name == "bandwidth") bandwidth[k] = m.rate;
            if (r.name == "arithmetic") arithmetic[k] = m.rate;
            if (r.name == "arithmetic_single") arithmetic_single[k] = m.rate;
            const double ceiling = r.name == "rock_single" ? arithmetic_single[k] : arithmetic[k];
            if (k == 0) alone = m.rate;
            // what must at least move: every byte of a particle in and out once a step
            const double flops = m.rate * r.per_neighbour * m.neighbours, traffic = 2 * m.bytes * m.rate;
            const double of_arithmetic = ceiling > 0 ? flops / ceiling : 0, of_bandwidth = bandwidth[k] > 0 ? traffic / bandwidth[k] : 0;
            json += fmt::format("{}\n  {{\"name\": \"{}\", \"what\": \"{}\", \"threads\": {}, \"rate\": {:.5g}, \"lowest\": {:.5g}, \"highest\": {:.5g}, \"particles\": {:.0f}, \"neighbours\": {:.1f}, "
                                "\"bytes_per_particle\": {:.0f}, \"operations_per_second\": {:.4g}, \"of_arithmetic\": {:.3f}, \"of_bandwidth\": {:.3f}, \"share\": {:.3f}}}",
                                json.empty() ? "" : ",", r.name, r.what, counts[k], m.rate,
                                std::min_element(runs.begin(), runs.end(), [](auto& a, auto& b) { return a.rate < b.rate; })->rate,
                                std::max_element(runs.begin(), runs.end(), [](auto& a, auto& b) { return a.rate < b.rate; })->rate, m.particles, m.neighbours, m.bytes, flops,
                                of_arithmetic, of_bandwidth, m.share);
            if (o.json) continue;
            const auto or_dash = [](double x, const std::string& text) { return x > 0 ? text : std::string("-"); };
            fmt::print("{:<17} {:>7} {:>10.3g} {:>7} {:>8} {:>7} {:>8} {:>11} {:>10} {:>6}  {}\n", k ? "" : r.name, counts[k], m.rate, or_dash(double(k), fmt::format("{:.2f}", m.rate / alone)),
                       or_dash(m.particles, fmt::format("{:.3g}", m.particles)), or_dash(m.neighbours, fmt::format("{:.1f}", m.neighbours)), or_dash(m.bytes, fmt::format("{:.0f}", m.bytes)),
                       or_dash(of_arithmetic, fmt::format("{:.1f} %", 100 * of_arithmetic)), or_dash(of_bandwidth, fmt::format("{:.0f} %", 100 * of_bandwidth)),
                       or_dash(m.share, fmt::format("{:.0f} %", 100 * m.share)), k ? "" : r.what);
            std::fflush(stdout);
        }
    }
    if (o.json) fmt::print("{{\"version\": \"{}\", \"commit\": \"{}\", \"cpu\": \"{}\", \"build\": \"{}\", \"repeat\": {}, \"rows\": [{}\n]}}\n", version(), commit(), this_machine(most).cpu, build_features(), o.repeat, json);
    return 0;
}

}  // namespace brisance
