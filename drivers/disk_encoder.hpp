// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/encoder/encoder_session.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"

namespace stairway::drivers {

/// The disk's quadrature encoder on a port: opens the port, opens it again after it was lost (0.5 s doubling to 10 s,
/// without end), and moves edges to the session. It has no thread; one thread calls `poll` in a loop.
class DiskEncoder {
 public:
  /// Time on the line of the port's stamps.
  using Clock = std::function<HostStamp()>;

  /// @pre  options.problem() is empty.
  DiskEncoder(PortOpener<EdgePort> opener, Clock now, const EncoderOptions& options);

  /// Waits at most `timeout` for something to happen and gives what happened, in order. Samples come in the order of
  /// their stamps, one per edge of A and B; at rest the last angle is repeated every 50 ms, so that a disk at rest can
  /// be told from a dead encoder.
  std::vector<EncoderEvent> poll(std::chrono::nanoseconds timeout);

  const EncoderSession& session() const { return session_; }
  bool is_port_open() const { return port_ != nullptr; }

 private:
  std::vector<EncoderEvent> open(std::chrono::nanoseconds timeout);
  std::vector<EncoderEvent> lose_port();

  PortOpener<EdgePort> opener_;
  Clock now_;
  EncoderSession session_;
  std::unique_ptr<EdgePort> port_;
};

}  // namespace stairway::drivers
