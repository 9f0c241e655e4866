// SPDX-License-Identifier: Apache-2.0
// The same case gives the same bits: with 1, 2, 3 and 7 threads, loops handed out in any way, twice in a row, and after a checkpoint.
// The hash covers every quantity that a step reads, so that a difference anywhere shows.
#include "app/assembly.h"
#include "app/checkpoint.h"
#include "io/case_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace fs = std::filesystem;
using namespace brisance;

namespace {

class Determinism : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "brisance_bits_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        top = name;
        // charge, sheath, air, copper and a collar of rock with long steps, strong enough a blast to crack it
        c = read_case(std::string(BRISANCE_SOURCE_DIR) + "/cases/blast/air_copper.toml", "quick",
                      {"rock.shape.cylinder.radius=\"13 mm\"", "rock.spacing_far=\"0.7 mm\"", "slice.layers=2", "rock.spacing=\"0.5 mm\"", "run.until=\"0.4 us\"", "gauge=[{name=\"G\",part=\"rock\",at=[\"6 mm\",\"0 mm\",\"100 mm\"]}]",
                       "output.history=\"0.02 us\"", "output.snapshots=\"0.2 us\"", "analysis.zones=[\"0 mm\",\"6 mm\",\"13 mm\"]", "parts=[\"rock\",\"copper\",\"coupling\",\"sheath\",\"charge\"]"});
        threads = exec::threads();
    }
    void TearDown() override {
        exec::set_threads(threads);
        exec::schedule = exec::Schedule::dynamic;
        fs::remove_all(top);
    }
    static std::uint64_t hash_of(World<double>& w) {
        StateHash hash;
        each_field(w, hash);
        return hash.value();
    }
    static std::map<std::string, std::string> files_of(const fs::path& run) {
        std::map<std::string, std::string> all;
        for (const char* name : {"audit.csv", "history.csv", "gauges/G.csv", "snapshots/fields.vtkhdf.series", "snapshots/fields_0001.vtkhdf"}) {
            std::ostringstream text;
            text << std::ifstream(run / name, std::ios::binary).rdbuf();
            all[name] = text.str();
        }
        return all;
    }
    /// From the start (or, with `cut`, in two runs with a checkpoint between) to the end. Returns the hash; `files` gets what it wrote.
    std::uint64_t run(const std::string& name, std::optional<double> cut, std::map<std::string, std::string>& files) {
        const fs::path folder = top / name;
        const auto go = [&](World<double>& w, Recorder<double>& recorder, double until) {
            while (w.time < until - 1e-9) {
                step(w, std::min(c.until, recorder.next_due()));
                recorder.record(w);
            }
        };
        if (cut) {
            const RunDirectory directory(folder, false);
            directory.write_text("case.toml", c.resolved);
            World<double> w = assemble<double>(c, [](const std::string&) {});
            begin(w);
            Recorder<double> recorder(c, w, directory);
            recorder.record(w);
            go(w, recorder, *cut);
            Checkpoints(directory).write(w, recorder, Provenance(), c.until);
            go(w, recorder, std::min(*cut + 0.04, c.until));  // rows that have to go again
        }
        const RunDirectory directory = cut ? RunDirectory::existing(folder) : RunDirectory(folder, false);
        if (!cut) directory.write_text("case.toml", c.resolved);
        World<double> w = assemble<double>(c, [](const std::string&) {});
        begin(w);
        Recorder<double> recorder(c, w, directory, cut.has_value());
        if (cut) {
            Checkpoints checkpoints(directory);
            checkpoints.read(checkpoints.find(false), w, recorder);
            recorder.go_on(w);
        } else {
            recorder.record(w);
        }
        go(w, recorder, c.until);
        files = files_of(folder);
        return hash_of(w);
    }
    fs::path top;
    Case c;
    int threads = 1;
};

}  // namespace

TEST_F(Determinism, SameBitsOverThreadsSchedulesRepetitionAndResume) {
    std::map<std::string, std::string> first_files, files;
    exec::set_threads(2);
    const std::uint64_t first = run("first", {}, first_files);
    EXPECT_GT(first_files["audit.csv"].size(), 1000u);
    EXPECT_GT(first_files["snapshots/fields_0001.vtkhdf"].size(), 10000u);
    int n = 0;
    for (const int t : {1, 2, 3, 7})
        for (const exec::Schedule s : {exec::Schedule::dynamic, exec::Schedule::fixed, exec::Schedule::guided}) {
            exec::set_threads(t);
            exec::schedule = s;
            const bool cut = s == exec::Schedule::guided;
            const std::string what = std::to_string(t) + " threads, schedule " + std::to_string(static_cast<int>(s)) + (cut ? ", resumed" : "");
            EXPECT_EQ(run("grid_" + std::to_string(n++), cut ? std::optional(0.08 + 0.04 * t) : std::nullopt, files), first) << what;
            for (const auto& [name, text] : first_files) EXPECT_TRUE(text == files[name]) << what << ": " << name << " differs";
        }
}

TEST_F(Determinism, TheHashSeesOneBit) {
    World<double> w = assemble<double>(c, [](const std::string&) {});
    begin(w);
    const std::uint64_t before = hash_of(w);
    EXPECT_EQ(hash_of(w), before);
    double& x = w.fluids[0].body.x[0].back();
    x = std::nextafter(x, 1e9);
    EXPECT_NE(hash_of(w), before);
}

TEST_F(Determinism, TornParticlesStayTornAfterAResume) {
    const RunDirectory directory(top / "torn", false);
    directory.write_text("case.toml", c.resolved);
    const auto make = [&] {
        World<double> w = assemble<double>(c, [](const std::string&) {});
        begin(w);
        return w;
    };
    World<double> w = make();
    Recorder<double> recorder(c, w, directory);
    Column& column = w.solids[0].body.layout.columns[w.solids[0].body.layout.columns.size() / 2];
    w.solids[0].body.u[0][static_cast<std::size_t>(column.start)] += 2 * column.spacing;  // a blow that no bond bears
    for (int k = 0; k < 5; ++k) step(w, c.until);
    ASSERT_GT(w.torn, 0);
    Checkpoints(directory).write(w, recorder, Provenance(), c.until);
    World<double> again = make();
    Recorder<double> second(c, again, directory, true);
    Checkpoints checkpoints(directory);
    checkpoints.read(checkpoints.find(false), again, second);
    for (int k = 0; k < 5; ++k) {
        step(w, c.until);
        step(again, c.until);
    }
    EXPECT_EQ(hash_of(again), hash_of(w));
}
