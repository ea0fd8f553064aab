// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "drivers/types.hpp"

namespace stairway::sim {

/// The simulated drive's motor: a speed that follows its target in steps of 5 ms, and the turns it has made. Between
/// the steps the speed is constant, so that whoever listens can follow the angle exactly.
class FakeDriveMotor {
 public:
  using Listener = std::function<void(drivers::HostStamp, double turns_per_s)>;

  FakeDriveMotor(drivers::HostStamp start_ns, double start_turns) : now_ns_(start_ns), turns_(start_turns) {}

  /// Is told each new speed at its instant.
  void listen(Listener listener) { listener_ = std::move(listener); }
  /// From now on; the speed changes by at most `acceleration` when it grows away from 0 and by `deceleration` when it
  /// falls towards it [turns/s, turns/s^2].
  void follow(double target, double acceleration, double deceleration);
  void advance(drivers::HostStamp now_ns);
  /// When the speed changes next; the greatest stamp when it does not.
  drivers::HostStamp next_step_ns() const;

  double speed() const { return speed_; }
  double target() const { return target_; }
  double turns() const { return turns_; }

 private:
  void step();

  Listener listener_;
  drivers::HostStamp now_ns_;
  drivers::HostStamp step_ns_ = std::numeric_limits<drivers::HostStamp>::max();
  double turns_;
  double speed_ = 0.0;
  double target_ = 0.0;
  double acceleration_ = 0.0;
  double deceleration_ = 0.0;
};

}  // namespace stairway::sim
