// SPDX-License-Identifier: Apache-2.0
// brisance run: a case from start to report; brisance resume: on from a checkpoint.
#include "app/assembly.h"
#include "app/checkpoint.h"
#include "app/commands.h"
#include "app/recorder.h"
#include "base/error.h"
#include "exec/device.h"
#include "integrate/watchdog.h"
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

/// What the run is, at its beginning; `from`: where it goes on.
Provenance provenance_of(const Case& c, const CaseOptions& o, const Checkpoints::Found* from) {
    Provenance p;
    if (from) {
        p = from->provenance;
        p.resumed.push_back({utc_now(), o.command, from->time});
    } else {
        p.command = o.command;
        p.started = utc_now();
        p.case_file = c.file;
        p.preset = c.preset;
        p.settings = c.settings;
    }
    p.machine = this_machine(exec::threads());
    if (exec::on_device()) p.machine.device = exec::device_info().name;
    p.title = c.title;
    return p;
}

template <class R>
int run(const Case& c, const CaseOptions& o, const RunDirectory& directory, Log& log, const Checkpoints::Found* from) {
    Provenance p = provenance_of(c, o, from);
    if (!from) directory.write_text("case.toml", c.resolved);
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
    Recorder<R> recorder(c, w, directory, from != nullptr);
    Checkpoints checkpoints(directory);
    if (from) {
        checkpoints.read(*from, w, recorder);
        recorder.go_on(w);
        log.line(fmt::format("on from {} at {} us{}", from->path.filename().string(), w.time, from->remark));
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
        Audit latest = from ? audit(w) : recorder.record(w).value_or(Audit{});
        while (w.time < c.until - 1e-9 && !stop_asked) {
            step(w, std::min(c.until, recorder.next_due()));
            if (const auto row = recorder.record(w)) {
                latest = *row;
                watch(w, latest, recorder.leaks());
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
                checkpoints.write(w, recorder, p, c.until);
                written = std::chrono::steady_clock::now();
                checkpoint_asked = 0;
            }
        }
        checkpoints.write(w, recorder, p, c.until);
        if (stop_asked) {
            close("interrupted");
            throw Interrupted(fmt::format("stopped by a signal at t = {:.3f} us; go on with: brisance resume {}", w.time, directory.path().string()));
        }
        close("finished");
        log.line(fmt::format("{} steps in {:.1f} s; energy residual {:.2e}, momentum residual {:.1e}, largest penetration {:.3f} mm ({}), leaked {}, torn {}",
                             w.steps, p.wall_seconds, latest.residual_relative, latest.momentum_residual, latest.penetration, latest.penetration_where,
                             recorder.leaks().count, latest.torn));
        std::string shares = "time:";
        for (const auto& [name, seconds] : w.seconds) shares += fmt::format("  {} {:.0f} %", name, 100 * seconds / p.wall_seconds);
        log.line(shares);
    } catch (const PhysicsStop&) {
        close("physics stop");
        throw;
    } catch (const ResourceError& e) {
        log.end_progress();
        p.status = "stopped";
        p.finished = utc_now();
        try {
            directory.write_provenance(p);
        } catch (const ResourceError&) {  // the same disk
        }
        throw ResourceError(fmt::format("{}\n  t = {:.3f} us; mend it, then go on from the last checkpoint: brisance resume {}", e.what(), w.time, directory.path().string()));
    }
    return 0;
}

int run_and_report(const Case& c, const CaseOptions& o, const RunDirectory& directory, const Checkpoints::Found* from) {
    Log::Options log_options;
    log_options.quiet = o.quiet;
    Log log(stderr, log_options);
    log.open(directory.file("log.txt"), from != nullptr);
    const std::string &file = from ? from->provenance.case_file : c.file, &preset = from ? from->provenance.preset : c.preset;
    log.line(fmt::format("{} ({}{}) -> {}", c.title, file, preset.empty() ? "" : ", preset " + preset, directory.path().string()));
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
    return run_and_report(c, o, directory, nullptr);
}

int resume_command(const std::string& run, bool older, const CaseOptions& o) {
    const RunDirectory directory = RunDirectory::existing(run);
    const Checkpoints::Found from = Checkpoints(directory).find(older);
    CaseOptions with_case = o;
    with_case.file = directory.file("case.toml").string();
    if (o.until.empty()) with_case.until = fmt::format("{} us", from.until);  // as far as the run was last told to go
    const Case c = open_case(with_case);
    if (c.until < from.time)
        throw InputError(fmt::format("--until \"{}\": {} stands at t = {} us already; a run goes forward only", o.until, from.path.string(), from.time));
    require_memory(c, estimate(c));
    return run_and_report(c, with_case, directory, &from);
}

}  // namespace brisance
