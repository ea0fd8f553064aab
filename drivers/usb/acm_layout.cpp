// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/acm_layout.hpp"

#include <span>

namespace stairway::drivers {
namespace {

constexpr std::uint8_t kTransferTypeMask = 0x03;

// Adds the bulk endpoints of `setting`; true when both directions are there.
bool find_endpoints(const libusb_interface_descriptor& setting, AcmLayout& layout) {
  for (const libusb_endpoint_descriptor& endpoint : std::span(setting.endpoint, setting.bNumEndpoints)) {
    if ((endpoint.bmAttributes & kTransferTypeMask) != LIBUSB_TRANSFER_TYPE_BULK) continue;
    const bool is_in = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_DIR_MASK) == LIBUSB_ENDPOINT_IN;
    (is_in ? layout.endpoint_in : layout.endpoint_out) = endpoint.bEndpointAddress;
    if (is_in && endpoint.wMaxPacketSize > 0) layout.in_packet_bytes = endpoint.wMaxPacketSize;
  }
  return layout.endpoint_in != 0 && layout.endpoint_out != 0;
}

}  // namespace

std::optional<AcmLayout> find_acm_layout(const libusb_config_descriptor& configuration) {
  std::optional<AcmLayout> found;
  std::optional<std::uint8_t> control_interface;
  for (const libusb_interface& interface : std::span(configuration.interface, configuration.bNumInterfaces)) {
    if (interface.num_altsetting < 1) continue;
    const libusb_interface_descriptor& setting = interface.altsetting[0];
    if (setting.bInterfaceClass == LIBUSB_CLASS_COMM && !control_interface) {
      control_interface = setting.bInterfaceNumber;
    }
    AcmLayout layout;
    layout.data_interface = setting.bInterfaceNumber;
    if (setting.bInterfaceClass == LIBUSB_CLASS_DATA && !found && find_endpoints(setting, layout)) found = layout;
  }
  if (found) found->control_interface = control_interface;
  return found;
}

}  // namespace stairway::drivers
