// SPDX-License-Identifier: Apache-2.0
// The commands that Python does: report, view, verify. The interpreter must have the modules, and the first python3 of a PATH often has not.
#include "app/commands.h"
#include "base/error.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace brisance {

namespace {

int spawn(const std::vector<std::string>& command, bool silent) {
    const pid_t child = fork();
    if (child < 0) throw ResourceError("cannot start another process: fork failed");
    if (child == 0) {
        if (silent) {
            if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr)) _exit(127);
        }
        std::vector<char*> argv;
        for (const std::string& a : command) argv.push_back(const_cast<char*>(a.c_str()));
        argv.push_back(nullptr);
        execvp(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    if (waitpid(child, &status, 0) < 0) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// An interpreter that has numpy, scipy, h5py and matplotlib: BRISANCE_PYTHON, Debian's, the first of the PATH.
std::string interpreter() {
    std::vector<std::string> candidates;
    if (const char* given = std::getenv("BRISANCE_PYTHON")) candidates.emplace_back(given);
    candidates.insert(candidates.end(), {"/usr/bin/python3", "python3"});
    for (const std::string& c : candidates)
        if (spawn({c, "-c", "import numpy, scipy, h5py, matplotlib"}, true) == 0) return c;
    throw ResourceError("no Python with numpy, scipy, h5py and matplotlib was found (tried BRISANCE_PYTHON, /usr/bin/python3, python3); on Debian: "
                        "apt install python3-scipy python3-h5py python3-matplotlib");
}

}  // namespace

int run_python(const std::string& script, const std::vector<std::string>& arguments) {
    const char* given = std::getenv("BRISANCE_HOME");
    const std::filesystem::path home = given ? given : BRISANCE_SOURCE_DIR;
    std::vector<std::string> command{interpreter(), (home / "python" / "brisance" / script).string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return spawn(command, false);
}

int report_command(const std::vector<std::string>& runs, const std::string& out, bool pdf) {
    std::vector<std::string> arguments = runs;
    if (!out.empty()) arguments.insert(arguments.end(), {"--out", out});
    if (!pdf) arguments.emplace_back("--no-pdf");
    return run_python("report.py", arguments);
}

int verify_command(const std::vector<std::string>& arguments) {
    setenv("BRISANCE", std::filesystem::read_symlink("/proc/self/exe").c_str(), 1);  // the cases are run by this very program
    return run_python("verify.py", arguments);
}

int view_command(const std::string& run) { return run_python("view.py", {run}); }

}  // namespace brisance
