// SPDX-License-Identifier: Apache-2.0
// Words for messages: the nearest spelling of a mistyped name, quoting, joining.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace brisance {

/// Insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to `word`, capitals ignored; empty when none is close enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean 'spacing'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"; "(none)" for an empty list.
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

/// In double quotes, with the escapes of TOML.
std::string in_quotes(std::string_view text);

/// Line breaks and tabs as spaces, for comments.
std::string one_line(std::string_view text);

std::string lower_case(std::string_view text);
std::string trimmed(std::string_view text);

/// The shortest decimal that reads back as the same double: "0.15", "1e-05".
std::string shortest(double value);

/// printf into a string, for files that nvcc compiles too: fmt's headers do not go through it.
[[gnu::format(printf, 1, 2)]] std::string printed(const char* format, ...);

}  // namespace brisance
