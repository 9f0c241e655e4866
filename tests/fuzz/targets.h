// SPDX-License-Identifier: Apache-2.0
// What libFuzzer feeds (tests/fuzz/libfuzzer.cpp) and the kept corpus replays (tests/unit/fuzz_corpus_test.cpp): any bytes at all may
// only be read, or refused with an Error that says what is wrong. Anything else ends the process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace brisance::fuzz {

int units(const std::uint8_t* data, std::size_t size);
int material(const std::uint8_t* data, std::size_t size);
int case_file(const std::uint8_t* data, std::size_t size);
int checkpoint(const std::uint8_t* data, std::size_t size);
int snapshot(const std::uint8_t* data, std::size_t size);

}  // namespace brisance::fuzz
