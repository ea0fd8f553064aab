// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libusb.h>

#include <string>

namespace stairway::drivers {

/// Where a device is plugged in, as the kernel names it: bus, then the ports of the hubs on the way, e.g. "1-2.3".
std::string usb_path(libusb_device* device);

}  // namespace stairway::drivers
