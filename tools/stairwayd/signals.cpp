// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/signals.hpp"

#include <unistd.h>

#include <algorithm>

namespace stairway::daemon {

Signals::Signals() {
  sigemptyset(&set_);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2}) sigaddset(&set_, signal);
  pthread_sigmask(SIG_BLOCK, &set_, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

Wakeup Signals::wait_until(std::chrono::steady_clock::time_point deadline) const {
  using std::chrono::nanoseconds;
  const nanoseconds left = std::max(nanoseconds::zero(), nanoseconds(deadline - std::chrono::steady_clock::now()));
  const timespec timeout{left.count() / 1'000'000'000, left.count() % 1'000'000'000};
  switch (sigtimedwait(&set_, nullptr, &timeout)) {
    case SIGTERM:
    case SIGINT:
      return Wakeup::Stop;
    case SIGHUP:
      return Wakeup::Reload;
    case SIGUSR1:
      return Wakeup::Called;
    case SIGUSR2:
      return Wakeup::Snapshot;
    default:
      return Wakeup::Timeout;
  }
}

void Signals::wake() { ::kill(::getpid(), SIGUSR1); }

}  // namespace stairway::daemon
