// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ipc/bus.hpp"
#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"
#include "tools/stairway/report.hpp"

namespace stairway::tools {

/// Tells a person, or a program, what the messages of stairwayd say. Text: stairways on stdout, the daemon's state on
/// stderr; of the previews of a sweep those that show one that was not told yet. JSON: both on stdout, all of them,
/// each with the channel that it came on.
class DaemonNews {
 public:
  /// @param truth  printed below every answer, with the differences.
  DaemonNews(ipc::Channels channels, Format format, std::optional<std::vector<detect::Stairway>> truth);

  /// Messages that cannot be decoded are counted; the first of each kind is told.
  void take(const ipc::BusMessage& message);

  bool has_answer() const { return answers_ > 0; }      ///< a stairways message came
  bool has_stairway() const { return stairways_ > 0; }  ///< and one of them had a stairway

  /// Tells how many messages could not be decoded, if any.
  void report_damage();

 private:
  void take_answer(const ipc::StairwaysMessage& message);
  bool is_news(const ipc::StairwaysMessage& message);
  void take_health(const ipc::HealthMessage& message);
  void count_damage(std::string_view channel, ipc::MessageFault fault);
  void tell(const std::string& event);

  ipc::Channels channels_;
  Format format_;
  std::optional<std::vector<detect::Stairway>> truth_;
  StatusLine status_;
  std::optional<ipc::HealthMessage> health_;
  std::set<std::int64_t> told_tracks_;  // by the last answer and the previews since then
  std::int64_t answers_ = 0;
  std::int64_t stairways_ = 0;
  std::int64_t damaged_ = 0;
  std::vector<ipc::MessageFault> told_faults_;
};

/// The time of day of an instant, e.g. 14:03:12.
std::string local_time(std::int64_t utime_us);

/// One answer of the daemon as a JSON object on one line: when, which sweep, and the stairways and rejections in the
/// form of `stairway detect`, every stairway with its `track_id`.
std::string answer_json(const ipc::StairwaysMessage& message);

/// The daemon's state in one line, with a bar for the sweep.
std::string health_text(const ipc::HealthMessage& health);

}  // namespace stairway::tools
