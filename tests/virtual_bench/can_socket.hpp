// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "drivers/gpio/file_descriptor.hpp"
#include "drivers/ports/can_port.hpp"

namespace stairway::bench {

/// A raw CAN socket of the bench's own, so that the daemon's is not tested against itself.
class CanSocket {
 public:
  enum class Reading { Frame, Nothing, Gone };

  /// Empty when there is no such interface.
  static std::optional<CanSocket> open(const std::string& interface);

  int descriptor() const { return file_.get(); }
  /// One frame if there is any; does not wait. Gone: the interface was removed.
  Reading read(drivers::CanFrame& frame) const;
  /// Lost when the interface is down.
  void write(const drivers::CanFrame& frame) const;

 private:
  explicit CanSocket(drivers::FileDescriptor file) : file_(std::move(file)) {}

  drivers::FileDescriptor file_;
};

}  // namespace stairway::bench
