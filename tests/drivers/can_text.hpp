// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// Reads a frame as candump prints it: `601#2F60600003000000`.
inline CanFrame frame_of(std::string_view text) {
  const std::string_view bytes = text.substr(4);
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(std::stoul(std::string(text.substr(0, 3)), nullptr, 16));
  frame.length = static_cast<std::uint8_t>(bytes.size() / 2);
  for (std::size_t i = 0; i < frame.length; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(std::stoul(std::string(bytes.substr(2 * i, 2)), nullptr, 16));
  }
  return frame;
}

}  // namespace stairway::drivers
