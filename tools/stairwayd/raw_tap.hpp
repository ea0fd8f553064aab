// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "config/settings.hpp"
#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// Whether STAIRWAY_RAW is sent or recorded.
bool is_raw_wanted(const config::Settings& settings);

/// The scanner's ports, with what goes through them told to `sink`: by the thread that uses the port, in order. What
/// could not be sent is not told.
drivers::PortOpener<drivers::BytePort> with_raw_tap(drivers::PortOpener<drivers::BytePort> scanner,
                                                    std::function<drivers::HostStamp()> now_ns,
                                                    std::function<void(RawBytes)> sink);

}  // namespace stairway::daemon
