// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "drivers/types.hpp"

namespace stairway::sim {

/// The true angle of the simulated disk: it turns at speeds that change at instants.
class DiskMotion {
 public:
  DiskMotion(drivers::HostStamp start_ns, double start_angle_rad, double speed_rad_s);

  /// From `stamp_ns` on, which is not before the last change. The last 1000 changes are remembered.
  void set_speed(drivers::HostStamp stamp_ns, double speed_rad_s);
  /// Not wrapped, counter-clockwise from above [rad]; before the first remembered change and after the last one its
  /// line goes on.
  double angle_at(drivers::HostStamp stamp_ns) const;
  double speed_at(drivers::HostStamp stamp_ns) const { return leg_at(stamp_ns).speed_rad_s; }
  /// When the speed changes next; empty when it does not.
  std::optional<drivers::HostStamp> next_change(drivers::HostStamp stamp_ns) const;

 private:
  struct Leg {
    drivers::HostStamp start_ns;
    double angle_rad;
    double speed_rad_s;
  };
  const Leg& leg_at(drivers::HostStamp stamp_ns) const;

  std::deque<Leg> legs_;
};

}  // namespace stairway::sim
