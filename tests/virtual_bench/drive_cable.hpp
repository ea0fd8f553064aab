// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>

#include "tests/virtual_bench/robot.hpp"

namespace stairway::bench {

/// Lets the robot's drive speak on a CAN interface until it is told to stop, and the disk turn as the drive turns it.
/// Where there is no interface, or it is down, the drive hears nothing and what it says is lost.
void serve_drive(Robot& robot, const std::string& interface, std::stop_token stop);

}  // namespace stairway::bench
