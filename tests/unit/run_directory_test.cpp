// SPDX-License-Identifier: Apache-2.0
#include "io/run_directory.h"

#include "base/error.h"
#include "base/version.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace fs = std::filesystem;
using namespace brisance;

namespace {

class RunFolder : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "brisance_run_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        top = name;
        run = top / "runs" / "blast-quick";
    }
    void TearDown() override { fs::remove_all(top); }
    fs::path top, run;
};

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::string refusal(const fs::path& path, bool overwrite) {
    try {
        RunDirectory run(path, overwrite);
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

}  // namespace

TEST_F(RunFolder, has_a_name_from_case_and_preset) {
    EXPECT_EQ(RunDirectory::default_path("cases/blast/sim1.toml", "quick"), "runs/sim1-quick");
    EXPECT_EQ(RunDirectory::default_path("cases/blast/sim1.toml", ""), "runs/sim1");
    EXPECT_EQ(RunDirectory::default_path("cases/verification/rod/case.toml", "fine"), "runs/rod-fine");
}

TEST_F(RunFolder, is_made_with_its_folders) {
    {
        const RunDirectory directory(run, false);
        for (const auto& folder : {directory.snapshots(), directory.gauges(), directory.analysis()}) EXPECT_TRUE(fs::is_directory(folder));
    }
    RunDirectory(run, false);  // empty folders are no reason to refuse
}

TEST_F(RunFolder, with_files_is_refused_unless_overwriting_is_asked) {
    {
        const RunDirectory first(run, false);
        first.write_text("provenance.json", "{}");
        first.write_text("snapshots/fields_0000.vtkhdf", "old");
        first.write_text("notes.md", "mine");
    }
    EXPECT_NE(refusal(run, false).find("blast-quick: the folder holds files"), std::string::npos);
    EXPECT_TRUE(fs::exists(run / "provenance.json"));

    const RunDirectory second(run, true);
    EXPECT_FALSE(fs::exists(run / "provenance.json"));
    EXPECT_TRUE(fs::is_empty(second.snapshots()));
    EXPECT_EQ(text_of(run / "notes.md"), "mine");
}

TEST_F(RunFolder, that_is_not_a_run_is_never_cleared) {
    fs::create_directories(run / "figures");
    std::ofstream(run / "case.toml") << "mine";
    std::ofstream(run / "figures" / "a.png") << "mine";
    EXPECT_NE(refusal(run, true).find("not the folder of a run"), std::string::npos);
    EXPECT_EQ(text_of(run / "case.toml"), "mine");
    EXPECT_EQ(text_of(run / "figures" / "a.png"), "mine");
}

TEST_F(RunFolder, cannot_be_a_file) {
    std::ofstream(top / "file") << "x";
    EXPECT_NE(refusal(top / "file", true).find("is a file"), std::string::npos);
    EXPECT_THROW(RunDirectory(top / "file" / "below", false), ResourceError);
}

TEST_F(RunFolder, belongs_to_one_at_a_time) {
    std::optional<RunDirectory> first(std::in_place, run, false);
    first->write_text("case.toml", "");
    first->write_text("log.txt", "");
    const auto wanted = [&](auto&& take) {
        try {
            take();
        } catch (const ResourceError& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    EXPECT_NE(wanted([&] { RunDirectory::existing(run); }).find("blast-quick: another brisance runs in this folder"), std::string::npos);
    EXPECT_NE(wanted([&] { RunDirectory(run, true); }).find("another brisance runs"), std::string::npos);
    EXPECT_TRUE(fs::exists(run / "log.txt"));
    RunDirectory copy = *first;  // shares what the first holds
    first.reset();
    EXPECT_NE(wanted([&] { RunDirectory::existing(run); }), "taken");
    copy = RunDirectory(top / "other", false);
    EXPECT_EQ(wanted([&] { RunDirectory::existing(run); }), "taken");
}

TEST_F(RunFolder, texts_replace_the_old_ones_whole) {
    const RunDirectory directory(run, false);
    directory.write_text("a.txt", "first");
    directory.write_text("a.txt", "second");
    EXPECT_EQ(text_of(run / "a.txt"), "second");
    EXPECT_FALSE(fs::exists(run / "a.txt.part"));
    EXPECT_THROW(directory.write_text("none/a.txt", "x"), ResourceError);
    fs::create_directory(run / "taken");
    EXPECT_THROW(directory.write_text("taken", "x"), ResourceError);
    EXPECT_FALSE(fs::exists(run / "taken.part"));
}

TEST_F(RunFolder, provenance_is_json_that_python_reads) {
    const RunDirectory directory(run, false);
    Provenance p;
    p.command = "brisance run \"a b.toml\" --set rock.spacing='0.4 mm'";
    p.started = utc_now();
    p.machine = this_machine(2);
    p.title = "line\nbreak \\ \x01";
    p.settings = {"a=1", "b=\"2\""};
    p.steps = 12;
    p.particles = {{"rock", 5460000}};
    p.rates = {{"particle_steps", 9.3e6}, {"nothing", std::numeric_limits<double>::quiet_NaN()}};
    p.slice = Provenance::Slice{40, 8, 1.2};
    p.resumed = {{"2026-01-02T03:04:05Z", "brisance resume \"a b\"", 0.125}};
    directory.write_provenance(p);
    std::ofstream(top / "check.py") << R"(
import json, sys
p = json.load(open(sys.argv[1]))
assert p["schema"] == 1 and p["status"] == "running" and p["finished"] is None and p["steps"] == 12
assert p["command"] == "brisance run \"a b.toml\" --set rock.spacing='0.4 mm'"
assert p["title"] == "line\nbreak \\ \x01" and p["settings"] == ["a=1", 'b="2"']
assert p["particles"] == {"rock": 5460000} and p["rates"] == {"particle_steps": 9.3e6, "nothing": None}
assert p["slice"] == {"z_mm": 40, "layers": 8, "thickness_mm": 1.2}
assert p["resumed"] == [{"at": "2026-01-02T03:04:05Z", "command": 'brisance resume "a b"', "from_us": 0.125}]
assert p["machine"]["threads"] == 2 and p["machine"]["cpu"] and p["machine"]["host"]
keys = "schema version commit build command started finished machine title case_file preset settings status".split()
assert list(p) == keys + "wall_seconds steps particles rates slice resumed".split(), list(p)
)";
    EXPECT_EQ(std::system(("/usr/bin/python3 " + (top / "check.py").string() + " " + (run / "provenance.json").string()).c_str()), 0);
    p.slice.reset();
    EXPECT_NE(to_json(p).find("\"slice\": null"), std::string::npos);
}

TEST(Provenance, knows_the_build_and_the_hour) {
    const Provenance p;
    EXPECT_EQ(p.version, version());
    EXPECT_FALSE(p.commit.empty());
    const std::string features = build_features();
    for (const char* part : {"++ ", "OpenMP", ", HDF5 1.", "CUDA"}) EXPECT_NE(features.find(part), features.npos) << features;
    const std::string now = utc_now();  // 2024-05-17T09:30:00Z
    ASSERT_EQ(now.size(), 20u) << now;
    EXPECT_EQ(std::string({now[4], now[7], now[10], now[13], now[16], now[19]}), "--T::Z") << now;
}
