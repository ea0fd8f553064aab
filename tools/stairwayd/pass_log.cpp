// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/pass_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <utility>

#include "tools/stairwayd/log.hpp"

namespace stairway::daemon {
namespace {

std::string describe(const detect::Stairway& stairway) {
  return fmt::format(
      "{} {}, {} steps, height {:.1f} mm, depth {:.1f} mm, width {:.0f} mm, heading {:.1f} deg, anchor ({:.3f}, "
      "{:.3f}, {:.3f}) m",
      to_string(stairway.direction), to_string(stairway.kind), stairway.nosings.size(), 1e3 * stairway.step_height,
      1e3 * stairway.step_depth, 1e3 * stairway.width, stairway.heading * 180.0 / std::numbers::pi, stairway.anchor.x(),
      stairway.anchor.y(), stairway.anchor.z());
}

std::string describe(const ipc::Timings& timings) {
  std::string text;
  for (const auto& [name, duration_ms] : timings)
    text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", name, duration_ms);
  return text;
}

std::string describe(const std::vector<detect::Rejection>& rejected) {
  return rejected.empty() ? "no candidate" : fmt::format("{}: {}", rejected.front().reason, rejected.front().detail);
}

}  // namespace

void PassLog::add(const Pass& pass) {
  pass.is_preview ? add_preview(pass) : add_answer(pass);
  const ipc::StairwaysMessage& message = pass.message;
  const double age_s = 1e-6 * static_cast<double>(message.utime_us - message.sweep_start_utime_us);
  log::debug(fmt::format("sweep {}{}: {} points, {} stairways; {} ms", message.sweep,
                         pass.is_preview ? fmt::format(" after {:.1f} s", age_s) : "", pass.points,
                         message.detection.stairways.size(), describe(pass.timings)));
  if (!pass.is_preview && !pass.flaws.empty())
    log::debug(fmt::format("sweep {}: {}", message.sweep, fmt::join(pass.flaws, "; ")));
}

void PassLog::add_preview(const Pass& pass) {
  const ipc::StairwaysMessage& message = pass.message;
  for (std::size_t i = 0; i < message.detection.stairways.size(); ++i) {
    const std::int64_t id = message.track_ids[i];
    if (seen_.contains(id) || !previewed_.insert(id).second) continue;
    log::info(fmt::format("stairway {} comes into sight: {}", id, describe(message.detection.stairways[i])));
  }
}

void PassLog::add_answer(const Pass& pass) {
  const ipc::StairwaysMessage& message = pass.message;
  const detect::Detection& detection = message.detection;
  std::set<std::int64_t> seen;
  for (std::size_t i = 0; i < detection.stairways.size(); ++i) {
    const std::int64_t id = message.track_ids[i];
    if (!seen_.contains(id)) log::info(fmt::format("stairway {}: {}", id, describe(detection.stairways[i])));
    seen.insert(id);
  }
  previewed_.insert(seen_.begin(), seen_.end());
  for (const std::int64_t id : previewed_) {
    if (!seen.contains(id)) log::info(fmt::format("stairway {} is no longer seen", id));
  }
  const bool is_news = is_first_ || !previewed_.empty();
  if (seen.empty() && is_news)
    log::info(fmt::format("no stairway in sweep {}; {}", message.sweep, describe(detection.rejected)));
  previewed_.clear();
  seen_ = std::move(seen);
  is_first_ = false;
}

}  // namespace stairway::daemon
