// SPDX-License-Identifier: Apache-2.0
#include "io/run_directory.h"

#include "base/error.h"
#include "base/version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <system_error>

namespace brisance {

namespace fs = std::filesystem;

namespace {

constexpr const char* folders[] = {"snapshots", "gauges", "analysis", "checkpoints"};
constexpr const char* written_by_a_run[] = {"case.toml", "provenance.json", "log.txt",   "audit.csv",   "history.csv",
                                            "gauges",    "analysis",        "snapshots", "report.html", "figures", "checkpoints"};

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
    throw ResourceError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::error_code& error) {
    throw ResourceError(fmt::format("{}: {}: {}", path.string(), what, error.message()));
}

/// 0 or an errno.
int sync(const fs::path& path, int flags) {
    const int fd = ::open(path.c_str(), flags | O_CLOEXEC);
    if (fd < 0) return errno;
    const int error = ::fsync(fd) == 0 ? 0 : errno;
    ::close(fd);
    return error == EINVAL ? 0 : error;  // some file systems have nothing to synchronise
}

/// 0 or an errno.
int write_all(int fd, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(fd, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count < 0 ? errno : ENOSPC;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

std::string json_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += fmt::format("\\{}", c);
        else if (c == '\n') out += "\\n";
        else if (c == '\t') out += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20) out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else out += c;
    }
    return out + '"';
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string joined(const std::vector<std::string>& texts, std::string_view separator) {
    std::string all;
    for (const std::string& text : texts) all.append(all.empty() ? "" : separator).append(text);
    return all;
}

bool holds_files(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) return true;
    return false;
}

/// Makes room in a folder that holds files, or says why not.
void clear_for_overwrite(const fs::path& path, bool overwrite) {
    if (!overwrite)
        throw InputError(fmt::format("{}: the folder holds files; name another with --out, or ask for --overwrite", path.string()));
    if (!fs::exists(path / "provenance.json") && !fs::exists(path / "log.txt"))
        throw InputError(fmt::format("{}: the folder holds files but no provenance.json or log.txt, so it is not the folder of a run; "
                                     "nothing was removed, name another with --out", path.string()));
    for (const char* name : written_by_a_run) fs::remove_all(path / name);
}

}  // namespace

fs::path part_path(const fs::path& path) { return path.string() + ".part"; }

void publish(const fs::path& path) {
    const fs::path part = part_path(path);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    int error = sync(part, O_RDONLY);
    if (error == 0 && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
    if (error == 0) error = sync(folder, O_RDONLY | O_DIRECTORY);
    if (error != 0) {
        ::unlink(part.c_str());
        fail(path, "cannot write", error);
    }
}

void write_file(const fs::path& path, std::string_view text) {
    const fs::path part = part_path(path);
    const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) fail(path, "cannot create", errno);
    int error = write_all(fd, text);
    if (::close(fd) != 0 && error == 0) error = errno;
    if (error != 0) {
        ::unlink(part.c_str());
        fail(path, "cannot write", error);
    }
    publish(path);
}

Machine this_machine(int threads) {
    Machine machine{"unknown", threads, "unknown", ""};
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        const auto value = line.find(": ");
        if (!line.starts_with("model name") || value == line.npos) continue;
        machine.cpu = line.substr(value + 2);
        break;
    }
    char host[256] = {};
    if (::gethostname(host, sizeof host - 1) == 0) machine.host = host;
    return machine;
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

Provenance::Provenance() : version(brisance::version()), commit(brisance::commit()), build(build_features()) {}

