// SPDX-License-Identifier: Apache-2.0
// The folder of a run: where each file goes, how it gets there whole, and how the run can be repeated (provenance.json).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brisance {

/// Where a file is written before it gets its name: path + ".part".
std::filesystem::path part_path(const std::filesystem::path& path);

/// Gives a finished ".part" its name: fsync, rename, fsync of the folder. A reader sees the old file or the whole new one.
/// Throws ResourceError with path and cause; the part is then removed.
void publish(const std::filesystem::path& path);

/// Writes a small text file by way of its ".part". Throws ResourceError with path and cause.
void write_file(const std::filesystem::path& path, std::string_view text);

struct Machine {
    std::string cpu;   ///< as the kernel names it, "unknown" where it does not
    int threads = 1;
    std::string host;
    std::string device;  ///< the card that computes; empty: the processor
};

/// `threads` is what the run computes with, as the caller has set it.
Machine this_machine(int threads);

/// Now, as ISO 8601 in UTC: "2024-05-17T09:30:00Z".
std::string utc_now();

/// What provenance.json says. Rewritten as the run goes: `status` tells where it is.
struct Provenance {
    std::string version, commit, build;     ///< filled by the constructor
    std::string command;                    ///< the command line, one string
    std::string started, finished;          ///< utc_now(); `finished` is empty (null in the file) while the run goes
    Machine machine;
    std::string title, case_file, preset;
    std::vector<std::string> settings;      ///< the --set arguments
    std::string status = "running";         ///< "running", "finished", "stopped", "interrupted", ...
    double wall_seconds = 0;
    std::uint64_t steps = 0;
    std::vector<std::pair<std::string, std::uint64_t>> particles;  ///< part -> number
    std::vector<std::pair<std::string, double>> rates;             ///< what -> per second
    struct Slice {
        double z_mm = 0;
        int layers = 0;
        double thickness_mm = 0;
    };
    std::optional<Slice> slice;
    struct Resumed {
        std::string at, command;   ///< utc_now(), the command line
        double from_us = 0;
    };
    std::vector<Resumed> resumed;           ///< each time that the run went on from a checkpoint

    Provenance();
};

/// The text of provenance.json, schema 1. A number that is not finite becomes null.
std::string to_json(const Provenance& provenance);

class RunDirectory {
public:
    /// "runs/<case>-<preset>": the stem of the case file, or the name of its folder where the stem says only "case".
    static std::filesystem::path default_path(const std::filesystem::path& case_file, const std::string& preset);

    /// Makes the folder with snapshots/, gauges/ and analysis/. A folder that holds files is refused unless `overwrite`, which
    /// removes what a run writes and nothing else. Throws InputError for a refusal, ResourceError where the system refuses, or where
    /// another process runs in this folder. One holds it until the end of the object; the kernel gives it back when a process dies.
    RunDirectory(std::filesystem::path path, bool overwrite);

    /// The folder of an earlier run, to go on in it. Throws InputError where it is none, ResourceError where another process runs in it.
    static RunDirectory existing(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path file(const std::string& name) const { return path_ / name; }
    std::filesystem::path snapshots() const { return path_ / "snapshots"; }
    std::filesystem::path gauges() const { return path_ / "gauges"; }
    std::filesystem::path analysis() const { return path_ / "analysis"; }
    std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }

    /// Writes path()/name whole or not at all.
    void write_text(const std::string& name, std::string_view text) const { write_file(file(name), text); }
    void write_provenance(const Provenance& provenance) const { write_text("provenance.json", to_json(provenance)); }

private:
    RunDirectory() = default;
    void hold();
    std::filesystem::path path_;
    std::shared_ptr<const int> held_;   ///< the open folder
};

}  // namespace brisance
