// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_codec.hpp"

#include <algorithm>

namespace stairway::drivers {
namespace {

constexpr char kFirstCode = 0x30;
constexpr std::size_t kMaxNumberLength = 5;

bool is_printable(char c) { return c >= 0x20 && c <= 0x7E; }

}  // namespace

const char* to_string(ScipError error) {
  switch (error) {
    case ScipError::Truncated:
      return "truncated";
    case ScipError::BadCharacter:
      return "bad character";
    case ScipError::BadSum:
      return "bad sum";
    case ScipError::BadForm:
      return "bad form";
    case ScipError::WrongCount:
      return "wrong number of values";
    case ScipError::MissingField:
      return "missing field";
    case ScipError::TooLong:
      return "too long";
  }
  return "unknown";
}

void append_number(std::string& out, std::uint32_t value, int chars) {
  for (int shift = 6 * (chars - 1); shift >= 0; shift -= 6) {
    out.push_back(static_cast<char>(((value >> shift) & 0x3F) + kFirstCode));
  }
}

std::string encode_number(std::uint32_t value, int chars) {
  std::string out;
  append_number(out, value, chars);
  return out;
}

tl::expected<std::uint32_t, ScipError> decode_number(std::string_view text) {
  if (text.empty()) return tl::unexpected(ScipError::Truncated);
  if (text.size() > kMaxNumberLength) return tl::unexpected(ScipError::BadForm);
  std::uint32_t value = 0;
  for (const char c : text) {
    const auto code = static_cast<std::uint32_t>(static_cast<unsigned char>(c)) - kFirstCode;
    if (code > 0x3F) return tl::unexpected(ScipError::BadCharacter);
    value = (value << 6) | code;
  }
  return value;
}

char line_sum(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & 0x3F) + kFirstCode);
}

void append_line(std::string& out, std::string_view body) {
  out.append(body).push_back(line_sum(body));
  out.push_back('\n');
}

void append_data_block(std::string& out, std::string_view payload) {
  for (; !payload.empty(); payload.remove_prefix(std::min(payload.size(), kDataLineLength))) {
    append_line(out, payload.substr(0, kDataLineLength));
  }
}

void append_key_value(std::string& out, std::string_view key, std::string_view value) {
  const std::size_t begin = out.size();
  out.append(key).append(":").append(value);
  const char sum = line_sum(std::string_view(out).substr(begin));
  out.push_back(';');
  out.push_back(sum);
  out.push_back('\n');
}

tl::expected<std::string_view, ScipError> checked_body(std::string_view line) {
  if (line.size() < 2) return tl::unexpected(ScipError::Truncated);
  const std::string_view body = line.substr(0, line.size() - 1);
  if (line_sum(body) != line.back()) return tl::unexpected(ScipError::BadSum);
  return body;
}

tl::expected<KeyValue, ScipError> parse_key_value(std::string_view line) {
  if (line.size() < 4) return tl::unexpected(ScipError::Truncated);
  if (line[line.size() - 2] != ';') return tl::unexpected(ScipError::BadForm);
  const std::string_view text = line.substr(0, line.size() - 2);
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) return tl::unexpected(ScipError::BadForm);

  const char sum = line.back();
  const bool sum_fits = sum == line_sum(text) || sum == line_sum(line.substr(0, line.size() - 1)) ||
                        (text.find("<-") != std::string_view::npos && sum == line_sum(text.substr(0, text.find("<-"))));
  if (!sum_fits) return tl::unexpected(ScipError::BadSum);
  if (!std::ranges::all_of(text, is_printable)) return tl::unexpected(ScipError::BadCharacter);
  return KeyValue{text.substr(0, colon), text.substr(colon + 1)};
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace stairway::drivers
