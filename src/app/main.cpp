// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "base/error.h"
#include "base/version.h"
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
    app.set_version_flag("--version", fmt::format("brisance {} ({}), {}", version(), commit(), build_features()));
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
    resume->add_flag("--older", older, "from the checkpoint before the newest");
    resume->add_flag("--quiet", o.quiet, "warnings only");
    resume->add_flag("!--no-report", o.report, "do not write the report");
    resume->add_option("--hash-every", o.hash_every, "log a hash of the whole state every so many steps")->check(CLI::PositiveNumber);
    resume->callback([&] { code = resume_command(name, older, o); });

    CLI::App* check = app.add_subcommand("check", "particles, memory, first step, time; runs nothing");
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

    CLI::App* materials = app.add_subcommand("materials", "the material library: constants, sources, checks");
    materials->add_option("name", name, "one material, in full");
    materials->add_flag("--json", json, "machine-readable");
    materials->callback([&] { code = materials_command(name, json); });

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

int main(int argc, char** argv) {
    wait_politely(argv);
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
