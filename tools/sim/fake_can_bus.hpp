// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tl/expected.hpp>
#include <vector>

#include "drivers/ports/can_port.hpp"
#include "tools/sim/fake_drive.hpp"

namespace stairway::sim {

/// The wire and the host's CAN interface between a host and the simulated drive, on the caller's time: what a CanPort
/// does, without its waiting.
class FakeCanBus {
 public:
  explicit FakeCanBus(FakeDrive& drive) : drive_(drive) {}

  /// As CanPort::write. Frames are on the drive's side at once.
  tl::expected<void, drivers::PortError> write(const drivers::CanFrame& frame, drivers::HostStamp now_ns);
  /// What the host has received up to `now_ns`, as CanPort::read. More than 1000 waiting frames are lost and tell of an
  /// overrun.
  tl::expected<std::vector<drivers::CanArrival>, drivers::PortError> take(drivers::HostStamp now_ns);
  /// When there is something to take, or the disk's speed changes.
  drivers::HostStamp next_due_ns() const;
  /// Lets time pass for the drive, also while nobody reads.
  void advance(drivers::HostStamp now_ns);

  /// `ip link set can0 down` and up.
  void set_link(bool is_up, drivers::HostStamp now_ns);
  /// The controller leaves the bus, and comes back.
  void set_bus_off(bool is_off, drivers::HostStamp now_ns);
  /// The cable is cut: nobody acknowledges, and writing fails.
  void set_unheard(bool is_unheard, drivers::HostStamp now_ns);
  /// The interface itself is gone; ports are closed, new ones cannot be opened until it is back.
  void set_removed(bool is_removed) { is_removed_ = is_removed; }
  bool is_removed() const { return is_removed_; }
  /// A frame from another node; host and drive receive it.
  void add_frame(const drivers::CanFrame& frame, drivers::HostStamp now_ns);
  void add_condition(drivers::CanCondition condition, drivers::HostStamp now_ns);

 private:
  bool is_connected() const { return is_up_ && !is_bus_off_ && !is_unheard_ && !is_removed_; }

  FakeDrive& drive_;
  bool is_up_ = true;
  bool is_bus_off_ = false;
  bool is_unheard_ = false;
  bool is_removed_ = false;
  bool has_overrun_ = false;
  std::vector<drivers::CanArrival> arrivals_;
};

}  // namespace stairway::sim
