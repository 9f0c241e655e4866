// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "base/error.h"
#include "base/version.h"
#include "exec/device.h"
#include "exec/exec.h"
#include "io/case_file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <unistd.h>

namespace brisance {

int reference_command() {
    fmt::print("{}", case_file_reference());
    return 0;
}

namespace {

int main_with_errors(int argc, char** argv) {
    CLI::App app{"brisance: how rock breaks under a blast"};
    app.set_version_flag("--version", [] {
        const exec::DeviceInfo device = exec::device_info();
        return fmt::format("brisance {} ({}), {}{}", version(), commit(), build_features(), !device.built ? "" : (device.found ? ", device: " : ", no device: ") + device.name);
    });
    app.require_subcommand(1);
    app.footer("Exit codes: 0 ok, 2 bad input, 3 stopped by the physics, 4 memory, disk or permission, 5 interrupted.\n"
               "Start with: brisance run cases/blast/air_copper.toml --preset quick");

    CaseOptions o;
    for (int i = 0; i < argc; ++i) o.command += (i ? " " : "") + std::string(i ? argv[i] : "./brisance");

    const auto case_flags = [&](CLI::App* c) {
        c->add_option("case", o.file, "case file (TOML)")->required();
        c->add_option("--preset", o.preset, "a preset of the case file");
        c->add_option("--set", o.settings, "key=value, overrides the case: --set rock.spacing=\"0.4 mm\"")->allow_extra_args(false);
        c->add_option("--until", o.until, "end time, for example \"20 us\"");
        c->add_option("--threads", o.threads, "number of threads (default: all)")->check(CLI::Range(1, 4096));
        c->add_option("--device", o.device, "cpu, cuda, or auto: a GPU where this build and the machine have one")->check(CLI::IsMember({"auto", "cpu", "cuda"}));
    };
    int code = 0;

    CLI::App* run = app.add_subcommand("run", "run a case and write its report");
    case_flags(run);
    run->add_option("--out", o.out, "run directory (default: runs/<case>-<preset>)");
    run->add_flag("--overwrite", o.overwrite, "replace what an earlier run left in the directory");
    run->add_flag("--quiet", o.quiet, "warnings only");
    run->add_option("--hash-every", o.hash_every, "log a hash of the whole state every so many steps")->check(CLI::PositiveNumber);
    run->add_flag("!--no-report", o.report, "do not write the report");
    run->callback([&] { code = run_command(o); });

    std::string name;
    bool older = false;
    CLI::App* resume = app.add_subcommand("resume", "go on from a checkpoint of a run, to the same bits");
    resume->add_option("run", name, "run directory")->required();
    resume->add_option("--until", o.until, "another end time, for example \"200 us\"");
    resume->add_option("--threads", o.threads, "number of threads (default: all)")->check(CLI::Range(1, 4096));
    resume->add_option("--device", o.device, "cpu, cuda, or auto (default)")->check(CLI::IsMember({"auto", "cpu", "cuda"}));
    resume->add_flag("--older", older, "from the checkpoint before the newest");
    resume->add_flag("--quiet", o.quiet, "warnings only");
    resume->add_flag("!--no-report", o.report, "do not write the report");
    resume->add_option("--hash-every", o.hash_every, "log a hash of the whole state every so many steps")->check(CLI::PositiveNumber);
    resume->callback([&] { code = resume_command(name, older, o); });

    CLI::App* check = app.add_subcommand("check", "particles, memory, first step, time; runs nothing of the case");
    case_flags(check);
    check->add_flag("--json", o.json, "machine-readable");
    check->callback([&] { code = check_command(o); });

    std::vector<std::string> runs;
    std::string out;
    bool no_pdf = false, json = false;
    CLI::App* analyze = app.add_subcommand("analyze", "fracture analysis again, from a run's snapshots");
    analyze->add_option("run", name, "run directory")->required();
    analyze->add_flag("--json", json, "print the analysis");
    analyze->callback([&] { code = analyze_command(name, json); });

    CLI::App* report = app.add_subcommand("report", "one HTML page with all figures; several runs are compared");
    report->add_option("run", runs, "run directories")->required();
    report->add_option("--out", out, "where the page goes");
    report->add_flag("--no-pdf", no_pdf, "figures as PNG only");
    report->callback([&] { code = report_command(runs, out, !no_pdf); });

    CLI::App* view = app.add_subcommand("view", "write a ParaView script that shows damage on cuts");
    view->add_option("run", name, "run directory")->required();
    view->callback([&] { code = view_command(name); });

    std::vector<std::string> cases;
    std::string lane = "quick";
    bool list = false, docs = false;
    CLI::App* verify = app.add_subcommand("verify", "run verification cases and hold them against their exact solutions; exit code 1 where a bound is missed");
    verify->add_option("case", cases, "names of folders in cases/verification (default: all of the lane)");
    verify->add_option("--lane", lane, "quick: minutes; full: all spacings and cases")->check(CLI::IsMember({"quick", "full"}));
    verify->add_option("--out", out, "where runs, pages and verify.json go (default: runs/verify)");
    verify->add_flag("--json", json, "print the results as JSON");
    verify->add_flag("--list", list, "name the cases, run nothing");
    verify->add_flag("--docs", docs, "write the pages of docs/verification too");
    verify->callback([&] {
        std::vector<std::string> arguments = cases;
        arguments.insert(arguments.end(), {"--lane", lane});
        if (!out.empty()) arguments.insert(arguments.end(), {"--out", out});
        for (const auto& [given, flag] : {std::pair{json, "--json"}, {list, "--list"}, {docs, "--docs"}})
            if (given) arguments.emplace_back(flag);
        code = verify_command(arguments);
    });

    CLI::App* materials = app.add_subcommand("materials", "the material library: constants, sources, checks");
    materials->add_option("name", name, "one material, in full");
    materials->add_flag("--json", json, "machine-readable");
    bool full = false;
    materials->add_flag("--full", full, "with the source and the checks of each");
    materials->callback([&] { code = materials_command(name, json, full); });

    PointOptions point;
    CLI::App* material = app.add_subcommand("material", "drives a material at one point along a path: stress, damage, energy");
    material->add_option("material", point.material, "a material of the library, or a file")->required();
    material->add_option("--path", point.path, "a preset, or a path file (TOML; docs/material-point.md)")->capture_default_str();
    material->add_option("--strain", point.strain, "how far the preset goes: 0.05 or \"5 %\"");
    material->add_option("--rate", point.rate, "strain rate (default \"1000 1/s\")");
    material->add_option("--confinement", point.confinement, "side pressure, \"50 MPa\"; several draw several curves")->allow_extra_args(false);
    material->add_option("--pressure", point.pressure, "\"1 GPa\", of hydrostatic paths");
    material->add_option("--velocity", point.velocity, "particle velocity of shocks (default \"500 m/s\")");
    material->add_option("--volume", point.volume, "V/V0 at the end of a release")->check(CLI::PositiveNumber);
    material->add_option("--scale", point.scale, "strength scale of the place")->check(CLI::PositiveNumber);
    material->add_option("--damage", point.damage, "damage at the start")->check(CLI::Range(0.0, 1.0));
    material->add_option("--steps", point.steps, "steps of each leg (default 1000)")->check(CLI::Range(1, 10000000));
    material->add_option("--csv", point.csv, "write all rows to this file");
    material->add_flag("--json", point.json, "print all rows as JSON");
    material->add_option("--plot", point.plot, "draw the curves to this PNG");
    material->footer("Presets of --path:\n" + point_presets());
    material->callback([&] { code = material_command(point); });

    BenchOptions bench_options;
    CLI::App* bench = app.add_subcommand("bench", "speed of every part of a step on this machine, beside what the machine can do at most");
    bench->add_option("name", bench_options.names, "rock, rock_single, copper, water, blast, law_jh2, law_johnson_cook, law_hjc, placement, output, bandwidth, arithmetic, arithmetic_single (default: all)");
    bench->add_option("--threads", bench_options.threads, "from one to so many (default: all)")->check(CLI::Range(1, 4096));
    bench->add_option("--repeat", bench_options.repeat, "runs of each, of which the median counts")->check(CLI::Range(1, 99))->capture_default_str();
    bench->add_option("--particles", bench_options.particles, "size of the loops (default: half a million)")->check(CLI::Range(0.0, 1e10));
    bench->add_flag("--json", bench_options.json, "machine-readable");
    bench->add_flag("--inside", bench_options.inside)->group("");
    bench->callback([&] { code = bench_command(bench_options); });

    CLI::App* reference = app.add_subcommand("reference", "every key of a case file, as Markdown");
    reference->callback([&] { code = reference_command(); });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int parse = app.exit(e);
        return parse == 0 ? 0 : static_cast<int>(Exit::bad_input);
    }
    return code;
}

}  // namespace
}  // namespace brisance

