// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "drivers/gpio/gpio_lines.hpp"

namespace stairway::drivers {

/// The encoder's lines by libgpiod, of the version that the program was built with. Version 1 has a queue of 16 edges
/// for each line, and what does not fit is lost without a word; version 2 is the kernel's interface of version 2.
/// Stamps are CLOCK_MONOTONIC.
tl::expected<std::unique_ptr<EdgePort>, std::string> open_libgpiod_lines(const GpioLines& lines,
                                                                         const EncoderOptions& options);
/// E.g. "libgpiod 1.6.3".
std::string libgpiod_name();

}  // namespace stairway::drivers
