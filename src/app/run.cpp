// SPDX-License-Identifier: Apache-2.0
// brisance run: a case from start to report; brisance resume: on from a checkpoint.
#include "app/assembly.h"
#include "app/checkpoint.h"
#include "app/commands.h"
#include "app/recorder.h"
#include "base/error.h"
#include "io/case_file.h"
#include "io/log.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>

namespace brisance {

namespace {

volatile std::sig_atomic_t stop_asked = 0, checkpoint_asked = 0;
void ask_to_stop(int) { stop_asked = 1; }
void ask_for_checkpoint(int) { checkpoint_asked = 1; }

/// From the start, or on from a checkpoint.
enum class Begin { anew, newest, older };

double seconds_since(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

/// Particles by part, for the provenance.
template <class R>
std::vector<std::pair<std::string, std::uint64_t>> particle_counts(const World<R>& w) {
    std::vector<std::pair<std::string, std::uint64_t>> n;
    for (const auto& s : w.solids) n.emplace_back(s.body.name, static_cast<std::uint64_t>(s.body.layout.particles));
    for (const auto& f : w.fluids) n.emplace_back(f.body.name, static_cast<std::uint64_t>(f.body.size()));
    return n;
}

template <class R>
int run(const Case& c, const CaseOptions& o, const RunDirectory& directory, Log& log, Begin from) {
    Provenance p;
    p.command = o.command;
    p.started = utc_now();
    p.machine = this_machine(exec::threads());
    p.title = c.title;
    p.case_file = c.file;
    p.preset = c.preset;
    p.settings = c.settings;
    if (from == Begin::anew) directory.write_text("case.toml", c.resolved);
    directory.write_provenance(p);

    const auto setup = std::chrono::steady_clock::now();
    World<R> w = assemble<R>(c, [&](const std::string& text) { log.line(text); });
    p.particles = particle_counts(w);
    std::uint64_t all = 0;
    for (const auto& [name, n] : p.particles) all += n;
    if (c.slice) {
        const Extent e = slice_extent(c);
        p.slice = Provenance::Slice{c.slice->z, c.slice->layers, e.high - e.low};
    }
    begin(w);
    Recorder<R> recorder(c, w, directory, from != Begin::anew);
    Checkpoints checkpoints(directory);
    if (from != Begin::anew) {
        const std::string where = checkpoints.read(w, recorder, from == Begin::older);
        recorder.go_on(w);
        log.line("on from " + where);
    }
    log.line(fmt::format("set up in {:.1f} s; {} particles, until {:g} us", seconds_since(setup), all, c.until));

    const auto start = std::chrono::steady_clock::now();
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
    std::signal(SIGUSR1, ask_for_checkpoint);
    const std::int64_t first_step = w.steps;
    auto written = start;
    const auto close = [&](const std::string& status) {
        log.end_progress();
        recorder.finish(w);
        p.status = status;
        p.finished = utc_now();
        p.wall_seconds = seconds_since(start);
        p.steps = static_cast<std::uint64_t>(w.steps);
        p.rates.clear();
        if (p.wall_seconds > 0) {
            for (const auto& [name, seconds] : w.seconds) {
                double n = 0;
                for (const auto& [part, count] : p.particles)
                    if (part == name) n = static_cast<double>(count);
                if (seconds > 0 && n > 0) p.rates.emplace_back(name, n * static_cast<double>(w.steps - first_step) / seconds);
            }
            p.rates.emplace_back("all", static_cast<double>(all) * static_cast<double>(w.steps - first_step) / p.wall_seconds);
        }
        directory.write_provenance(p);
    };
    try {
        Audit latest = from == Begin::anew ? recorder.record(w).value_or(Audit{}) : audit(w);
        while (w.time < c.until - 1e-9 && !stop_asked) {
            step(w, std::min(c.until, recorder.next_due()));
            if (const auto row = recorder.record(w)) {
                latest = *row;
                watch(w, latest);
            }
            Progress progress;
            progress.t_us = w.time;
            progress.until_us = c.until;
            progress.dt_us = w.dt;
            progress.steps = static_cast<std::uint64_t>(w.steps);
            progress.wall_seconds = seconds_since(start);
            progress.rate = static_cast<double>(all) * static_cast<double>(w.steps - first_step) / std::max(progress.wall_seconds, 1e-9);
            progress.energy_residual = latest.residual_relative;
            progress.damaged = static_cast<double>(latest.damaged) / static_cast<double>(std::max<std::uint64_t>(all, 1));
            log.progress(progress);
            if (o.hash_every > 0 && w.steps % o.hash_every == 0) {
                StateHash hash;
                each_field(w, hash);
                log.line(fmt::format("step {} t {} us state {:016x}", w.steps, w.time, hash.value()));
            }
            if (checkpoint_asked || 1e6 * seconds_since(written) > c.output.checkpoint_interval) {
                checkpoints.write(w, recorder);
                written = std::chrono::steady_clock::now();
                checkpoint_asked = 0;
            }
        }
        checkpoints.write(w, recorder);
        if (stop_asked) {
            close("interrupted");
            throw Interrupted(fmt::format("stopped by a signal at t = {:.3f} us; go on with: brisance resume {}", w.time, directory.path().string()));
        }
        close("finished");
        log.line(fmt::format("{} steps in {:.1f} s; energy residual {:.2e}, momentum residual {:.1e}, largest penetration {:.3f} mm ({}), leaked {}, torn {}",
                             w.steps, p.wall_seconds, latest.residual_relative, latest.momentum_residual, latest.penetration, latest.penetration_where,
                             recorder.leaked(), latest.torn));
        std::string shares = "time:";
        for (const auto& [name, seconds] : w.seconds) shares += fmt::format("  {} {:.0f} %", name, 100 * seconds / p.wall_seconds);
        log.line(shares);
    } catch (const PhysicsStop&) {
        close("physics stop");
        throw;
    }
    return 0;
}

int run_and_report(const Case& c, const CaseOptions& o, const RunDirectory& directory, Begin from) {
    Log::Options log_options;
    log_options.quiet = o.quiet;
    Log log(stderr, log_options);
    log.open(directory.file("log.txt"), from != Begin::anew);
    log.line(fmt::format("{} ({}{}) -> {}", c.title, c.file, c.preset.empty() ? "" : ", preset " + c.preset, directory.path().string()));
    const int code = c.precision == Precision::single ? run<float>(c, o, directory, log, from) : run<double>(c, o, directory, log, from);
    if (code == 0 && o.report) {
        const int written = run_python("report.py", {directory.path().string(), "--no-pdf"});
        if (written != 0) log.warning("the report could not be written; the run itself is complete (brisance report " + directory.path().string() + ")");
        else log.line("report: " + (directory.path() / "report.html").string());
    }
    return code;
}

}  // namespace

int run_command(const CaseOptions& o) {
    const Case c = open_case(o);
    require_memory(c, estimate(c));
    const RunDirectory directory(o.out.empty() ? RunDirectory::default_path(o.file, o.preset) : std::filesystem::path(o.out), o.overwrite);
    return run_and_report(c, o, directory, Begin::anew);
}

int resume_command(const std::string& run, bool older, const CaseOptions& o) {
    const RunDirectory directory = RunDirectory::existing(run);
    CaseOptions with_case = o;
    with_case.file = directory.file("case.toml").string();
    const Case c = open_case(with_case);
    require_memory(c, estimate(c));
    return run_and_report(c, with_case, directory, older ? Begin::older : Begin::newest);
}

}  // namespace brisance
