// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace stairway::sim {

/// What can be made to go wrong with the simulated sensor, after what real ones do.
enum class SensorFault : std::uint8_t {
  Garbage,        ///< junk with ends of line before each of the next `count` messages
  BadSum,         ///< a flipped bit in the data of each of the next `count` scans
  LostLineFeed,   ///< an end of line is missing in each of the next `count` scans
  Stuck,          ///< the stream falls silent until it is started again
  SelfCheck,      ///< status 21 in the stream, silence for `count` turns, status 98
  LaserFault,     ///< status 50 in the stream, which ends; for the next `count` streams
  ClockJump,      ///< its counter goes ahead by 100 s, at once
  ClockReset,     ///< its counter begins at 0 again, at once
  RepeatedStamp,  ///< the next `count` scans carry the stamp of the one before
  StatTrouble,    ///< the next `count` answers to II report an error
  QuitIgnored,    ///< the next `count` QT have no answer and no effect
  TimeRefused,    ///< the next `count` TM0 are denied, as while booting
  LaserNotReady,  ///< the next `count` BM are denied, as for seconds after power-up
  WrongLength,    ///< a scan of each of the next `count` streams, and all behind it, lack their last line of data
};
inline constexpr std::size_t kSensorFaults = 14;

/// How often each fault is still to strike.
class SensorFaults {
 public:
  void add(SensorFault fault, int count) { counts_[static_cast<std::size_t>(fault)] += count; }
  int count(SensorFault fault) const { return counts_[static_cast<std::size_t>(fault)]; }
  /// Whether the fault strikes now; once less from then on.
  bool take(SensorFault fault);
  /// How often it strikes in all; none from then on.
  int take_all(SensorFault fault);

 private:
  std::array<int, kSensorFaults> counts_{};
};

/// Damaged messages; `seed` chooses where.
std::string with_garbage_before(const std::string& message, std::uint64_t seed);
std::string with_flipped_bit(std::string message, std::size_t first_byte, std::uint64_t seed);
std::string without_a_line_feed(std::string message, std::uint64_t seed);
std::string without_last_data_line(std::string message);

}  // namespace stairway::sim
