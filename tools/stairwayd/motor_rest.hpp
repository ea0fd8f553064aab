// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "drivers/disk_motor.hpp"

namespace stairway::daemon {

/// What the motor is there for at the moment.
enum class MotorWish : std::uint8_t {
  On,         ///< follows the wanted speed
  Off,        ///< brakes by its ramp, then is switched off
  QuickStop,  ///< brakes as fast as it can, then is switched off: the disk does what it was not told to
};

/// Switches the motor off while it is not wanted, and on again.
class MotorRest {
 public:
  void follow(MotorWish wish, drivers::DiskMotor& motor) {
    if (wish == std::exchange(last_, wish)) return;
    if (wish == MotorWish::On) motor.start();
    if (wish == MotorWish::Off) motor.rest();
    if (wish == MotorWish::QuickStop) motor.quick_stop();
  }

 private:
  MotorWish last_ = MotorWish::On;
};

}  // namespace stairway::daemon
