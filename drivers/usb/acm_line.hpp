// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace stairway::drivers {

/// The data of SET_LINE_CODING (USB CDC PSTN 1.2, 6.3.10): 8 bits, no parity, 1 stop bit, at that rate [bit/s].
std::array<unsigned char, 7> line_coding(std::uint32_t rate_baud);

/// Why a line could not be set, for a person; empty when it was, or when the device refused it by a stall: some do, and
/// work all the same.
/// @param result  of libusb_control_transfer().
std::string line_setting_problem(int result);

}  // namespace stairway::drivers
