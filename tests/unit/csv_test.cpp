// SPDX-License-Identifier: Apache-2.0
#include "io/csv.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace fs = std::filesystem;
using namespace brisance;

namespace {

class Csv : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "brisance_csv_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
        path = folder / "audit.csv";
    }
    void TearDown() override { fs::remove_all(folder); }
    std::string text() const {
        std::ostringstream out;
        out << std::ifstream(path).rdbuf();
        return out.str();
    }
    fs::path folder, path;
};

int exit_code(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_F(Csv, names_units_and_keeps_texts_apart) {
    CsvFile file(path, {{"t", "us"}, {"dt", "us"}, {"damage", "-"}, {"step", ""}, {"limiter", ""}});
    file.row({0.1, 1e-9, 0.5f, 12, "rock, \"sound\""});
    file.row({0.2f, -0.0, std::numeric_limits<double>::infinity(), std::size_t{1} << 60, std::string("contact")});
    EXPECT_EQ(text(), "t [us],dt [us],damage [-],step,limiter\n"
                      "0.1,1e-09,0.5,12,\"rock, \"\"sound\"\"\"\n"
                      "0.2,-0,inf,1152921504606846976,contact\n");  // before close: every row is out
    file.close();
}

TEST_F(Csv, numbers_read_back_to_the_same_bits) {
    const double values[] = {std::numbers::pi, 1.0 / 3, 0.1 + 0.2, 5e-324, 1.7976931348623157e308, -2.5};
    CsvFile file(path, {{"a", "-"}, {"b", "-"}, {"c", "-"}, {"d", "-"}, {"e", "-"}, {"f", "-"}});
    file.row(values);
    file.close();
    std::istringstream lines(text());
    std::string cell;
    std::getline(lines, cell);
    for (const double value : values) {
        std::getline(lines, cell, &value == &values[5] ? '\n' : ',');
        double read = 0;
        std::from_chars(cell.data(), cell.data() + cell.size(), read);
        EXPECT_EQ(read, value) << cell;
    }
}

TEST_F(Csv, refuses_a_row_of_another_length) {
    CsvFile file(path, {{"t", "us"}, {"dt", "us"}});
    EXPECT_THROW(file.row({1.0}), std::invalid_argument);
    EXPECT_EQ(text(), "t [us],dt [us]\n");
}

TEST_F(Csv, killed_leaves_whole_rows) {
    const pid_t child = ::fork();
    if (child == 0) {
        CsvFile file(path, {{"t", "us"}, {"dt", "us"}});
        for (int i = 0; i < 100; ++i) file.row({0.1 * i, 0.1});
        ::raise(SIGKILL);
    }
    EXPECT_EQ(exit_code(child), -1);
    const std::string table = text();
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 101);
    EXPECT_TRUE(table.ends_with(",0.1\n"));
}

TEST_F(Csv, on_a_full_disk_throws_and_leaves_whole_rows) {
    const pid_t child = ::fork();
    if (child == 0) {  // a limit on the size of files stands for the full disk; it lies within a row
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1003, 1003};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            CsvFile file(path, {{"t", "us"}});
            for (int i = 0; i < 1000; ++i) file.row({"123456789"});
        } catch (const ResourceError& error) {
            ::_exit(std::string(error.what()).find("audit.csv: cannot write") != std::string::npos ? 0 : 2);
        }
        ::_exit(1);
    }
    EXPECT_EQ(exit_code(child), 0);
    EXPECT_TRUE(text().ends_with("\n123456789\n"));
    EXPECT_EQ(text().size(), 7u + 99 * 10);
}

TEST_F(Csv, names_the_path_that_cannot_be_written) {
    EXPECT_THROW(CsvFile("/dev/full", {{"t", "us"}}), ResourceError);
    try {
        CsvFile file(folder / "none" / "a.csv", {{"t", "us"}});
        FAIL();
    } catch (const ResourceError& error) {
        EXPECT_EQ(std::string(error.what()), (folder / "none" / "a.csv").string() + ": cannot create: No such file or directory");
    }
}

TEST_F(Csv, can_be_moved) {
    std::vector<CsvFile> files;
    files.emplace_back(path, std::vector<CsvColumn>{{"t", "us"}});
    files.emplace_back(folder / "other.csv", std::vector<CsvColumn>{{"t", "us"}});
    files[0].row({1.0});
    files[0].close();
    files[0].close();
    EXPECT_EQ(text(), "t [us]\n1\n");
}
