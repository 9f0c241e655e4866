// SPDX-License-Identifier: Apache-2.0
// Every mistake of tests/wrong_cases/wrong.toml ends with exit code 2 before the first step, and the message says where it is.
#include "app/assembly.h"
#include "app/commands.h"
#include "base/error.h"

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace brisance;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(BRISANCE_SOURCE_DIR) / "tests/wrong_cases";

std::string content(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// What `brisance run` does with a case before its first step. Returns what it had to say against it; empty: nothing.
std::string objection(const std::string& file, const std::string& preset, const std::vector<std::string>& settings) {
    try {
        CaseOptions o;
        o.file = file;
        o.preset = preset;
        o.settings = settings;
        const Case c = open_case(o);
        require_memory(c, estimate(c));
        auto w = assemble<double>(c, [](const std::string&) {});
        begin(w);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

/// The number of the first line of `text` that reads `line`, from 1; 0: none.
int number_of(const std::string& text, const std::string& line) {
    std::istringstream in(text);
    int n = 0;
    for (std::string l; std::getline(in, l);)
        if (++n, l == line) return n;
    return 0;
}

class WrongCases : public testing::TestWithParam<const char*> {};

TEST_P(WrongCases, AreRefusedWithThePlaceAndWhatIsAllowed) {
    const std::string name = GetParam(), good = content(folder / (name + ".toml"));
    const fs::path copy = fs::temp_directory_path() / ("brisance_wrong_" + std::to_string(getpid()));
    fs::create_directories(copy);
    fs::copy_file(folder / "base.toml", copy / "base.toml", fs::copy_options::overwrite_existing);
    const std::string file = (copy / (name + "_changed.toml")).string();
    std::ofstream(file) << good;
    EXPECT_EQ(objection(file, "", {}), "") << "the case without a mistake";

    const toml::table all = toml::parse_file((folder / "wrong.toml").string());
    for (const toml::node& node : *all[name].as_array()) {
        const toml::table& row = *node.as_table();
        const auto text = [&](const char* key) { return row[key].value_or(std::string()); };
        const std::string line = text("line"), with = text("with"), at = text("at"), set = text("set");
        SCOPED_TRACE(line + " -> " + with + set + text("preset"));
        std::string changed = good;
        if (!line.empty()) {
            const std::size_t place = ("\n" + changed).find("\n" + line + "\n");
            ASSERT_NE(place, std::string::npos) << "no such line";
            changed.replace(place, line.size(), with);
        }
        std::ofstream(file) << changed;
        const std::string message = objection(file, text("preset"), set.empty() ? std::vector<std::string>{} : std::vector<std::string>{set});
        EXPECT_NE(message, "") << "accepted";
        if (message.empty()) continue;
        if (!line.empty()) {
            const int n = number_of(good, at.empty() ? line : at);
            ASSERT_GT(n, 0) << at;
            EXPECT_EQ(message.find(file + ":" + std::to_string(n) + ":"), 0u) << "wanted: line " << n << "; got: " << message;
        }
        for (const toml::node& word : *row["says"].as_array())
            EXPECT_NE(message.find(*word.value<std::string>()), std::string::npos) << "no \"" << *word.value<std::string>() << "\" in: " << message;
    }
    fs::remove_all(copy);
}

INSTANTIATE_TEST_SUITE_P(All, WrongCases, testing::Values("rock", "charge"));

TEST(WrongCases, AreMany) {
    const toml::table all = toml::parse_file((folder / "wrong.toml").string());
    EXPECT_GE(all["rock"].as_array()->size() + all["charge"].as_array()->size(), 200u);
}

}  // namespace
