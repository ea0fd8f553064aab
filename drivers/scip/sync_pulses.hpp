// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "drivers/types.hpp"

namespace stairway::drivers {

/// The sensor's synchronous output, one pulse for each turn of the mirror, as a better clock than the arrivals over
/// USB. At which angle of the mirror the pulse comes is not documented: it is a setting, and `residual_ns` tells by how
/// much it is wrong. Pulses are believed after a second of them that come evenly and within 5 ms of where the arrivals
/// put them, and no longer after a second without.
class SyncPulses {
 public:
  /// @param offset_ns  from the instant that the beam points straight backwards to the pulse [ns].
  explicit SyncPulses(double offset_ns) : offset_ns_(offset_ns) {}

  void set_turn_period(double turn_period_ns) { turn_period_ns_ = turn_period_ns; }

  /// Takes the host time of a pulse's leading edge [ns]; one that is not later than the one before is left out.
  void add(HostStamp pulse_ns);

  /// Looks for the pulse of a turn.
  /// @param rear_ns  when the beam pointed backwards, as far as the arrival of its scan tells [ns].
  /// @return The same by the pulse; empty when there is none or it comes unevenly.
  std::optional<HostStamp> match(HostStamp rear_ns);

  /// Whether pulses are to be believed instead of arrivals.
  bool is_locked() const { return is_locked_; }
  /// Whether pulses come evenly, but not where the offset says.
  bool is_misplaced() const;
  /// Mean of the pulses' instants behind those by the arrivals [ns]; add it to the offset to make it vanish.
  double residual_ns() const { return residual_ns_; }
  std::uint64_t pulses() const { return pulses_; }

 private:
  std::optional<HostStamp> find(HostStamp rear_ns) const;

  double offset_ns_;
  double turn_period_ns_ = 25e6;
  std::deque<HostStamp> recent_;
  std::uint64_t pulses_ = 0;
  double residual_ns_ = 0.0;
  int run_ = 0;  // matches in a row; negative: misses
  bool is_locked_ = false;
};

}  // namespace stairway::drivers
