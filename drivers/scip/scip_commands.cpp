// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_commands.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stairway::drivers {
namespace {

constexpr std::size_t kMaxTagLength = 16;
constexpr std::array<std::string_view, 6> kScanSymbols{"MD", "MS", "ME", "GD", "GS", "GE"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_tag_character(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view(" ._+@").find(c) != std::string_view::npos;
}

void append_decimal(std::string& out, int value, int digits) {
  const std::string text = std::to_string(value);
  out.append(static_cast<std::size_t>(std::max(0, digits - static_cast<int>(text.size()))), '0').append(text);
}

int take_decimal(std::string_view& text, std::size_t digits) {
  int value = 0;
  for (const char c : text.substr(0, digits)) value = 10 * value + (c - '0');
  text.remove_prefix(digits);
  return value;
}

}  // namespace

std::string to_command(const ScanRequest& request) {
  std::string out = request.symbol;
  append_decimal(out, request.first_step, 4);
  append_decimal(out, request.last_step, 4);
  append_decimal(out, request.cluster, 2);
  if (request.is_stream()) {
    append_decimal(out, request.skip_scan, 1);
    append_decimal(out, request.scans, 2);
  }
  return out;
}

std::optional<Command> parse_command(std::string_view line) {
  const std::size_t semicolon = line.find(';');
  Command command;
  if (semicolon != std::string_view::npos) {
    command.tag = line.substr(semicolon + 1);
    line = line.substr(0, semicolon);
    if (command.tag.size() > kMaxTagLength || !std::ranges::all_of(command.tag, is_tag_character)) return std::nullopt;
  }
  if (line.size() < 2) return std::nullopt;
  const std::size_t symbol_length = line == "SCIP2.0" ? line.size() : 2;
  command.symbol = line.substr(0, symbol_length);
  command.parameters = line.substr(symbol_length);
  return command;
}

std::optional<ScanRequest> parse_scan_request(const Command& command) {
  if (std::ranges::find(kScanSymbols, command.symbol) == kScanSymbols.end()) return std::nullopt;
  ScanRequest request;
  request.symbol = command.symbol;
  std::string_view text = command.parameters;
  if (text.size() != (request.is_stream() ? 13U : 10U) || !std::ranges::all_of(text, is_digit)) return std::nullopt;
  request.first_step = take_decimal(text, 4);
  request.last_step = take_decimal(text, 4);
  request.cluster = take_decimal(text, 2);
  if (request.is_stream()) {
    request.skip_scan = take_decimal(text, 1);
    request.scans = take_decimal(text, 2);
  }
  return request;
}

}  // namespace stairway::drivers
