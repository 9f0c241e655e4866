// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace brisance {

/// 64-bit FNV-1a over words of eight bytes, each call for itself: order and place of every bit count.
class Checksum {
public:
    void add(const void* data, std::size_t bytes) {
        constexpr std::uint64_t prime = 1099511628211ull;
        const auto* p = static_cast<const unsigned char*>(data);
        std::uint64_t word;
        for (; bytes >= sizeof word; p += sizeof word, bytes -= sizeof word) {
            std::memcpy(&word, p, sizeof word);
            hash_ = (hash_ ^ word) * prime;
            hash_ ^= hash_ >> 29;  // a product carries upwards only
        }
        for (; bytes > 0; ++p, --bytes) hash_ = (hash_ ^ *p) * prime;
    }
    void add(const std::string& text) { add(text.data(), text.size()); }
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace brisance
