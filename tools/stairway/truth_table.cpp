// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/truth_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/common/stairway_match.hpp"

namespace stairway::tools {
namespace {

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

/// What the table compares; lengths in mm, angles in degrees.
struct Figures {
  double steps, height, depth, width, heading, turn;
  Eigen::Vector3d anchor;
  detect::AnchorSide side;
};

Figures figures(const detect::Stairway& s) {
  return {static_cast<double>(s.nosings.size()),
          1e3 * s.step_height,
          1e3 * s.step_depth,
          1e3 * s.width,
          degrees(s.heading),
          degrees(s.turn_per_step),
          1e3 * s.anchor,
          s.anchor_side};
}

Figures difference(const Figures& found, const Figures& truth) {
  return {found.steps - truth.steps,
          found.height - truth.height,
          found.depth - truth.depth,
          found.width - truth.width,
          std::remainder(found.heading - truth.heading, 360.0),
          found.turn - truth.turn,
          found.anchor - truth.anchor,
          found.side};
}

constexpr const char* kTitles = "  {:<12}{:>6}{:>13}{:>12}{:>12}{:>15}{:>12}   {}\n";
constexpr const char* kRow = "  {:<12}{:>6.0f}{:>13.1f}{:>12.1f}{:>12.1f}{:>15.2f}{:>12.2f}";
constexpr const char* kSignedRow = "  {:<12}{:>+6.0f}{:>+13.1f}{:>+12.1f}{:>+12.1f}{:>+15.2f}{:>+12.2f}";

std::string cells(const char* format, const char* title, const Figures& f) {
  return fmt::format(fmt::runtime(format), title, f.steps, f.height, f.depth, f.width, f.heading, f.turn);
}

std::string row(const char* title, const Figures& f) {
  return cells(kRow, title, f) +
         fmt::format("   {:.0f} {:.0f} {:.0f} {}\n", f.anchor.x(), f.anchor.y(), f.anchor.z(), to_string(f.side));
}

std::string difference_row(const Figures& found, const Figures& truth) {
  const Figures f = difference(found, truth);
  const std::string anchor = found.side == truth.side
                                 ? fmt::format("{:+.0f} {:+.0f} {:+.0f}", f.anchor.x(), f.anchor.y(), f.anchor.z())
                                 : "on another side";
  return cells(kSignedRow, "difference", f) + "   " + anchor + '\n';
}

}  // namespace

std::string truth_text(const std::vector<detect::Stairway>& truth, const std::vector<detect::Stairway>& found) {
  if (truth.empty()) return fmt::format("  truth: no stairway; {} found\n", found.size());
  const auto pairs = match(truth, found);
  std::string out = fmt::format(fmt::runtime(kTitles), "", "steps", "height [mm]", "depth [mm]", "width [mm]",
                                "heading [deg]", "turn [deg]", "anchor x y z [mm]");
  for (std::size_t t = 0; t < truth.size(); ++t) {
    const Figures expected = figures(truth[t]);
    out += row("truth", expected);
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [t](const auto& p) { return p.first == t; });
    if (pair == pairs.end()) {
      out += "  not found\n";
      continue;
    }
    const Figures measured = figures(found[pair->second]);
    out += row("found", measured) + difference_row(measured, expected);
  }
  if (const std::size_t more = found.size() - pairs.size(); more > 0)
    out += fmt::format("  {} found that the truth does not know\n", more);
  return out;
}

}  // namespace stairway::tools
