// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "detector/extents.hpp"
#include "detector/sight_edge.hpp"
#include "detector/step_measurement.hpp"
#include "detector/step_reaches.hpp"
#include "detector/step_view.hpp"

namespace stairway::detect {

/// A place and the v at which it was found.
struct EdgePlace {
  double v = 0.0;
  double place = 0.0;
};

/// Strips of crossings side by side, each of which shows the same edge.
class EdgeStrips {
 public:
  EdgeStrips(const Interval& range, double strip_m)
      : range_(range), strips_(static_cast<std::size_t>(std::max(1.0, range.length() / strip_m))) {}

  void add(double position, const Crossing& crossing) {
    const double strip = (position - range_.low) / range_.length() * static_cast<double>(strips_.size());
    if (strip >= 0.0 && strip < static_cast<double>(strips_.size()))
      strips_[static_cast<std::size_t>(strip)].push_back(crossing);
  }

  std::vector<std::vector<Crossing>>& strips() { return strips_; }

  /// What the edge at `place` may be off by because no line of sight passes nearer: where beams cross all strips alike,
  /// all tell the same two places that the edge lies between.
  double gap_sigma(double place) const {
    double before = -kEdgeReach_m;
    double beyond = kEdgeReach_m;
    for (const std::vector<Crossing>& strip : strips_) {
      for (const Crossing& crossing : strip) {
        const double off = crossing.place - place;
        if (off < 0.0) {
          before = std::max(before, off);
        } else {
          beyond = std::min(beyond, off);
        }
      }
    }
    return (beyond - before) / std::sqrt(12.0);
  }

  /// The edge that all strips tell together, closer than each alone: they cut it at different places.
  std::optional<Estimate> edge() const {
    std::vector<Crossing> all;
    for (const std::vector<Crossing>& strip : strips_) all.insert(all.end(), strip.begin(), strip.end());
    const std::optional<SightEdge> edge = edge_between(all);
    if (!edge) return std::nullopt;
    return Estimate{edge->place, edge->sigma};
  }

  std::vector<EdgePlace> edges() {
    std::vector<EdgePlace> found;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      const double middle =
          range_.low + (static_cast<double>(i) + 0.5) / static_cast<double>(strips_.size()) * range_.length();
      if (const std::optional<SightEdge> edge = edge_between(strips_[i])) found.push_back({middle, edge->place});
    }
    return found;
  }

 private:
  Interval range_;
  std::vector<std::vector<Crossing>> strips_;
};

/// The place that most strips agree on; nothing for fewer than three. @param floor  of its sigma [m].
std::optional<Estimate> common_place(const std::vector<EdgePlace>& edges, double floor);

}  // namespace stairway::detect
