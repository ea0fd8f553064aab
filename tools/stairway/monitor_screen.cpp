// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/monitor_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "tools/stairway/screen_text.hpp"

namespace stairway::tools {
namespace {

using Style = ScreenLine::Style;
using Lines = std::vector<ScreenLine>;

constexpr double kSilence_s = 3.0;
constexpr std::size_t kShownStairways = 4;
constexpr std::size_t kContinuations = 2;
constexpr std::size_t kNoteLines = 6;
constexpr std::size_t kColumn = 38;  // of the two beside each other
// What every sweep has; troubles and losses are shown before it.
constexpr std::array<std::string_view, 7> kUsualCounts{"no-return",     "too-near", "disturbed",    "invalid",
                                                       "out-of-limits", "no-angle", "angle-invalid"};

std::string age(double age_s) { return age_s < 0.0 ? "-" : fmt::format("{:.{}f} s", age_s, age_s < 10.0 ? 1 : 0); }

std::string milliseconds(double duration_ms) {
  return fmt::format("{:.{}f}", duration_ms, duration_ms < 10.0 ? 2 : duration_ms < 100.0 ? 1 : 0);
}

std::string bar(double share, std::size_t width) {
  const double known = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  const auto done = static_cast<std::size_t>(std::lround(known * static_cast<double>(width)));
  return fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", done, "", width - done, 100.0 * known);
}

// The lines of the devices say more when several are unwell.
std::string state_text(const ipc::HealthMessage& health) {
  return health.reasons.size() > 1 ? fmt::format("{}", fmt::join(health.reasons, ", ")) : health.state;
}

double tidy(double value_m) { return std::round(100.0 * value_m) / 100.0 + 0.0; }  // -0.00 is 0.00

Lines heading_lines(const MonitorView& view, std::size_t columns) {
  if (!view.health) {
    Lines lines{{beside("stairwayd: nothing heard yet", view.time, columns), Style::Alert},
                {"listening to " + view.place}};
    for (std::string& part : wrapped(view.note, columns, kNoteLines)) lines.push_back({std::move(part)});
    return lines;
  }
  const ipc::HealthMessage& health = *view.health;
  const bool is_silent = view.health_age_s > kSilence_s;
  const std::string state =
      is_silent ? fmt::format("SILENT for {}; it said: {}", age(view.health_age_s), health.state) : state_text(health);
  Lines lines{{beside("stairwayd: " + state, view.time, columns),
               is_silent || !health.reasons.empty() ? Style::Alert : Style::Heading}};
  lines.push_back(
      {fmt::format("sweep {}  {}  {} points", health.sweep, bar(health.sweep_progress, 20), health.points)});
  const ipc::ResultHealth& result = health.result;
  if (result.sweep >= 0) {
    lines.push_back({fmt::format("last sweep: {}, {} points, {} ago{}{}", result.sweep, result.sweep_points,
                                 age(result.sweep_age_s), result.sweep_flaws.empty() ? "" : "; ", result.sweep_flaws)});
  } else {
    lines.push_back({"last sweep: none yet"});
  }
  return lines;
}

Lines device_lines(const ipc::HealthMessage& health, std::size_t columns) {
  constexpr std::size_t kName = 11, kFigures = 30;
  const std::size_t room = columns > kName + kFigures + 10 ? columns - kName - kFigures : 10;
  const auto row = [&](std::string_view name, std::string_view state, std::string_view rate, std::string_view since,
                       std::string_view troubles) {
    return fmt::format("{} {} {:>9} {:>8} {:>9}", padded(name, kName), padded(state, room - 1), rate, since, troubles);
  };
  Lines lines{{row("device", "state", "rate", "age", "troubles"), Style::Heading}};
  for (const ipc::DeviceHealth& device : health.devices) {
    const auto parts = wrapped(device.state, room - 1, device.is_ok ? 1 : 1 + kContinuations);
    const bool has_data = device.data_age_s >= 0.0;
    const Style style = device.is_ok ? Style::Plain : Style::Alert;
    lines.push_back({row(device.name, parts.front(), has_data ? fmt::format("{:.1f} /s", device.rate_hz) : "-",
                         age(device.data_age_s), std::to_string(device.troubles)),
                     style});
    for (std::size_t i = 1; i < parts.size(); ++i) lines.push_back({std::string(kName + 1, ' ') + parts[i], style});
  }
  return lines;
}

Lines clock_lines(const ipc::ClockHealth& clock) {
  if (!(clock.period_ms > 0.0)) return {{"clock: no scans yet"}};
  const std::string bound = clock.bound_ms < 0.0 ? "not known" : fmt::format("{:.2f} ms", clock.bound_ms);
  const std::string round_trip = clock.round_trip_ms > 0.0 ? fmt::format("{:.2f} ms", clock.round_trip_ms) : "none";
  return {{fmt::format("clock: {}  latency {:.1f} ms  round trip {}  bound {}", to_string(clock.source),
                       clock.latency_ms, round_trip, bound)},
          {fmt::format("  period {:.3f} ms  drift {:+.1f} ppm  late {:.2f} ms  residual {:.2f} ms  resets {}",
                       clock.period_ms, clock.drift_ppm, clock.delay_ms, clock.residual_ms, clock.resets)}};
}

// The longest, in their order.
std::vector<ipc::StageHealth> longest(std::vector<ipc::StageHealth> stages, std::size_t number) {
  while (stages.size() > number) stages.erase(std::ranges::min_element(stages, {}, &ipc::StageHealth::p95_ms));
  return stages;
}

Lines stage_lines(const ipc::HealthMessage& health, std::size_t rows) {
  if (rows < 2 || health.stages.empty()) return {};
  Lines lines{{fmt::format("{:<16} {:>9} {:>9}", "stage", "p50 ms", "p95 ms"), Style::Heading}};
  for (const ipc::StageHealth& stage : longest(health.stages, rows - 1))
    lines.push_back({fmt::format("{} {:>9} {:>9}", padded(stage.name, 16), milliseconds(stage.p50_ms),
                                 milliseconds(stage.p95_ms))});
  return lines;
}

Lines count_lines(const ipc::HealthMessage& health, std::size_t rows) {
  if (rows < 2 || health.drops.empty()) return {};
  auto counts = health.drops;
  std::ranges::stable_partition(
      counts, [](const auto& entry) { return std::ranges::find(kUsualCounts, entry.first) == kUsualCounts.end(); });
  Lines lines{{fmt::format("{:<26} {:>10}", "dropped or wrong", "number"), Style::Heading}};
  for (std::size_t i = 0; i < std::min(counts.size(), rows - 1); ++i)
    lines.push_back({fmt::format("{} {:>10}", padded(counts[i].first, 26), counts[i].second)});
  return lines;
}

Lines stairway_lines(const MonitorView& view) {
  if (!view.answer) {
    const int last = view.health ? view.health->result.stairways : -1;
    const std::string text =
        last < 0 ? "no answer yet" : fmt::format("{} in the last answer; waiting for the next", last);
    return {{"stairways: " + text, Style::Heading}};
  }
  const ipc::StairwaysMessage& answer = *view.answer;
  const auto& stairways = answer.detection.stairways;
  const std::string when =
      fmt::format("of sweep {}{}, {} ago", answer.sweep, answer.is_final ? "" : " (preview)", age(view.answer_age_s));
  if (stairways.empty()) {
    const auto& rejected = answer.detection.rejected;
    return {{"stairways " + when + ": none", Style::Heading},
            {"  " + (rejected.empty() ? "no candidate" : rejected.front().reason + ": " + rejected.front().detail)}};
  }
  Lines lines{{"stairways " + when, Style::Heading},
              {fmt::format("{:>3} {:<8} {:<4} {:>5} {:>8} {:>8} {:>7} {:>8}  {}", "id", "kind", "way", "steps",
                           "high mm", "deep mm", "wide m", "head deg", "anchor m")}};
  for (std::size_t i = 0; i < std::min(stairways.size(), kShownStairways); ++i) {
    const detect::Stairway& s = stairways[i];
    lines.push_back({fmt::format("{:>3} {:<8} {:<4} {:>5} {:>8.1f} {:>8.1f} {:>7.2f} {:>8.1f}  {:.2f} {:.2f} {:.2f}",
                                 i < answer.track_ids.size() ? answer.track_ids[i] : 0, to_string(s.kind),
                                 s.direction == detect::StairwayDirection::Ascending ? "up" : "down", s.nosings.size(),
                                 1e3 * s.step_height, 1e3 * s.step_depth, s.width, s.heading * 180.0 / std::numbers::pi,
                                 tidy(s.anchor.x()), tidy(s.anchor.y()), tidy(s.anchor.z()))});
  }
  if (stairways.size() > kShownStairways)
    lines.push_back({fmt::format("  and {} more", stairways.size() - kShownStairways)});
  return lines;
}

/// Two blocks beside each other where there is room, else one below the other.
Lines work_lines(const ipc::HealthMessage& health, std::size_t columns, std::size_t rows) {
  if (columns < 2 * kColumn) {
    Lines lines = stage_lines(health, (rows + 1) / 2);
    const Lines counts = count_lines(health, rows - lines.size());
    lines.insert(lines.end(), counts.begin(), counts.end());
    return lines;
  }
  const Lines left = stage_lines(health, rows), right = count_lines(health, rows);
  Lines lines;
  for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
    const std::string text = i < left.size() ? left[i].text : "";
    lines.push_back(
        {padded(text, kColumn + 2) + (i < right.size() ? right[i].text : ""), i == 0 ? Style::Heading : Style::Plain});
  }
  return lines;
}

void append(Lines& page, const Lines& block) {
  if (block.empty()) return;
  if (!page.empty()) page.push_back({""});
  page.insert(page.end(), block.begin(), block.end());
}

}  // namespace

std::vector<ScreenLine> monitor_lines(const MonitorView& view, std::size_t columns, std::size_t rows) {
  Lines page = heading_lines(view, columns);
  if (view.health) {
    const Lines stairways = stairway_lines(view), clock = clock_lines(view.health->clock);
    append(page, device_lines(*view.health, columns));
    const auto left = [&](std::size_t used) { return rows > used ? rows - used : 0; };
    const std::size_t with_stairways = page.size() + 1 + stairways.size();
    if (left(with_stairways) > clock.size()) append(page, clock);
    const std::size_t room = left(page.size() + 1 + stairways.size());
    if (room > 2) append(page, work_lines(*view.health, columns, room - 1));
    append(page, stairways);
    if (!view.note.empty()) page.back() = {view.note, Style::Alert};
  }
  if (page.size() > rows) page.resize(rows);
  for (ScreenLine& line : page) line.text = clipped(line.text, columns);
  return page;
}

}  // namespace stairway::tools
