// SPDX-License-Identifier: Apache-2.0
// A minimal JSON writer. Numbers keep all their digits; NaN and infinity become null.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brisance::analysis {

class JsonWriter {
public:
    JsonWriter& begin_object() { return open('{'); }
    JsonWriter& end_object() { return close('}'); }
    JsonWriter& begin_array() { return open('['); }
    JsonWriter& end_array() { return close(']'); }

    JsonWriter& key(std::string_view name) {
        separate();
        quote(name);
        text_ += ':';
        after_key_ = true;
        return *this;
    }

    JsonWriter& value(double number) {
        separate();
        text_ += std::isfinite(number) ? fmt::format("{}", number) : "null";
        return *this;
    }
    JsonWriter& value(int number) { return integer(number); }
    JsonWriter& value(std::size_t number) { return integer(number); }
    JsonWriter& value(std::string_view string) {
        separate();
        quote(string);
        return *this;
    }
    JsonWriter& value(const char* string) { return value(std::string_view(string)); }
    template <class T>
    JsonWriter& value(const std::vector<T>& array) {
        begin_array();
        for (const T& element : array) value(element);
        return end_array();
    }

    /// key and value in one.
    template <class T>
    JsonWriter& member(std::string_view name, const T& content) {
        return key(name).value(content);
    }

    const std::string& text() const { return text_; }

private:
    JsonWriter& open(char bracket) {
        separate();
        text_ += bracket;
        first_ = true;
        return *this;
    }
    JsonWriter& close(char bracket) {
        text_ += bracket;
        first_ = false;
        return *this;
    }
    template <class T>
    JsonWriter& integer(T number) {
        separate();
        text_ += fmt::format("{}", number);
        return *this;
    }
    void separate() {
        if (!first_ && !after_key_) text_ += ',';
        first_ = after_key_ = false;
    }
    void quote(std::string_view string) {
        text_ += '"';
        for (char c : string) {
            if (c == '"' || c == '\\') text_ += '\\';
            if (static_cast<unsigned char>(c) < 0x20) text_ += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
            else text_ += c;
        }
        text_ += '"';
    }

    std::string text_;
    bool first_ = true, after_key_ = false;
};

}  // namespace brisance::analysis
