// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/acm_line.hpp"

#include <libusb.h>

namespace stairway::drivers {

std::array<unsigned char, 7> line_coding(std::uint32_t rate_baud) {
  const auto byte = [&](int index) { return static_cast<unsigned char>(rate_baud >> 8 * index & 0xFF); };
  constexpr unsigned char kOneStopBit = 0, kNoParity = 0, kDataBits = 8;
  return {byte(0), byte(1), byte(2), byte(3), kOneStopBit, kNoParity, kDataBits};
}

std::string line_setting_problem(int result) {
  if (result >= 0 || result == LIBUSB_ERROR_PIPE) return {};
  return std::string("its serial line cannot be set (") + libusb_strerror(result) + "); plug it in again";
}

}  // namespace stairway::drivers
