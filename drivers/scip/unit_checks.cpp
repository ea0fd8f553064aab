// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/unit_checks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stairway::drivers {
namespace {

constexpr std::size_t kMaxQuote = 32;
constexpr int kMaxNumber = 100000;

using Version = std::array<int, 3>;
constexpr Version kBadClock{1, 16, 2};
constexpr Version kOldestGood{1, 18, 1};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view bare_serial(std::string_view serial) {
  if (serial.starts_with('H') || serial.starts_with('h')) serial.remove_prefix(1);
  serial.remove_prefix(std::min(serial.find_first_not_of('0'), serial.size()));
  return serial;
}

// The first numbers of the text that are joined by dots; all zero when there are none.
Version read_version(std::string_view text) {
  Version version{};
  text.remove_prefix(
      std::min(static_cast<std::size_t>(std::ranges::find_if(text, is_digit) - text.begin()), text.size()));
  for (int& number : version) {
    while (!text.empty() && is_digit(text.front())) {
      number = std::min(kMaxNumber, 10 * number + (text.front() - '0'));
      text.remove_prefix(1);
    }
    if (!text.starts_with('.')) break;
    text.remove_prefix(1);
  }
  return version;
}

}  // namespace

bool is_same_serial(std::string_view a, std::string_view b) { return bare_serial(a) == bare_serial(b); }

std::string firmware_warning(std::string_view firmware) {
  const Version version = read_version(firmware);
  const std::string name = "firmware " + std::string(firmware.substr(0, kMaxQuote));
  if (version == kBadClock) return name + " has a clock that runs wrong: have it updated";
  if (version != Version{} && version < kOldestGood) return name + " is older than 1.18.01 and has known faults";
  return {};
}

}  // namespace stairway::drivers
