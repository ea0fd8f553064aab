// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/sensor_faults.hpp"

#include <algorithm>
#include <utility>

#include "tools/sim/random.hpp"

namespace stairway::sim {
namespace {

constexpr std::uint64_t kStream = 77;  // of random numbers, apart from those of the sensor's delays

std::size_t random_below(Random& random, std::size_t end) {
  return static_cast<std::size_t>(random.integer(0, static_cast<int>(end) - 1));
}

}  // namespace

bool SensorFaults::take(SensorFault fault) {
  int& count = counts_[static_cast<std::size_t>(fault)];
  if (count == 0) return false;
  --count;
  return true;
}

int SensorFaults::take_all(SensorFault fault) { return std::exchange(counts_[static_cast<std::size_t>(fault)], 0); }

std::string with_garbage_before(const std::string& message, std::uint64_t seed) {
  Random random{kStream, seed};
  std::string out(1 + random_below(random, 200), '\0');
  for (char& c : out) c = random_below(random, 10) == 0 ? '\n' : static_cast<char>(random_below(random, 256));
  return out + message;
}

std::string with_flipped_bit(std::string message, std::size_t first_byte, std::uint64_t seed) {
  Random random{kStream, seed};
  const std::size_t at = first_byte + random_below(random, message.size() - first_byte);
  message[at] = static_cast<char>(message[at] ^ (1 << random_below(random, 6)));
  return message;
}

std::string without_a_line_feed(std::string message, std::uint64_t seed) {
  Random random{kStream, seed};
  std::size_t lines_left = random_below(random, static_cast<std::size_t>(std::ranges::count(message, '\n')));
  const auto at = std::ranges::find_if(message, [&](char c) { return c == '\n' && lines_left-- == 0; });
  message.erase(at);
  return message;
}

std::string without_last_data_line(std::string message) {
  const std::size_t last_end = message.size() - 2;
  const std::size_t previous_end = message.rfind('\n', last_end - 1);
  message.erase(previous_end, last_end - previous_end);
  return message;
}

}  // namespace stairway::sim
