// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace stairway::drivers {

/// Where the sensor's synchronous output is wired to, if it is: an open collector that needs a pull-up, one pulse for
/// each turn of the mirror.
struct SyncInputOptions {
  std::string chip;  ///< GPIO chip by name, label or path, e.g. "gpiochip0"; empty without such a wire
  std::string line;  ///< of that chip, by number or name; empty without such a wire

  bool is_wired() const { return !chip.empty() && !line.empty(); }
  /// First problem found, worded for the person editing the file; empty when usable.
  std::string problem() const {
    return chip.empty() == line.empty() ? "" : "sync_chip and sync_line belong together: set both or none";
  }
};

}  // namespace stairway::drivers
