// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/usb_path.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stairway::drivers {
namespace {

constexpr std::size_t kMaxDepth = 7;  // of hubs, by the USB specification

}  // namespace

std::string usb_path(libusb_device* device) {
  std::array<std::uint8_t, kMaxDepth> ports{};
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string path = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) {
    path += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  }
  return path;
}

}  // namespace stairway::drivers
