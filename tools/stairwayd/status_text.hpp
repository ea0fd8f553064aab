// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "ipc/messages.hpp"

namespace stairway::daemon {

/// What `systemctl status` shows: the state, then the sweep, the devices' rates and troubles, drops of the queues, and
/// the last answer, on one line.
std::string status_text(const ipc::HealthMessage& health);

}  // namespace stairway::daemon