/// Threads that wait for each other must not spin for long on a machine that others use too. The OpenMP runtime reads its settings
/// before main, so the program starts itself once more with them.
void wait_politely(char** argv) {
    if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
    setenv("GOMP_SPINCOUNT", "5000", 1);
    execv("/proc/self/exe", argv);  // where this fails the run goes on as it is
}

/// Memory can run out in any thread, where no exception may pass. The words are put together without asking for more.
[[noreturn]] void out_of_memory() {
    char text[512];
    long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    const int length = std::snprintf(text, sizeof text,
                                     "error: out of memory: %ld MiB are in use, and the system gives no more (free memory, ulimit -v, or the limit of a batch job)\n"
                                     "  `brisance check CASE` tells what a case needs; a run that has begun goes on from its last checkpoint: brisance resume RUN\n",
                                     pages * (sysconf(_SC_PAGESIZE) / 1024) / 1024);
    if (length > 0 && write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) std::_Exit(static_cast<int>(brisance::Exit::resources));
    std::_Exit(static_cast<int>(brisance::Exit::resources));
}

int main(int argc, char** argv) {
    wait_politely(argv);
    brisance::exec::flush_denormals();
    std::set_new_handler(out_of_memory);
    try {
        return brisance::main_with_errors(argc, argv);
    } catch (const brisance::Error& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "error: out of memory; `brisance check` tells what a case needs\n");
        return static_cast<int>(brisance::Exit::resources);
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 1;
    }
}
