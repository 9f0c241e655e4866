// SPDX-License-Identifier: Apache-2.0
#include "io/csv.h"

#include "base/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace brisance {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error) {
    throw ResourceError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

}  // namespace

std::string CsvCell::quoted(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

CsvFile::CsvFile(std::filesystem::path path, const std::vector<CsvColumn>& columns, bool go_on)
    : path_(std::move(path)), columns_(columns.size()) {
    fd_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | (go_on ? 0 : O_CREAT | O_TRUNC), 0666);
    if (fd_ < 0) fail(path_, go_on ? "cannot open" : "cannot create", errno);
    if (go_on) return;
    std::vector<CsvCell> head;
    for (const auto& [name, unit] : columns) head.emplace_back(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
    try {
        append(head);
    } catch (...) {
        ::close(fd_);
        throw;
    }
}

CsvFile::CsvFile(CsvFile&& other) noexcept
    : path_(std::move(other.path_)), columns_(other.columns_), fd_(std::exchange(other.fd_, -1)) {}

CsvFile& CsvFile::operator=(CsvFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(columns_, other.columns_);
    std::swap(fd_, other.fd_);
    return *this;
}

CsvFile::~CsvFile() {
    if (fd_ >= 0) ::close(fd_);
}

void CsvFile::row(std::span<const CsvCell> cells) {
    if (cells.size() != columns_)
        throw std::invalid_argument(fmt::format("{}: {} cells for {} columns", path_.string(), cells.size(), columns_));
    append(cells);
}

void CsvFile::append(std::span<const CsvCell> cells) {
    struct stat status{};
    if (::fstat(fd_, &status) == 0 && status.st_nlink == 0) fail(path_, "was removed while it was written", ENOENT);
    std::string line;
    for (const auto& cell : cells) {
        if (&cell != cells.data()) line += ',';
        line += cell.text();
    }
    line += '\n';
    ssize_t written = 0;
    do written = ::write(fd_, line.data(), line.size());
    while (written < 0 && errno == EINTR);
    if (written == static_cast<ssize_t>(line.size())) return;
    const int error = written < 0 ? errno : ENOSPC;  // a short write is a full disk
    if (written > 0) {
        const off_t end = ::lseek(fd_, 0, SEEK_END);
        if (end < 0 || ::ftruncate(fd_, end - written) != 0) fail(path_, "cannot write, and a torn row remains", error);
    }
    fail(path_, "cannot write", error);
}

void CsvFile::sync() const {
    if (::fsync(fd_) != 0 && errno != EINVAL) fail(path_, "cannot write out", errno);
}

std::int64_t CsvFile::length() const {
    const off_t end = ::lseek(fd_, 0, SEEK_END);
    if (end < 0) fail(path_, "cannot tell its length", errno);
    return end;
}

void CsvFile::cut(std::int64_t to) {
    if (length() < to) throw ResourceError(path_.string() + ": is shorter than when the checkpoint was written; rows are missing");
    if (::ftruncate(fd_, to) != 0) fail(path_, "cannot shorten", errno);
}

void CsvFile::close() {
    if (fd_ >= 0 && ::close(std::exchange(fd_, -1)) != 0) fail(path_, "cannot close", errno);
}

}  // namespace brisance
