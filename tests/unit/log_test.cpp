// SPDX-License-Identifier: Apache-2.0
#include "io/log.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <pty.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace brisance;

namespace {

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

class LogFile : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "brisance_log_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

/// A terminal of 120 columns whose screen bytes can be read back.
class Terminal {
public:
    explicit Terminal(const char* no_color) {
        ::setenv("TERM", "xterm", 1);
        no_color == nullptr ? ::unsetenv("NO_COLOR") : ::setenv("NO_COLOR", no_color, 1);
        const winsize size{24, 120, 0, 0};
        int inner = -1;
        if (::openpty(&outer_, &inner, nullptr, nullptr, &size) != 0) throw std::runtime_error("no terminal");
        file = ::fdopen(inner, "w");
    }
    ~Terminal() {
        std::fclose(file);
        ::close(outer_);
    }
    std::string seen() {
        std::string text(65536, '\0');
        const auto count = ::read(outer_, text.data(), text.size());
        text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
        return text;
    }
    std::FILE* file = nullptr;

private:
    int outer_ = -1;
};

Progress halfway() {
    Progress p;
    p.t_us = 15;
    p.until_us = 30;
    p.dt_us = 0.0021;
    p.steps = 12345;
    p.wall_seconds = 192;
    p.rate = 9.3e6;
    p.energy_residual = 1.2e-4;
    p.damaged = 0.031;
    return p;
}

const std::string halfway_text = "50.0 %  t 15/30 us  left 3:12 min  energy 1.2e-04  damaged 3.1 %  dt 0.0021 us  step 12345  9.3 M/s";

}  // namespace

TEST(ProgressText, names_everything_that_is_known) {
    EXPECT_EQ(progress_text(halfway()), halfway_text);
    Progress start;
    start.until_us = 30;
    start.energy_residual = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(progress_text(start), "0.0 %  t 0/30 us  dt 0 us  step 0");
}

TEST(ProgressText, time_left_counts_from_where_the_clock_began) {
    Progress p = halfway();
    p.from_us = 10;  // 5 us in 192 s, 15 us to go
    EXPECT_DOUBLE_EQ(time_left(p), 576);
    p.t_us = 10;
    EXPECT_LT(time_left(p), 0);
}

TEST(ProgressText, durations_are_short) {
    EXPECT_EQ(duration(0.4), "0 s");
    EXPECT_EQ(duration(59.6), "1:00 min");
    EXPECT_EQ(duration(7500), "2:05 h");
    EXPECT_EQ(duration(3.1 * 86400), "3.1 d");
}

TEST(ProgressBar, fits_the_terminal) {
    EXPECT_EQ(progress_bar(halfway(), 119), "[########--------]  " + halfway_text);
    EXPECT_EQ(progress_bar(halfway(), 79), "[#####-----]  50.0 %  t 15/30 us  left 3:12 min  energy 1.2e-04  damaged 3.1 %");
    EXPECT_EQ(progress_bar(halfway(), 59), "50.0 %  t 15/30 us  left 3:12 min  energy 1.2e-04");
    EXPECT_EQ(progress_bar(halfway(), 20), "50.0 %  t 15/30 us");
    EXPECT_EQ(progress_bar(halfway(), 4), "50.0");
    EXPECT_EQ(progress_bar(halfway(), -1), "");
}

TEST_F(LogFile, without_a_terminal_has_plain_lines_now_and_then) {
    std::FILE* pipe = std::fopen((folder / "out.txt").c_str(), "w");
    {
        Log log(pipe);
        log.line("before");
        log.open(folder / "log.txt");
        Progress p = halfway();
        for (double wall = 0; wall <= 70; wall += 0.5) {
            p.wall_seconds = wall;
            log.progress(p);
        }
        log.warning("coarse");
        log.end_progress();
        log.end_progress();
    }
    std::fclose(pipe);
    const std::string text = text_of(folder / "out.txt");
    EXPECT_EQ(text, text_of(folder / "log.txt"));
    EXPECT_EQ(text.find('\033'), text.npos);
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 5u) << text;
    EXPECT_EQ(lines[0], "before");
    EXPECT_NE(lines[1].find("left 30 s"), text.npos);
    EXPECT_NE(lines[2].find("left 1:00 min"), text.npos);
    EXPECT_EQ(lines[3], "warning: coarse");
    EXPECT_NE(lines[4].find("left 1:10 min"), text.npos);
}

TEST_F(LogFile, on_a_terminal_redraws_the_bar_around_lines) {
    Terminal terminal("1");
    Log log(terminal.file);
    log.open(folder / "log.txt");
    log.progress(halfway());
    const std::string bar = "\r\033[K[########--------]  " + halfway_text;
    EXPECT_EQ(terminal.seen(), bar);
    log.line("snapshot 3");
    EXPECT_EQ(terminal.seen(), "\r\033[Ksnapshot 3\r\n" + bar);
    Progress soon = halfway();
    soon.wall_seconds += 0.01;
    log.progress(soon);  // too soon to be drawn
    log.end_progress();
    EXPECT_EQ(terminal.seen(), "\r\033[K" + halfway_text + "\r\n");
    EXPECT_EQ(text_of(folder / "log.txt"), "snapshot 3\n" + halfway_text + "\n");
}

TEST_F(LogFile, colours_only_where_they_are_wanted) {
    {
        Terminal terminal(nullptr);
        Log log(terminal.file);
        log.open(folder / "log.txt");
        log.warning("coarse");
        EXPECT_EQ(terminal.seen(), "\033[33mwarning: coarse\033[0m\r\n");
        EXPECT_EQ(text_of(folder / "log.txt"), "warning: coarse\n");
    }
    Terminal terminal("1");
    Log log(terminal.file);
    log.warning("coarse");
    EXPECT_EQ(terminal.seen(), "warning: coarse\r\n");
}

TEST_F(LogFile, quiet_keeps_the_file_complete) {
    Terminal terminal("1");
    Log::Options options;
    options.quiet = true;
    Log log(terminal.file, options);
    log.open(folder / "log.txt");
    log.line("a");
    log.progress(halfway());
    log.warning("b");
    EXPECT_EQ(terminal.seen(), "warning: b\r\n");
    EXPECT_EQ(text_of(folder / "log.txt"), "a\nwarning: b\n");
}

TEST_F(LogFile, on_a_full_disk_throws) {
    std::FILE* sink = std::fopen("/dev/null", "w");
    Log log(sink);
    EXPECT_THROW(log.open(folder / "none" / "log.txt"), ResourceError);
    log.open("/dev/full");
    EXPECT_THROW(log.line("text"), ResourceError);
    std::fclose(sink);
}
