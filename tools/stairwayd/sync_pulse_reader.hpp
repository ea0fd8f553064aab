// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"

namespace stairway::daemon {

/// Reads the scanner's synchronous output, an open collector that pulls its line low once for each turn of the mirror.
/// It is a help, not a need: a line that cannot be opened is told, and tried again every 10 s. Used by one thread.
class SyncPulseReader {
 public:
  using Clock = std::function<drivers::HostStamp()>;
  using Sink = std::function<void(drivers::HostStamp)>;
  using Problem = std::function<void(const std::string&)>;

  /// @param opener  of a port that tells the line as line A.
  /// @param sink     is told the beginning of every pulse, in order [ns].
  /// @param problem  is told why the line cannot be opened or was lost.
  SyncPulseReader(drivers::PortOpener<drivers::EdgePort> opener, Clock now_ns, Sink sink, Problem problem);

  /// Tells the pulses that came since the last call; does not wait.
  void drain();

 private:
  void open();

  drivers::PortOpener<drivers::EdgePort> opener_;
  Clock now_ns_;
  Sink sink_;
  Problem problem_;
  std::unique_ptr<drivers::EdgePort> port_;
  std::optional<drivers::HostStamp> retry_ns_;
};

/// The scanner's ports, but pulses are drained before bytes are handed out: a scan is dated by the pulse before it.
drivers::PortOpener<drivers::BytePort> with_sync_pulses(drivers::PortOpener<drivers::BytePort> scanner,
                                                        std::shared_ptr<SyncPulseReader> pulses);

}  // namespace stairway::daemon
