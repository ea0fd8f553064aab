// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "config/settings.hpp"

/// One line per event on stderr. From any thread.
namespace stairway::daemon::log {

/// Under systemd lines begin with the priority that the journal understands, on a terminal with time and colour, else
/// with the time.
void set_up(config::LogLevel level);
void set_level(config::LogLevel level);

void error(std::string_view text);    ///< a person must act
void warning(std::string_view text);  ///< something degraded
void info(std::string_view text);     ///< start, stop, change of state, stairways that come and go
void debug(std::string_view text);    ///< once per sweep

/// A warning that may come often: said once, then at most every 10 s per `name`, with the number of times.
void repeated_warning(const std::string& name, std::string_view text);

}  // namespace stairway::daemon::log
