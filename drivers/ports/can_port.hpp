// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// A classic CAN data frame with an 11-bit identifier; the only kind that CANopen needs here.
struct CanFrame {
  std::uint16_t id = 0;     ///< 0..0x7ff
  std::uint8_t length = 0;  ///< bytes of `data` that count, 0..8
  std::array<std::uint8_t, 8> data{};

  std::span<const std::uint8_t> payload() const { return std::span(data).first(length); }
  bool operator==(const CanFrame&) const = default;
};

/// What a controller or its link tells about the bus.
enum class CanCondition : std::uint8_t {
  Active,         ///< errors are rare again
  Warning,        ///< errors become frequent
  Passive,        ///< so frequent that the controller no longer interrupts others
  BusOff,         ///< the controller has left the bus
  Restarted,      ///< it is back after bus-off
  Unheard,        ///< nobody acknowledges: no other node, no power, or another bit rate
  TransmitStuck,  ///< a frame could not be sent in time
  Overrun,        ///< frames were lost because nobody read them
  LinkDown,       ///< the interface was switched off
  LinkUp,         ///< and on again
};
const char* to_string(CanCondition condition);

struct CanArrival {
  HostStamp arrival_ns = 0;  ///< [ns]
  std::variant<CanFrame, CanCondition> what;
};

/// The place where CAN frames enter and leave the process: SocketCAN or a simulated bus. A port is used by one thread.
/// A link that goes down and up again is a condition; `Closed` is an interface that was removed, and final.
class CanPort {
 public:
  virtual ~CanPort() = default;
  /// Waits at most `timeout` for frames or conditions; empty when none came.
  virtual tl::expected<std::vector<CanArrival>, PortError> read(std::chrono::nanoseconds timeout) = 0;
  /// Hands one frame to the controller. Waits a little when its queue is full; `Io` when the frame could not be placed
  /// (bus-off, link down, queue full for too long): it is lost, and the port goes on.
  virtual tl::expected<void, PortError> write(const CanFrame& frame) = 0;
};

}  // namespace stairway::drivers
