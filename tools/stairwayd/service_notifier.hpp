// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::daemon {

/// Tells systemd how the service is doing, as sd_notify(3) does; does nothing where $NOTIFY_SOCKET is not set.
class ServiceNotifier {
 public:
  ServiceNotifier();

  /// Sends assignments such as "READY=1\nSTATUS=scanning". Never waits; a lost notification is systemd's to notice.
  void send(std::string_view assignments) const;

 private:
  std::string address_;
};

}  // namespace stairway::daemon
