// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "drivers/scip/scip_session.hpp"

namespace stairway::drivers {

/// A UTM-30LX on a port: opens the port, opens it again after it was lost (0.5 s doubling to 10 s, without end), and
/// moves bytes between it and the session. It has no thread; one thread calls `poll` in a loop.
class Utm30lx {
 public:
  /// Time on the line of the port's arrival stamps.
  using Clock = std::function<HostStamp()>;

  /// @pre  options.problem() is empty.
  Utm30lx(PortOpener<BytePort> opener, Clock now, const ScipOptions& options);
  /// Stops the stream and the laser if the port still takes commands.
  ~Utm30lx();
  Utm30lx(const Utm30lx&) = delete;
  Utm30lx& operator=(const Utm30lx&) = delete;

  /// Waits at most `timeout` for something to happen and gives what happened, in order; often nothing.
  std::vector<ScipEvent> poll(std::chrono::nanoseconds timeout);

  /// As ScipSession::on_sync_pulse.
  void on_sync_pulse(HostStamp stamp_ns) { session_.on_sync_pulse(stamp_ns); }

  const ScipSession& session() const { return session_; }
  bool is_port_open() const { return port_ != nullptr; }

 private:
  std::vector<ScipEvent> open(std::chrono::nanoseconds timeout);
  void send_output(std::vector<ScipEvent>& events);

  PortOpener<BytePort> opener_;
  Clock now_;
  ScipSession session_;
  std::unique_ptr<BytePort> port_;
};

}  // namespace stairway::drivers
