// SPDX-License-Identifier: Apache-2.0
// The inputs that the fuzzers kept (tests/fuzz/corpus): what once crashed, and what reaches far into the readers.
#include "fuzz/targets.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;

namespace {

void replay(const char* name, int (*target)(const std::uint8_t*, std::size_t), int at_least) {
    int count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(BRISANCE_SOURCE_DIR) / "tests/fuzz/corpus" / name)) {
        SCOPED_TRACE(entry.path().filename().string());
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(in), {});
        EXPECT_EQ(target(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
        ++count;
    }
    EXPECT_GE(count, at_least);
}

}  // namespace

TEST(FuzzCorpus, Units) { replay("units", brisance::fuzz::units, 10); }
TEST(FuzzCorpus, Materials) { replay("material", brisance::fuzz::material, 10); }
TEST(FuzzCorpus, Cases) { replay("case_file", brisance::fuzz::case_file, 10); }
TEST(FuzzCorpus, Checkpoints) { replay("checkpoint", brisance::fuzz::checkpoint, 10); }
TEST(FuzzCorpus, Snapshots) { replay("snapshot", brisance::fuzz::snapshot, 10); }
