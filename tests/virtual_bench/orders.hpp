// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/virtual_bench/robot.hpp"

namespace stairway::bench {

/// Does what is said, e.g. "drive fault", and answers "done", a figure, or what there is to order.
std::string obey(Robot& robot, const std::string& order);

/// All orders, one a line.
std::string list_of_orders();

}  // namespace stairway::bench
