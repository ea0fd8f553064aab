// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/can.h>

#include <span>
#include <variant>
#include <vector>

#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// What the kernel hands out of a raw CAN socket, as the port tells it: a frame, or the conditions of an error frame.
/// Nothing for frames that CANopen does not have (29-bit identifiers, remote requests, a length above 8) and for errors
/// that mean nothing here.
std::vector<std::variant<CanFrame, CanCondition>> from_raw_frame(const can_frame& raw);

can_frame to_raw_frame(const CanFrame& frame);

/// The classes of error frames that `from_raw_frame` understands, for CAN_RAW_ERR_FILTER.
can_err_mask_t raw_error_classes();

/// Lets through what a drive sends, and what tells of another master: its NMT commands, its requests to the drive, its
/// heartbeat under this host's number.
/// @param node, host_node  1..127.
std::vector<can_filter> raw_filters(int node, int host_node);

}  // namespace stairway::drivers
