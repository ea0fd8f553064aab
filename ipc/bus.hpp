// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace stairway::ipc {

enum class BusFault {
  CannotOpen,  ///< the provider cannot be opened
  BadChannel,  ///< a channel name that LCM does not take
  Io,          ///< sending or receiving failed
  Ended,       ///< the log file that is being played has ended
};
std::string_view to_string(BusFault fault);

/// `text` is one line for a person and says what to do.
struct BusError {
  BusFault fault = BusFault::Io;
  std::string text;
};

/// A message as it arrives; valid during the call only.
struct BusMessage {
  std::string_view channel;
  std::span<const std::uint8_t> bytes;
  std::int64_t arrival_utime_us = 0;  ///< microseconds since the epoch; the recorded instant when a log is played
};

using MessageHandler = std::function<void(const BusMessage&)>;

/// The place where messages enter and leave the process.
/// `publish` may be called by any thread, the others by one thread only.
class Bus {
 public:
  virtual ~Bus() = default;

  /// Sends `bytes` on `channel`. Delivery is not acknowledged: a message may be lost on its way.
  virtual tl::expected<void, BusError> publish(const std::string& channel, std::span<const std::uint8_t> bytes) = 0;

  /// Calls `handler`, from within `handle`, for every message on the channels that match `pattern` (a regular
  /// expression for the whole name). The handler must not throw and must not call `handle`.
  virtual tl::expected<void, BusError> subscribe(const std::string& pattern, MessageHandler handler) = 0;

  /// Waits at most `timeout` for a message and hands it on; answers whether there was one.
  virtual tl::expected<bool, BusError> handle(std::chrono::milliseconds timeout) = 0;
};

}  // namespace stairway::ipc
