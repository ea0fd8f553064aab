// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stop_token>

#include "tests/virtual_bench/robot.hpp"

namespace stairway::bench {

/// Moves the lines of a gpio-sim chip as the robot's encoder would, until it is told to stop: 0 is A, 1 is B, a quarter
/// of a period behind when the disk turns counter-clockwise, and 2 is the index, high for one count at every whole
/// turn. An edge waits for no reader; after a stall the edges that are due follow each other in half milliseconds.
/// @param chip  the chip's folder in configfs; it may come and go.
void serve_encoder(Robot& robot, const std::filesystem::path& chip, std::stop_token stop);

}  // namespace stairway::bench
