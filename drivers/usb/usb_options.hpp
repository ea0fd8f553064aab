// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace stairway::drivers {

/// Which of several scanners is meant. They cannot be told apart by USB's own numbers.
struct UsbOptions {
  std::string port;  ///< where it is plugged in, as the kernel names it, e.g. "1-2.3"; empty is anywhere

  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const;
};

}  // namespace stairway::drivers
