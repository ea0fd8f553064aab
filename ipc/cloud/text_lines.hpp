// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>

#include "ipc/cloud_file.hpp"

namespace stairway::ipc::cloud {

/// The lines of a text that may turn into binary data: nothing behind the line last returned is looked at.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  /// The next line without its LF or CR LF; nothing at the end of the text.
  std::optional<std::string_view> next() {
    if (offset_ >= text_.size()) return std::nullopt;
    const std::size_t end = text_.find('\n', offset_);
    std::string_view line = text_.substr(offset_, end == std::string_view::npos ? end : end - offset_);
    offset_ = end == std::string_view::npos ? text_.size() : end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++line_number_;
    return line;
  }

  std::size_t line_number() const { return line_number_; }  ///< of the line last returned, counted from 1
  std::size_t offset() const { return offset_; }            ///< bytes consumed
  std::string_view rest() const { return text_.substr(offset_); }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  std::size_t line_number_ = 0;
};

/// Takes the first word off `line`; empty when none is left.
inline std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
  std::size_t end = begin;
  while (end < line.size() && line[end] != ' ' && line[end] != '\t') ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// Whether all of `word` is a number of type T; a leading plus is allowed.
template <class T>
std::errc parse_number(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{}) return error;
  return end == word.data() + word.size() ? std::errc{} : std::errc::invalid_argument;
}

/// `text` in quotes for a message: printable, and short whatever the file held.
inline std::string quoted(std::string_view text) {
  constexpr std::size_t kShown = 40;
  std::string out = "'";
  for (const char c : text.substr(0, kShown)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte > 0x7e ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return out + (text.size() > kShown ? "...'" : "'");
}

inline tl::unexpected<CloudFileError> error_at_line(std::size_t line, CloudFileFault fault, std::string_view text) {
  return tl::unexpected(CloudFileError{fault, fmt::format("line {}: {}", line, text)});
}

inline tl::unexpected<CloudFileError> error_at_byte(std::size_t byte, CloudFileFault fault, std::string_view text) {
  return tl::unexpected(CloudFileError{fault, fmt::format("byte {}: {}", byte, text)});
}

}  // namespace stairway::ipc::cloud
