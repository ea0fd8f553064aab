// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>

#include "tests/virtual_bench/robot.hpp"

namespace stairway::bench {

/// Lets the robot's scanner speak on the device side of a USB serial gadget, until it is told to stop. While nobody is
/// plugged in, what the scanner says is lost; the scanner itself, which has a power supply of its own, goes on.
void serve_scanner(Robot& robot, const std::string& tty, std::stop_token stop);

}  // namespace stairway::bench
