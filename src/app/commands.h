// SPDX-License-Identifier: Apache-2.0
// What the program can be asked to do. Each returns an exit code (base/error.h); errors are thrown.
#pragma once

#include "io/case.h"

#include <string>
#include <vector>

namespace brisance {

struct Estimate;

/// What the commands on a case have in common.
struct CaseOptions {
    std::string file, preset;
    std::vector<std::string> settings;
    std::string out;
    bool overwrite = false;
    std::string until;
    int threads = 0;      ///< 0: all
    std::string device = "auto";  ///< auto, cpu, cuda
    bool json = false, quiet = false, report = true;
    int hash_every = 0;   ///< steps between state hashes in the log; 0: none
    std::string command;  ///< the whole command line, for the provenance
};

/// Sets the threads and the device, and reads the case with its preset and settings. Throws ResourceError where there is no such device.
Case open_case(const CaseOptions& o);
/// Throws ResourceError where the estimate is above what the machine, or the device in use, has free.
void require_memory(const Case& c, const Estimate& e);

int check_command(const CaseOptions& o);
int run_command(const CaseOptions& o);
/// Goes on in a run directory from its newest checkpoint (`older`: from the one before).
int resume_command(const std::string& run, bool older, const CaseOptions& o);
int analyze_command(const std::string& run, bool json);
int report_command(const std::vector<std::string>& runs, const std::string& out, bool pdf);
int view_command(const std::string& run);
int materials_command(const std::string& name, bool json, bool full);
/// What `brisance material` is asked for; empty or 0: the default of the path.
struct PointOptions {
    std::string material, path = "uniaxial_strain";
    std::string strain, rate, pressure, velocity;
    std::vector<std::string> confinement;
    double volume = 0, scale = 0, damage = 0;
    int steps = 0;
    std::string csv, plot;
    bool json = false;
};
int material_command(const PointOptions& o);
/// The preset paths and their meanings, for --help.
std::string point_presets();
/// What `brisance bench` is asked for.
struct BenchOptions {
    std::vector<std::string> names;  ///< measurements; empty: all
    int threads = 0;                 ///< at most; 0: all
    int repeat = 3;
    double particles = 0;            ///< of the loops; 0: as in cases/bench
    bool json = false;
    bool inside = false;             ///< this process is one measurement
};
int bench_command(const BenchOptions& o);
int verify_command(const std::vector<std::string>& arguments);
int reference_command();

/// Runs one of the Python scripts with an interpreter that has the modules; returns its exit code.
int run_python(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace brisance