std::string to_json(const Provenance& p) {
    std::vector<std::string> settings, particles, rates, resumed;
    for (const auto& setting : p.settings) settings.push_back(json_string(setting));
    for (const auto& [part, count] : p.particles) particles.push_back(fmt::format("{}: {}", json_string(part), count));
    for (const auto& [what, rate] : p.rates) rates.push_back(fmt::format("{}: {}", json_string(what), number(rate)));
    for (const auto& r : p.resumed)
        resumed.push_back(fmt::format(R"({{"at": {}, "command": {}, "from_us": {}}})", json_string(r.at), json_string(r.command), number(r.from_us)));
    const std::string slice = !p.slice ? "null"
                                       : fmt::format(R"({{"z_mm": {}, "layers": {}, "thickness_mm": {}}})", number(p.slice->z_mm),
                                                     p.slice->layers, number(p.slice->thickness_mm));
    const std::pair<const char*, std::string> members[] = {
        {"schema", "1"},
        {"version", json_string(p.version)},
        {"commit", json_string(p.commit)},
        {"build", json_string(p.build)},
        {"command", json_string(p.command)},
        {"started", json_string(p.started)},
        {"finished", p.finished.empty() ? "null" : json_string(p.finished)},
        {"machine", fmt::format(R"({{"cpu": {}, "threads": {}, "host": {}, "device": {}}})", json_string(p.machine.cpu), p.machine.threads, json_string(p.machine.host),
                                p.machine.device.empty() ? "null" : json_string(p.machine.device))},
        {"title", json_string(p.title)},
        {"case_file", json_string(p.case_file)},
        {"preset", json_string(p.preset)},
        {"settings", fmt::format("[{}]", joined(settings, ", "))},
        {"status", json_string(p.status)},
        {"wall_seconds", number(p.wall_seconds)},
        {"steps", fmt::format("{}", p.steps)},
        {"particles", fmt::format("{{{}}}", joined(particles, ", "))},
        {"rates", fmt::format("{{{}}}", joined(rates, ", "))},
        {"slice", slice},
        {"resumed", fmt::format("[{}]", joined(resumed, ", "))},
    };
    std::vector<std::string> lines;
    for (const auto& [name, value] : members) lines.push_back(fmt::format("  \"{}\": {}", name, value));
    return fmt::format("{{\n{}\n}}\n", joined(lines, ",\n"));
}

fs::path RunDirectory::default_path(const fs::path& case_file, const std::string& preset) {
    const fs::path stem = case_file.stem();
    const fs::path folder = fs::absolute(case_file).lexically_normal().parent_path().filename();
    const std::string name = stem == "case" && !folder.empty() ? folder.string() : stem.string();
    return fs::path("runs") / (preset.empty() ? name : name + "-" + preset);
}

RunDirectory::RunDirectory(fs::path path, bool overwrite) : path_(std::move(path)) {
    try {
        if (fs::exists(path_) && !fs::is_directory(path_)) throw InputError(path_.string() + ": is a file, not a folder for a run");
        fs::create_directories(path_);
        hold();
        if (holds_files(path_)) clear_for_overwrite(path_, overwrite);
        for (const char* folder : folders) fs::create_directories(path_ / folder);
    } catch (const fs::filesystem_error& error) {
        fail(error.path1().empty() ? path_ : error.path1(), "cannot prepare the folder of the run", error.code());
    }
}

RunDirectory RunDirectory::existing(fs::path path) {
    if (!fs::exists(path / "case.toml")) throw InputError(path.string() + ": is not the folder of a run: it has no case.toml");
    RunDirectory run;
    run.path_ = std::move(path);
    run.hold();
    try {
        for (const char* folder : folders) fs::create_directories(run.path_ / folder);
    } catch (const fs::filesystem_error& error) {
        fail(error.path1(), "cannot prepare the folder of the run", error.code());
    }
    return run;
}

void RunDirectory::hold() {
    const int fd = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) fail(path_, "cannot open the folder of the run", errno);
    held_ = std::shared_ptr<const int>(new int(fd), [](const int* held) {
        ::close(*held);
        delete held;
    });
    // a file system without locks guards nothing, and is no reason to stop
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw ResourceError(path_.string() + ": another brisance runs in this folder; wait for its end, stop it, or name another folder with --out");
}

}  // namespace brisance
