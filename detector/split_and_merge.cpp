// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/split_and_merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "detector/cell_groups.hpp"

namespace stairway::detect {
namespace {

using Cell = std::array<std::int64_t, 3>;

// A cell whose points lie in a plane.
struct Leaf {
  Cell cell;
  int level;  // its edge is the smallest one, doubled so many times
  std::vector<std::uint32_t> points;
  PointMoments moments;
  PrincipalAxes axes;
};

// Cells of one size that became leaves, for finding them by their place.
class LeafRows {
 public:
  // Leaves must be added by rising place: z, then y, then x.
  void add(const Cell& cell, std::uint32_t leaf) { leaves_.push_back({key(cell), leaf}); }

  template <class Visit>
  void within(const Cell& low, const Cell& high, Visit visit) const {
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        const std::int64_t last = key({high[0], y, z});
        auto place = std::lower_bound(leaves_.begin(), leaves_.end(), key({low[0], y, z}),
                                      [](const auto& leaf, std::int64_t wanted) { return leaf.first < wanted; });
        for (; place != leaves_.end() && place->first <= last; ++place) visit(place->second);
      }
    }
  }

 private:
  static std::int64_t key(const Cell& cell) { return (cell[2] << 42) + (cell[1] << 21) + cell[0]; }

  std::vector<std::pair<std::int64_t, std::uint32_t>> leaves_;
};

bool all_comply(std::span<const Eigen::Vector3f> points, const Leaf& leaf, double max_distance_m) {
  const Eigen::Vector3f center = leaf.axes.centroid.cast<float>();
  const Eigen::Vector3f normal = leaf.axes.normal().cast<float>();
  const auto limit = static_cast<float>(max_distance_m);
  return std::ranges::all_of(leaf.points, [&](std::uint32_t point) {
    return std::abs((points[point] - center).dot(normal)) < limit;  // eq 1
  });
}

class Splitter {
 public:
  Splitter(std::span<const Eigen::Vector3f> points, const SplitAndMergeOptions& options)
      : points_(points), options_(options), left_(points.size()) {
    for (std::size_t i = 0; i < left_.size(); ++i) left_[i] = static_cast<std::uint32_t>(i);
  }

  // The leaves of one size; their points are taken away from the cloud.
  std::vector<Leaf> split(int level) {
    const double leaf_m = std::ldexp(options_.min_leaf_m, level);
    places_.clear();
    for (const std::uint32_t point : left_) places_.push_back(points_[point]);
    const CellGroups cells = group_by_cell(places_, leaf_m);
    std::vector<Leaf> leaves;
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Leaf leaf = make_leaf(cells[i], leaf_m, level);
      const bool is_plane = leaf.points.size() >= static_cast<std::size_t>(options_.min_leaf_points) &&
                            all_comply(points_, leaf, options_.max_leaf_distance_m);
      if (is_plane) {
        leaves.push_back(std::move(leaf));
      } else {
        rest.insert(rest.end(), leaf.points.begin(), leaf.points.end());
      }
    }
    left_ = std::move(rest);
    return leaves;
  }

 private:
  Leaf make_leaf(std::span<const std::uint32_t> members, double leaf_m, int level) const {
    const Eigen::Vector3f& one = places_[members.front()];
    Leaf leaf{.cell = {}, .level = level, .points = {}, .moments = PointMoments(one.cast<double>()), .axes = {}};
    for (int axis = 0; axis < 3; ++axis)
      leaf.cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(one[axis] / leaf_m));
    leaf.points.reserve(members.size());
    for (const std::uint32_t member : members) {
      leaf.points.push_back(left_[member]);
      leaf.moments.add(places_[member]);
    }
    leaf.axes = principal_axes(leaf.moments);
    return leaf;
  }

  std::span<const Eigen::Vector3f> points_;
  const SplitAndMergeOptions& options_;
  std::vector<std::uint32_t> left_;
  std::vector<Eigen::Vector3f> places_;  // of the points that are left
};

class Merger {
 public:
  Merger(std::vector<Leaf> leaves, int levels, const SplitAndMergeOptions& options)
      : leaves_(std::move(leaves)),
        options_(options),
        min_cosine_(std::cos(options.max_normal_angle_rad)),
        rows_(static_cast<std::size_t>(levels)),
        state_(leaves_.size(), State::Free) {
    for (std::size_t i = 0; i < leaves_.size(); ++i)
      rows_[static_cast<std::size_t>(leaves_[i].level)].add(leaves_[i].cell, static_cast<std::uint32_t>(i));
  }

