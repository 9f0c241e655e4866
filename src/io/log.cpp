// SPDX-License-Identifier: Apache-2.0
#include "io/log.h"

#include "base/error.h"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace brisance {

namespace {

constexpr std::string_view clear_line = "\r\033[K", cyan = "\033[36m", yellow = "\033[33m", plain = "\033[0m";

double fraction(const Progress& p) {
    const double whole = p.until_us - p.from_us;
    return whole > 0 ? std::clamp((p.t_us - p.from_us) / whole, 0.0, 1.0) : 1.0;
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// 9300000 -> "9.3 M"
std::string scaled(double value) {
    if (value >= 1e9) return fmt::format("{:.1f} G", value * 1e-9);
    if (value >= 1e6) return fmt::format("{:.1f} M", value * 1e-6);
    if (value >= 1e3) return fmt::format("{:.1f} k", value * 1e-3);
    return fmt::format("{:.1f} ", value);
}

}  // namespace

double time_left(const Progress& p) {
    const double done = fraction(p);
    return done > 0 && p.wall_seconds > 0 ? p.wall_seconds * (1 - done) / done : -1;
}

std::string duration(double seconds) {
    const auto s = static_cast<std::int64_t>(std::lround(std::clamp(seconds, 0.0, 1e15)));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
    if (s < 2 * 86400) return fmt::format("{}:{:02} h", s / 3600, s % 3600 / 60);
    return fmt::format("{:.1f} d", static_cast<double>(s) / 86400);
}

std::string progress_text(const Progress& p) {
    std::string text = fmt::format("{:.1f} %  t {:.4g}/{:.4g} us", 100 * fraction(p), p.t_us, p.until_us);
    if (const double left = time_left(p); left >= 0) text += "  left " + duration(left);
    if (std::isfinite(p.energy_residual)) text += fmt::format("  energy {:.1e}", p.energy_residual);
    if (p.damaged >= 0) text += fmt::format("  damaged {:.1f} %", 100 * p.damaged);
    text += fmt::format("  dt {:.3g} us  step {}", p.dt_us, p.steps);
    if (p.rate > 0) text += fmt::format("  {}/s", scaled(p.rate));
    return text;
}

std::string progress_bar(const Progress& p, int width) {
    if (width <= 0) return {};
    constexpr int narrow = 60, frame = 4;  // below `narrow` columns there is text only
    std::string text = progress_text(p), bar;
    if (width >= narrow) {
        const int room = std::clamp(width - static_cast<int>(text.size()) - frame, 10, 40);
        const auto full = static_cast<std::size_t>(std::lround(fraction(p) * room));
        bar = fmt::format("[{:-<{}}]  ", std::string(full, '#'), room);
    }
    const auto space = static_cast<std::size_t>(width) - bar.size();
    if (text.size() > space) text.resize(std::min(text.rfind("  ", space), space));  // whole entries only, where one fits
    return bar + text;
}

Log::Log(std::FILE* terminal, const Options& options)
    : terminal_(terminal), options_(options), is_terminal_(::isatty(::fileno(terminal)) == 1 && environment("TERM") != "dumb"),
      colours_(is_terminal_ && environment("NO_COLOR").empty()) {}

Log::~Log() { clear_bar(); }

void Log::open(const std::filesystem::path& path, bool go_on) {
    path_ = path;
    file_.reset(std::fopen(path.c_str(), go_on ? "ae" : "we"));
    if (!file_) throw ResourceError(fmt::format("{}: cannot create: {}", path.string(), std::strerror(errno)));
    keep(std::exchange(early_, {}));
}

void Log::line(std::string_view text) {
    if (!options_.quiet) show(text, {});
    keep(fmt::format("{}\n", text));
}

void Log::warning(std::string_view text) {
    const std::string whole = fmt::format("warning: {}", text);
    show(whole, yellow);
    keep(whole + '\n');
}

void Log::progress(const Progress& progress) {
    if (!in_progress_) {
        next_draw_ = progress.wall_seconds;
        next_line_ = progress.wall_seconds + options_.line_seconds;
        in_progress_ = true;
    }
    last_ = progress;
    if (progress.wall_seconds >= next_line_) {
        next_line_ = progress.wall_seconds + options_.line_seconds;
        const std::string text = progress_text(progress);
        if (!is_terminal_ && !options_.quiet) show(text, {});
        keep(text + '\n');
    }
    if (is_terminal_ && !options_.quiet && progress.wall_seconds >= next_draw_) draw_bar();
}

void Log::end_progress() {
    if (!in_progress_) return;
    in_progress_ = false;
    clear_bar();
    line(progress_text(last_));
}

void Log::keep(std::string_view text) {
    if (!file_) {
        early_ += text;
        return;
    }
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0)
        throw ResourceError(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
}

void Log::show(std::string_view text, std::string_view colour) {
    clear_bar();
    const bool coloured = colours_ && !colour.empty();
    const std::string whole = coloured ? fmt::format("{}{}{}\n", colour, text, plain) : fmt::format("{}\n", text);
    std::fwrite(whole.data(), 1, whole.size(), terminal_);
    std::fflush(terminal_);
    if (in_progress_ && is_terminal_ && !options_.quiet) draw_bar();
}

void Log::clear_bar() {
    if (!std::exchange(drawn_, false)) return;
    std::fwrite(clear_line.data(), 1, clear_line.size(), terminal_);
    std::fflush(terminal_);
}

void Log::draw_bar() {
    next_draw_ = last_.wall_seconds + options_.redraw_seconds;
    const std::string bar = progress_bar(last_, width() - 1);  // the last column would wrap on some terminals
    const std::string whole = colours_ ? fmt::format("{}{}{}{}", clear_line, cyan, bar, plain) : fmt::format("{}{}", clear_line, bar);
    std::fwrite(whole.data(), 1, whole.size(), terminal_);
    std::fflush(terminal_);
    drawn_ = true;
}

int Log::width() const {
    winsize size{};
    return ::ioctl(::fileno(terminal_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace brisance
