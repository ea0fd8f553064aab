// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/usb/usb_options.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace stairway::drivers {
namespace {

bool is_number(std::string_view text) {
  return !text.empty() && text.size() <= 3 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

bool is_usb_path(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos || !is_number(text.substr(0, dash))) return false;
  for (text.remove_prefix(dash + 1);;) {
    const std::size_t dot = text.find('.');
    if (!is_number(text.substr(0, dot))) return false;
    if (dot == std::string_view::npos) return true;
    text.remove_prefix(dot + 1);
  }
}

}  // namespace

std::string UsbOptions::problem() const {
  if (port.empty() || is_usb_path(port)) return {};
  return "usb_port must be empty or a bus and its ports such as \"1-2.3\", as the kernel's log shows them";
}

}  // namespace stairway::drivers