  // Large leaves before small ones, flat ones before bent ones.
  std::vector<std::uint32_t> seeds() const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::size_t i = 0; i < leaves_.size(); ++i)
      order.emplace_back(leaves_[i].axes.surface_variation() - leaves_[i].level, static_cast<std::uint32_t>(i));
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> seeds;
    for (const auto& [rank, leaf] : order) seeds.push_back(leaf);
    return seeds;
  }

  bool is_free(std::uint32_t leaf) const { return state_[leaf] == State::Free; }

  /// Indices of the points of all leaves that merge with `seed`.
  std::vector<std::uint32_t> merge(std::uint32_t seed) {
    std::vector<std::uint32_t> points;
    moments_ = PointMoments(leaves_[seed].axes.centroid);
    waiting_.assign(1, seed);
    for (std::size_t next = 0; next < waiting_.size(); ++next) {
      const std::uint32_t candidate = waiting_[next];
      const Leaf& leaf = leaves_[candidate];
      // A refused leaf may be offered again by another one, and the plane may suit it better then.
      state_[candidate] = State::Free;
      if (next > 0 && !complies(leaf)) continue;
      state_[candidate] = State::Merged;
      points.insert(points.end(), leaf.points.begin(), leaf.points.end());
      moments_.add(leaf.moments);
      plane_ = principal_axes(moments_);
      list_adjacent(leaf);
    }
    return points;
  }

 private:
  enum class State : std::uint8_t { Free, Waiting, Merged };

  bool complies(const Leaf& leaf) const {
    return std::abs(leaf.axes.normal().dot(plane_.normal())) > min_cosine_ &&
           std::abs((leaf.axes.centroid - plane_.centroid).dot(plane_.normal())) < options_.max_plane_distance_m;
  }

  void list_adjacent(const Leaf& leaf) {
    for (std::size_t level = 0; level < rows_.size(); ++level) {
      Cell low, high;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // In cells of the smallest size, one of them wider on each side; the shift rounds down.
        low[axis] = ((leaf.cell[axis] << leaf.level) - 1) >> level;
        high[axis] = ((leaf.cell[axis] + 1) << leaf.level) >> level;
      }
      rows_[level].within(low, high, [&](std::uint32_t other) {
        if (state_[other] != State::Free) return;
        state_[other] = State::Waiting;
        waiting_.push_back(other);
      });
    }
  }

  std::vector<Leaf> leaves_;
  const SplitAndMergeOptions& options_;
  double min_cosine_;
  std::vector<LeafRows> rows_;  // by level
  std::vector<State> state_;
  std::vector<std::uint32_t> waiting_;
  PointMoments moments_;
  PrincipalAxes plane_;
};

}  // namespace

std::string SplitAndMergeOptions::problem() const {
  if (!(min_leaf_m > 0.0)) return "split_and_merge.min_leaf_m must be greater than 0";
  if (!(max_leaf_m >= min_leaf_m && max_leaf_m <= 1000.0 * min_leaf_m))
    return "split_and_merge.max_leaf_m must lie between min_leaf_m and 1000 times that";
  if (min_leaf_points < 3) return "split_and_merge.min_leaf_points must be at least 3";
  if (!(max_leaf_distance_m > 0.0)) return "split_and_merge.max_leaf_distance_m must be greater than 0";
  if (!(max_normal_angle_rad > 0.0 && max_normal_angle_rad < std::numbers::pi / 2))
    return "split_and_merge.max_normal_angle must lie between 0 and 90 degrees";
  if (!(max_plane_distance_m > 0.0)) return "split_and_merge.max_plane_distance_m must be greater than 0";
  if (min_points < 3) return "split_and_merge.min_points must be at least 3";
  return {};
}

std::vector<PlaneRegion> split_and_merge(const scan::PointCloud& cloud, const SplitAndMergeOptions& options) {
  Splitter splitter(cloud.points, options);
  const int levels = 1 + static_cast<int>(std::log2(options.max_leaf_m / options.min_leaf_m) + 1e-9);
  std::vector<Leaf> leaves;
  for (int level = levels - 1; level >= 0; --level)
    std::ranges::move(splitter.split(level), std::back_inserter(leaves));

  Merger merger(std::move(leaves), levels, options);
  std::vector<PlaneRegion> regions;
  for (const std::uint32_t seed : merger.seeds()) {
    if (!merger.is_free(seed)) continue;
    std::vector<std::uint32_t> points = merger.merge(seed);
    if (points.size() > static_cast<std::size_t>(options.min_points))
      regions.push_back(make_region(cloud, std::move(points)));
  }
  return regions;
}

}  // namespace stairway::detect
