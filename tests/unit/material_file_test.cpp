// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "io/case_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

using namespace brisance;
namespace fs = std::filesystem;

namespace {

const fs::path data = fs::path(BRISANCE_SOURCE_DIR) / "tests/unit/data";

std::string content(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

class MaterialFile : public testing::Test {
protected:
    void SetUp() override {
        setenv("BRISANCE_MATERIALS", (data / "materials").c_str(), 1);
        const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::temp_directory_path() / ("brisance_" + test + "_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        unsetenv("BRISANCE_MATERIALS");
        fs::remove_all(folder_);
    }
    fs::path folder_;
};

}  // namespace

TEST_F(MaterialFile, ReadsValuesWithUnitSourceConfidenceAndPlace) {
    const MaterialData rock = read_material("test_rock");
    EXPECT_EQ(rock.name, "test_rock");
    EXPECT_EQ(rock.title, "Rock of the unit tests");
    EXPECT_EQ(rock.notes, std::vector<std::string>{"No real rock."});
    EXPECT_DOUBLE_EQ(rock.density.value, 2.66);
    EXPECT_EQ(rock.density.dimension, dimension::density);
    EXPECT_EQ(rock.eos.law, "polynomial");
    EXPECT_TRUE(rock.eos.where.ends_with("test_rock.toml:9:1")) << rock.eos.where;
    const ParameterValue& K1 = rock.eos.parameters.at("K1");
    EXPECT_DOUBLE_EQ(K1.value, 25.7);
    EXPECT_EQ(K1.dimension, dimension::pressure);
    EXPECT_EQ(K1.text, "25.7 GPa");
    EXPECT_EQ(K1.source, "invented");
    EXPECT_EQ(K1.confidence, "b-M/H");
    EXPECT_TRUE(K1.where.ends_with("test_rock.toml:10:1")) << K1.where;
    ASSERT_TRUE(rock.strength);
    EXPECT_EQ(rock.strength->parameters.at("A").dimension, dimension::none);
    EXPECT_DOUBLE_EQ(rock.strength->parameters.at("A").value, 1.248);
    EXPECT_FALSE(rock.burn);
    const MaterialData explosive = read_material("test_explosive");
    ASSERT_TRUE(explosive.burn);
    EXPECT_DOUBLE_EQ(explosive.burn->parameters.at("D").value, 6.69);
    EXPECT_FALSE(explosive.strength);
}

TEST_F(MaterialFile, ListsTheLibrary) {
    EXPECT_EQ(list_materials(), (std::vector<std::string>{"test_explosive", "test_rock"}));
    try {
        read_material("test_rok");
        FAIL();
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("did you mean 'test_rock'?"), std::string::npos) << message;
        EXPECT_NE(message.find("test_explosive, test_rock"), std::string::npos) << message;
    }
}

TEST_F(MaterialFile, EveryFileOfTheLibraryReads) {
    unsetenv("BRISANCE_MATERIALS");
    const std::vector<std::string> names = list_materials();
    for (const std::string& name : names) EXPECT_NO_THROW(read_material(name)) << name;
    for (const char* name : {"barre_granite", "copper_ofhc", "petn_1320", "polyethylene", "air_paper", "water"})
        EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

TEST_F(MaterialFile, WrongFilesSayWhereAndWhat) {
    // In each row the first text of the good file is replaced by the second; '@' marks the place that the message has to name.
    struct Row {
        const char *from, *to, *fragment;
    };
    const Row rows[] = {
        {"source = \"invented for the unit tests\"", "sorce = \"x\"", "unknown key 'sorce'; did you mean 'source'?"},
        {"title = \"Rock of the unit tests\"", "@title = 3", "title = 3: this has to be a text in quotes"},
        {"title = \"Rock of the unit tests\"", "@title = \" \"", "not empty"},
        {"name = \"test_rock\"", "@name = \"rock\"", "the name has to be that of the file"},
        {"\"2660 kg/m3\"", "2660", "a bare number for a density"},
        {"\"2660 kg/m3\"", "\"2660 GPa\"", "a pressure where a density belongs"},
        {"\"2660 kg/m3\"", "\"-1 kg/m3\"", "has to be > 0"},
        {"\"2660 kg/m3\"", "\"2660 kg/mm4\"", "where a density belongs"},
        {"[eos]", "[@eoss]", "unknown key 'eoss'; did you mean 'eos'?"},
        {"law = \"polynomial\"", "", "eos: the key 'law' is missing"},
        {"law = \"polynomial\"", "@law = 3", "the name of the law"},
        {"K1 = {value = \"25.7 GPa\", ", "@K1 = {", "eos.K1: the key 'value' is missing"},
        {"K1 = {value = \"25.7 GPa\", source = \"invented\", confidence = \"b-M/H\"}", "@K1 = \"25.7 GPa\"", "a parameter in a library file has the form"},
        {"\"25.7 GPa\"", "\"25.7 Gpa\"", "unknown unit 'Gpa'; did you mean 'GPa'?"},
        {"\"25.7 GPa\"", "\"25.7\"", "a number without unit is written without quotes"},
        {"\"25.7 GPa\"", "true", "this has to be a number, or a quantity"},
        {"\"25.7 GPa\"", "nan", "infinite numbers and nan are not allowed"},
        {"source = \"invented\", confidence = \"b-M/H\"", "confidence = \"b-M/H\"", "the key 'source' is missing"},
        {"source = \"invented\", confidence = \"b-M/H\"", "source = \"invented\"", "the key 'confidence' is missing"},
        {"confidence = \"b-M/H\"", "@confidence = \"high\"", "not a confidence; allowed: S | a:KEY | b-H"},
        {"confidence = \"b-M/H\"", "@confidence = \"user\"", "not a confidence"},
        {"confidence = \"b-M/H\"", "@confidence = \"b-H,\"", "not a confidence"},
        {"confidence = \"b-M/H\"", "@confidence = \"b-X\"", "not a confidence"},
        {"source = \"invented\", confidence = \"b-M/H\"", "@surce = \"x\", confidence = \"c\"", "unknown key 'surce'; did you mean 'source'?"},
    };
    const std::string good = content(data / "materials/test_rock.toml");
    const std::string file = (folder_ / "test_rock.toml").string();
    for (const Row& row : rows) {
        std::string text = good;
        const std::size_t at = text.find(row.from);
        ASSERT_NE(at, std::string::npos) << row.from;
        text.replace(at, std::string(row.from).size(), row.to);
        std::string place = file + ":";
        if (const std::size_t mark = text.find('@'); mark != std::string::npos) {
            text.erase(mark, 1);
            place += std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<long>(mark), '\n')) + ":" +
                     std::to_string(mark - text.rfind('\n', mark)) + ": ";
        }
        std::ofstream(file) << text;
        try {
            read_material(file);
            ADD_FAILURE() << "no error for: " << row.to;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find(place), 0u) << place << " <- " << message;
            EXPECT_NE(message.find(row.fragment), std::string::npos) << row.fragment << " <- " << message;
        }
    }
}
