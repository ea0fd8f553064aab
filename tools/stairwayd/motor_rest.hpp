// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/disk_motor.hpp"

namespace stairway::daemon {

/// Switches the motor off while it is not wanted, and on again.
class MotorRest {
 public:
  void follow(bool is_wanted, drivers::DiskMotor& motor) {
    if (is_wanted != is_resting_) return;
    is_resting_ = !is_wanted;
    is_wanted ? motor.start() : motor.rest();
  }

 private:
  bool is_resting_ = false;
};

}  // namespace stairway::daemon
