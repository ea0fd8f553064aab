// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace stairway::daemon {

/// Sends bytes on a channel; may be called by any thread. False when they could not be sent.
using Publish = std::function<bool(const std::string& channel, std::span<const std::uint8_t> bytes)>;

}  // namespace stairway::daemon
