// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "ipc/bus.hpp"
#include "ipc/channels.hpp"
#include "tools/stairway/full_screen.hpp"
#include "tools/stairway/monitor_screen.hpp"

namespace stairway::tools {

/// Keeps the whole terminal showing the state of one daemon.
class LiveView {
 public:
  LiveView(ipc::Channels channels, std::string place);

  void take(const ipc::BusMessage& message);
  /// Shown until messages come again.
  void tell(const std::string& trouble);
  /// Draws what is new: call it some times a second.
  void refresh();
  bool has_answer() const { return view_.answer.has_value(); }  ///< a stairways message came
  /// Whether the person wants to leave.
  bool is_left() { return screen_.is_left(); }

 private:
  using Clock = std::chrono::steady_clock;

  const ipc::Channels channels_;
  MonitorView view_;
  Clock::time_point health_came_;
  Clock::time_point answer_came_;
  Clock::time_point next_drawing_;
  bool is_news_ = true;
  FullScreen screen_;
};

}  // namespace stairway::tools
