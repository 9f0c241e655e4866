// SPDX-License-Identifier: Apache-2.0
// What the user sees while a run goes: lines, kept in log.txt too, and below them on a terminal one bar that is redrawn in
// place. Without a terminal (a pipe, a batch job, TERM=dumb) progress comes as a plain line now and then.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace brisance {

/// Where the run is. A negative `damaged` or a residual that is not finite is left out.
struct Progress {
    double t_us = 0, until_us = 0, dt_us = 0;
    std::uint64_t steps = 0;
    double wall_seconds = 0;      ///< since the first step; the clock of bar and lines
    double rate = 0;              ///< particle-steps per second
    double energy_residual = 0;   ///< relative
    double damaged = -1;          ///< fraction of the particles that can be damaged
    double from_us = 0;           ///< t at wall_seconds = 0, for the time left
};

/// Seconds left at the mean pace so far; negative while nothing can be said.
double time_left(const Progress& progress);

/// "45 s", "3:12 min", "2:05 h", "3.1 d"
std::string duration(double seconds);

/// "50.0 %  t 15/30 us  left 3:12 min  energy 1.2e-04  damaged 3.1 %  dt 0.0021 us  step 12345  9.3 M/s", without line end.
std::string progress_text(const Progress& progress);

/// The same behind a bar, within `width` characters: what does not fit is left out from the end.
std::string progress_bar(const Progress& progress, int width);

class Log {
public:
    struct Options {
        double redraw_seconds = 0.1;   ///< of the bar
        double line_seconds = 30;      ///< between plain lines of progress, in log.txt and where there is no terminal
        bool quiet = false;            ///< nothing but warnings on the terminal; log.txt is complete
    };

    explicit Log(std::FILE* terminal) : Log(terminal, Options()) {}
    Log(std::FILE* terminal, const Options& options);
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;
    /// Leaves the cursor on a fresh line.
    ~Log();

    /// From here on lines go to this file as well; it begins with the lines so far (`go_on`: after what it holds). Throws ResourceError with path and cause, as
    /// does every later line that cannot be written there. The terminal may go away unnoticed.
    void open(const std::filesystem::path& path, bool go_on = false);

    /// `text` may hold several lines; the bar is cleared before and redrawn after.
    void line(std::string_view text);
    /// A line that begins with "warning: ", in yellow where colours are wanted (a terminal, and NO_COLOR is not set).
    void warning(std::string_view text);

    /// To be called each step: costs a comparison unless something is due.
    void progress(const Progress& progress);
    /// Takes the bar away and writes the last state as a line.
    void end_progress();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void keep(std::string_view text);
    void show(std::string_view text, std::string_view colour);
    void clear_bar();
    void draw_bar();
    int width() const;

    std::FILE* terminal_;
    Options options_;
    bool is_terminal_, colours_;
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
    std::string early_;             ///< lines from before open()
    Progress last_;
    bool in_progress_ = false, drawn_ = false;
    double next_draw_ = 0, next_line_ = 0;
};

}  // namespace brisance
