// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ipc/messages.hpp"

namespace stairway::tools {

/// What `stairway monitor` knows of a daemon.
struct MonitorView {
  std::string place;  ///< where it listens, e.g. the URL
  std::string time;   ///< of day, for a person
  std::optional<ipc::HealthMessage> health;
  double health_age_s = 0.0;  ///< since it came
  std::optional<ipc::StairwaysMessage> answer;
  double answer_age_s = 0.0;
  std::string note;  ///< what went wrong with listening; empty when nothing
};

struct ScreenLine {
  enum class Style { Plain, Heading, Alert };
  std::string text;
  Style style = Style::Plain;
};

/// The daemon's state as a page of at most `rows` lines of at most `columns` characters. What does not fit is left out,
/// the least important first: stages and counts, then the clock. Control characters in the messages become spaces.
std::vector<ScreenLine> monitor_lines(const MonitorView& view, std::size_t columns, std::size_t rows);

}  // namespace stairway::tools
