// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/baluster_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "detector/extents.hpp"
#include "detector/plane.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kCell_m = 0.03;        // of the ground plan
constexpr std::size_t kMinPerCell = 2;  // points over it; what noise throws about is thinner
constexpr double kKnee_m = 0.3;         // a baluster begins below this height above the nosings
constexpr double kHand_m = 0.6;         // and reaches this one
constexpr double kPiece_m = 0.06;       // it is made of pieces of this height,
constexpr double kMinPieceShare = 0.6;  // of which so many must show
constexpr double kRowWidth_m = 0.06;    // balusters of one row stand this near to its line

using Cell = std::pair<long, long>;
using Cluster = std::vector<Eigen::Vector3d>;

// Points over cells of the ground plan that touch each other.
std::vector<Cluster> upright_clusters(std::span<const Eigen::Vector3d> points) {
  std::map<Cell, Cluster> plan;
  for (const Eigen::Vector3d& p : points)
    plan[{std::lround(p.x() / kCell_m), std::lround(p.y() / kCell_m)}].push_back(p);
  std::erase_if(plan, [](const auto& cell) { return cell.second.size() < kMinPerCell; });

  std::vector<Cluster> clusters;
  while (!plan.empty()) {
    Cluster cluster;
    std::vector<Cell> open{plan.begin()->first};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      const auto found = plan.find({x, y});
      if (found == plan.end()) continue;
      cluster.insert(cluster.end(), found->second.begin(), found->second.end());
      plan.erase(found);
      for (long dx = -1; dx <= 1; ++dx)
        for (long dy = -1; dy <= 1; ++dy) open.emplace_back(x + dx, y + dy);
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

Interval extent(const Cluster& cluster, Eigen::Index axis) {
  const auto [low, high] =
      std::minmax_element(cluster.begin(), cluster.end(),
                          [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[axis] < b[axis]; });
  return {(*low)[axis], (*high)[axis]};
}

bool is_whole(const Cluster& cluster, const Interval& height) {
  std::vector<long> pieces;
  for (const Eigen::Vector3d& p : cluster) pieces.push_back(std::lround(p.z() / kPiece_m));
  std::sort(pieces.begin(), pieces.end());
  const auto distinct = std::unique(pieces.begin(), pieces.end()) - pieces.begin();
  return static_cast<double>(distinct) >= kMinPieceShare * height.length() / kPiece_m;
}

bool is_baluster(const Cluster& cluster, const RailingOptions& options) {
  const Interval height = extent(cluster, 2);
  if (height.low > kKnee_m || height.high < kHand_m || !is_whole(cluster, height)) return false;
  if (extent(cluster, 0).length() > options.max_thickness_m || extent(cluster, 1).length() > options.max_thickness_m)
    return false;
  PointMoments moments(cluster.front());
  for (const Eigen::Vector3d& p : cluster) moments.add(p.cast<float>());
  return std::abs(principal_axes(moments).axes(2, 0)) >= std::cos(options.max_baluster_angle_rad);
}

}  // namespace

std::optional<double> find_balusters(std::span<const Eigen::Vector3d> points, const RailingOptions& options) {
  Cluster low;  // a handrail would join all balusters
  for (const Eigen::Vector3d& p : points)
    if (p.z() < options.min_handrail_height_m &&
        std::abs(p.y()) <= options.max_side_distance_m + 0.5 * options.max_thickness_m)
      low.push_back(p);
  std::vector<double> sides;
  for (const Cluster& cluster : upright_clusters(low)) {
    const double side = extent(cluster, 1).middle();
    if (std::abs(side) <= options.max_side_distance_m && is_baluster(cluster, options)) sides.push_back(side);
  }
  if (sides.empty()) return std::nullopt;
  const double row = median(sides);
  const auto in_row =
      std::count_if(sides.begin(), sides.end(), [&](double side) { return std::abs(side - row) <= kRowWidth_m; });
  return in_row < options.min_balusters ? std::nullopt : std::optional(row);
}

}  // namespace stairway::detect
