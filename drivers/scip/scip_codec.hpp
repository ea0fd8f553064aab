// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace stairway::drivers {

/// What can be wrong with bytes that claim to be SCIP 2.0.
enum class ScipError {
  Truncated,     ///< shorter than its kind allows
  BadCharacter,  ///< a character outside the coding, or a number that is none
  BadSum,        ///< the sum at the end of a line does not fit the line
  BadForm,       ///< echo, status or `KEY:value` line not as specified
  WrongCount,    ///< a scan with more or fewer values than were asked for
  MissingField,  ///< a VV, PP or II reply without a line that is needed
  TooLong,       ///< no empty line within the buffer's bound
};
const char* to_string(ScipError error);

/// Measurement data is cut into lines of this many characters, their sum not counted.
inline constexpr std::size_t kDataLineLength = 64;

/// Appends `value` in 6-bit characters 0x30..0x6F, big end first. Bits above 6 * `chars` are lost.
/// @param chars  2 (MS, GS), 3 (ranges, intensities) or 4 (time stamps).
void append_number(std::string& out, std::uint32_t value, int chars);
std::string encode_number(std::uint32_t value, int chars);

/// The inverse, for 1 to 5 characters. Truncated when empty, BadForm when longer.
tl::expected<std::uint32_t, ScipError> decode_number(std::string_view text);

/// The sum character of a line: low six bits of the sum of its bytes, plus 0x30.
char line_sum(std::string_view body);

/// Appends `body`, its sum and LF: status lines, time stamps, single data lines.
void append_line(std::string& out, std::string_view body);

/// Appends `payload` cut into data lines, each with its sum. Adds no empty line.
void append_data_block(std::string& out, std::string_view payload);

/// Appends `KEY:value;` with the sum the UTM-30LX puts there (the `;` is not part of it).
void append_key_value(std::string& out, std::string_view key, std::string_view value);

/// A line (without LF) less its sum. Truncated when shorter than two characters.
tl::expected<std::string_view, ScipError> checked_body(std::string_view line);

struct KeyValue {
  std::string_view key;
  std::string_view value;  ///< may itself hold `:` and `;`
};

/// Reads a VV, PP or II line `KEY:value;S` (without LF); the views point into `line`.
/// Three sums are accepted, because firmware differs: over the text before the last `;`, with that `;`, and over the
/// text before `<-` only (II).
tl::expected<KeyValue, ScipError> parse_key_value(std::string_view line);

/// Takes the first line off `text` and returns it without its LF; the rest without LF is the last line.
std::string_view take_line(std::string_view& text);

}  // namespace stairway::drivers
