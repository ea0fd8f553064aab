// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/ports/port_opener.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// From now to the deadline, at most `limit`, at least nothing.
inline std::chrono::nanoseconds time_until(HostStamp deadline_ns, HostStamp now_ns, std::chrono::nanoseconds limit) {
  if (deadline_ns <= now_ns) return std::chrono::nanoseconds::zero();
  return std::min(limit, std::chrono::nanoseconds(deadline_ns - now_ns));
}

template <class Event>
void append(std::vector<Event>& events, std::vector<Event> more) {
  std::ranges::move(more, std::back_inserter(events));
}

/// One attempt to fill `port` for a session that knows when it wants one: waits at most `timeout` for the session's
/// deadline, or opens and tells the session when that fails.
/// @return The session's events; `port` is still null when there is no port yet.
template <class Port, class Session, class Clock>
auto open_when_due(std::unique_ptr<Port>& port, PortOpener<Port>& opener, Session& session, const Clock& now,
                   std::chrono::nanoseconds timeout) -> decltype(session.on_disconnect(now(), {})) {
  if (const HostStamp now_ns = now(); session.deadline() > now_ns) {
    if (opener.wait(time_until(session.deadline(), now_ns, timeout))) session.retry_now(now());
    return {};
  }
  auto opened = opener.open();
  if (!opened) return session.on_disconnect(now(), opened.error());
  port = std::move(*opened);
  return {};
}

}  // namespace stairway::drivers
