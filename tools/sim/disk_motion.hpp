// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

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

/// The disk's incremental encoder: a sample at every count and, at rest, one every 50 ms. Samples are valid after the
/// first index, which is at every whole turn.
class FakeEncoder {
 public:
  /// @param counts_per_turn  at least 4; a quadrature count of all edges.
  FakeEncoder(const DiskMotion& motion, drivers::HostStamp start_ns, int counts_per_turn);

  /// The samples after those already given, up to `now_ns`, in order.
  std::vector<drivers::AngleSample> samples_until(const DiskMotion& motion, drivers::HostStamp now_ns);
  /// When the next sample is due if the speed stays.
  drivers::HostStamp next_sample_ns(const DiskMotion& motion) const;

 private:
  void step_to(drivers::HostStamp stamp_ns, std::int64_t count);

  double radians_per_count_;
  std::int64_t counts_per_turn_;
  std::int64_t count_;
  drivers::HostStamp stamp_ns_;  // of the last sample
  bool is_homed_ = false;
};

}  // namespace stairway::sim
