// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace stairway::bench {

/// The hardware that the kernel believes in: a USB serial gadget with the scanner's numbers, a virtual CAN bus, and a
/// chip of simulated GPIO lines. For root in a machine of its own; functions throw std::runtime_error.
class Rig {
 public:
  static constexpr const char* kTty = "/dev/ttyGS0";
  static constexpr const char* kBus = "can0";
  static constexpr const char* kEncoderChip = "encoder";

  /// Loads the drivers and starts what devices need: udev, which tells libusb of new ones and sets their permissions by
  /// this project's rules, and a route for LCM.
  /// @param modules  folder with lib/modules.
  explicit Rig(const std::filesystem::path& modules);

  void plug_scanner();
  void unplug_scanner();

  void add_bus();
  void remove_bus();
  void raise_bus();
  void lower_bus();

  void add_encoder_chip();
  void remove_encoder_chip();
  /// The folder with a subfolder for each line of the encoder's chip.
  std::filesystem::path encoder_lines() const;

 private:
  std::filesystem::path gadget_;
  std::filesystem::path chip_;
  std::string controller_;
};

}  // namespace stairway::bench
