// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/stairway_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

namespace stairway::ipc {
namespace {

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

// Rounding before printing, so that no "-0.0" appears.
double tenths(double value) { return std::round(value * 10.0) / 10.0 + 0.0; }

std::string with_sigma(double value, double sigma) {
  return fmt::format("{:.1f} +-{:.1f}", tenths(value), tenths(sigma));
}

std::string_view railings(const detect::Stairway& stairway) {
  if (stairway.railing_left && stairway.railing_right) return "both";
  if (stairway.railing_left) return "left";
  return stairway.railing_right ? "right" : "none";
}

using Row = std::array<std::string, 11>;

const Row kTitles{"kind",        "direction",     "steps",      "height [mm]",       "depth [mm]", "width [mm]",
                  "pitch [deg]", "heading [deg]", "turn [deg]", "anchor x y z [mm]", "railing"};

Row row(const detect::Stairway& stairway) {
  const Eigen::Vector3d anchor_mm = 1e3 * stairway.anchor;
  return {std::string(to_string(stairway.kind)),
          std::string(to_string(stairway.direction)),
          std::to_string(stairway.nosings.size()),
          with_sigma(1e3 * stairway.step_height, 1e3 * stairway.step_height_sigma),
          with_sigma(1e3 * stairway.step_depth, 1e3 * stairway.step_depth_sigma),
          with_sigma(1e3 * stairway.width, 1e3 * stairway.width_sigma),
          fmt::format("{:.1f}", tenths(degrees(stairway.pitch()))),
          with_sigma(degrees(stairway.heading), degrees(stairway.heading_sigma)),
          fmt::format("{:.1f}", tenths(degrees(stairway.turn_per_step))),
          fmt::format("{:.0f} {:.0f} {:.0f} {}", std::round(anchor_mm.x()) + 0.0, std::round(anchor_mm.y()) + 0.0,
                      std::round(anchor_mm.z()) + 0.0, to_string(stairway.anchor_side)),
          std::string(railings(stairway))};
}

void append_table(std::string& out, const std::vector<Row>& rows) {
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  for (const Row& cells : rows) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) line += fmt::format("  {:<{}}", cells[i], widths[i]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
}

std::string list_of(const std::vector<detect::StepSize>& sizes, double detect::StepSize::*value,
                    double detect::StepSize::*sigma) {
  std::string out;
  for (const detect::StepSize& size : sizes)
    out += fmt::format("{}{}", out.empty() ? "" : ", ", with_sigma(1e3 * size.*value, 1e3 * size.*sigma));
  return out;
}

void append_steps(std::string& out, std::size_t number, const detect::Stairway& stairway) {
  using detect::StepSize;
  out += fmt::format("  stairway {} is irregular; its steps from below:\n", number);
  out +=
      fmt::format("    heights [mm]  {}\n", list_of(stairway.step_sizes, &StepSize::height, &StepSize::height_sigma));
  out += fmt::format("    depths [mm]   {}\n", list_of(stairway.step_sizes, &StepSize::depth, &StepSize::depth_sigma));
}

std::string durations(const Timings& timings) {
  std::string out;
  for (const auto& [stage, duration_ms] : timings) {
    out += fmt::format("{}{} {:.1f} ms", out.empty() ? "" : ", ", stage, duration_ms);
  }
  return out;
}

}  // namespace

std::string detection_text(std::string_view source, std::size_t points, const Timings& timings,
                           const detect::Detection& detection) {
  const std::size_t found = detection.stairways.size();
  std::string out = fmt::format("{}: {} points, {} stairway{}\n", source, points,
                                found == 0 ? "no" : std::to_string(found), found == 1 ? "" : "s");
  if (found > 0) {
    std::vector<Row> rows{kTitles};
    std::transform(detection.stairways.begin(), detection.stairways.end(), std::back_inserter(rows), row);
    append_table(out, rows);
  }
  for (std::size_t i = 0; i < found; ++i)
    if (detection.stairways[i].is_irregular) append_steps(out, i + 1, detection.stairways[i]);
  for (const detect::Rejection& rejection : detection.rejected) {
    out += fmt::format("  rejected: {} ({})\n", rejection.detail, rejection.reason);
  }
  if (!timings.empty()) out += fmt::format("  time: {}\n", durations(timings));
  return out;
}

}  // namespace stairway::ipc
