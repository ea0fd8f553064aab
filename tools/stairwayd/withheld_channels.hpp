// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "config/settings.hpp"

namespace stairway::daemon {

/// The channels that are recorded, but not sent: those that settings switch off, and with the source `lcm` the
/// measurements, which come from the bus and would be heard again.
std::set<std::string> withheld_channels(const config::Settings& settings);

}  // namespace stairway::daemon
