// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <csignal>

namespace stairway::daemon {

enum class Wakeup {
  Stop,      ///< SIGTERM or SIGINT
  Reload,    ///< SIGHUP
  Called,    ///< wake()
  Snapshot,  ///< SIGUSR2
  Timeout,
};

/// The signals of the process, taken by the one thread that waits for them. Make it before any other thread, so that
/// all of them leave the signals alone. A peer that closes its connection (SIGPIPE) is from then on a failed write.
class Signals {
 public:
  Signals();
  Wakeup wait_until(std::chrono::steady_clock::time_point deadline) const;
  /// Ends the wait; from any thread.
  static void wake();

 private:
  sigset_t set_;
};

}  // namespace stairway::daemon
