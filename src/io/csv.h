// SPDX-License-Identifier: Apache-2.0
// Tables that grow a row at a time. Each row reaches the system in one write, so a killed run leaves whole rows.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

/// The head is "name [unit]", or the name alone where the unit is empty: texts and counts. Dimensionless quantities have "-".
struct CsvColumn {
    std::string name, unit;
};

/// A number in the shortest digits that read back to the same bits, or a text, quoted where it must be.
class CsvCell {
public:
    template <class T>
        requires(std::integral<T> || std::floating_point<T>)
    CsvCell(T value) : text_(fmt::format("{}", value)) {}
    CsvCell(std::string_view text) : text_(quoted(text)) {}
    CsvCell(const std::string& text) : CsvCell(std::string_view(text)) {}
    CsvCell(const char* text) : CsvCell(std::string_view(text)) {}
    const std::string& text() const { return text_; }

private:
    static std::string quoted(std::string_view text);
    std::string text_;
};

class CsvFile {
public:
    /// Creates or truncates, and writes the head; `go_on` keeps what an earlier run wrote and appends. Throws ResourceError with path and
    /// cause, as do the others.
    CsvFile(std::filesystem::path path, const std::vector<CsvColumn>& columns, bool go_on = false);
    CsvFile(CsvFile&& other) noexcept;
    CsvFile& operator=(CsvFile&& other) noexcept;
    ~CsvFile();

    /// Appends a row; as many cells as columns (else std::invalid_argument). Where the disk is full the part of the row that did
    /// reach the file is taken back. A file that was removed meanwhile is an error too: the rows would go nowhere.
    void row(std::initializer_list<CsvCell> cells) { row(std::span(cells.begin(), cells.size())); }
    void row(std::span<const CsvCell> cells);
    /// A row of numbers only.
    void row(std::span<const double> values) { row(std::vector<CsvCell>(values.begin(), values.end())); }

    /// What was written is on the disk when this returns.
    void sync() const;
    /// Length of the file, bytes; and back to an earlier one: rows written since are taken out.
    std::int64_t length() const;
    void cut(std::int64_t length);

    /// Closes and reports what the system has to say; the destructor keeps silent.
    void close();

    const std::filesystem::path& path() const { return path_; }

private:
    void append(std::span<const CsvCell> cells);

    std::filesystem::path path_;
    std::size_t columns_ = 0;
    int fd_ = -1;
};

}  // namespace brisance
