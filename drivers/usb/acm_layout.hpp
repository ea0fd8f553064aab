// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <cstdint>
#include <optional>

namespace stairway::drivers {

/// Where a USB modem (CDC-ACM), which is how a scanner shows itself, takes and gives its bytes.
struct AcmLayout {
  std::optional<std::uint8_t> control_interface;  ///< class 2; line coding and control lines go there
  std::uint8_t data_interface = 0;                ///< class 0x0A
  std::uint8_t endpoint_in = 0;
  std::uint8_t endpoint_out = 0;
  int in_packet_bytes = 64;  ///< largest packet of `endpoint_in`
};

/// Reads the layout from the descriptors: the interface of class 0x0A with a bulk endpoint in each direction, whatever
/// their numbers are. Empty when there is none.
std::optional<AcmLayout> find_acm_layout(const libusb_config_descriptor& configuration);

}  // namespace stairway::drivers
