// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/region_growing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "detector/neighbour_blocks.hpp"

namespace stairway::detect {
namespace {

constexpr std::uint8_t kFree = 0;
constexpr std::uint8_t kListed = 1;  // waits in the comparison list of the region that grows now
constexpr std::uint8_t kAssigned = 2;
constexpr std::uint32_t kNobody = ~std::uint32_t{0};

class RegionGrower {
 public:
  RegionGrower(const scan::PointCloud& cloud, const SurfaceNormals& surface, std::span<const std::uint32_t> weights,
               const RegionGrowingOptions& options)
      : cloud_(cloud),
        surface_(surface),
        weights_(weights),
        blocks_(cloud.points, static_cast<std::size_t>(options.num_neighbours)),
        listed_for_(blocks_.size(), kNobody),
        min_cosine_(static_cast<float>(std::cos(options.max_normal_angle_rad))),
        max_distance_(static_cast<float>(options.max_plane_distance_m)),
        state_(cloud.points.size(), kFree) {}

  std::uint64_t weight() const { return weight_; }
  bool is_free(std::uint32_t point) const { return state_[point] == kFree; }

  /// Alg. 1, function REGION GROWING; the result stays valid until the next call.
  const std::vector<std::uint32_t>& grow(std::uint32_t seed) {
    region_.clear();
    weight_ = 0;
    comparison_list_.clear();
    center_ = cloud_.points[seed];
    normal_sum_ = Eigen::Vector3f::Zero();
    normal_ = surface_.normals[seed];
    accept(seed);
    for (std::size_t next = 0; next < comparison_list_.size(); ++next) {
      const std::uint32_t point = comparison_list_[next];
      // A refused point is free again: the region may come back to it with a better plane.
      state_[point] = kFree;
      if (complies(point)) accept(point);
    }
    return region_;
  }

 private:
  bool complies(std::uint32_t point) const {
    const float plane_distance = (center_ - cloud_.points[point]).dot(normal_);  // eq 1
    return std::abs(plane_distance) < max_distance_ && std::abs(surface_.normals[point].dot(normal_)) > min_cosine_;
  }

  void accept(std::uint32_t point) {
    state_[point] = kAssigned;
    region_.push_back(point);
    weight_ += weights_[point];
    const auto weight = static_cast<float>(weights_[point]);
    center_ += (cloud_.points[point] - center_) * (weight / static_cast<float>(weight_));
    const Eigen::Vector3f& normal = surface_.normals[point];
    normal_sum_ += normal.dot(normal_) < 0.0F ? Eigen::Vector3f(-weight * normal) : Eigen::Vector3f(weight * normal);
    normal_ = normal_sum_.normalized();

    const std::uint32_t block = blocks_.block_of(point);
    if (std::exchange(listed_for_[block], region_.front()) == region_.front()) return;
    blocks_.for_each_point(block, [&](std::uint32_t neighbour) {
      if (state_[neighbour] != kFree) return;
      state_[neighbour] = kListed;
      comparison_list_.push_back(neighbour);
    });
  }

  const scan::PointCloud& cloud_;
  const SurfaceNormals& surface_;
  std::span<const std::uint32_t> weights_;
  const NeighbourBlocks blocks_;
  std::vector<std::uint32_t> listed_for_;  // the seed of the region that listed the points of a block last
  const float min_cosine_;
  const float max_distance_;

  std::vector<std::uint8_t> state_;
  std::vector<std::uint32_t> region_;
  std::uint64_t weight_ = 0;  // of its points
  std::vector<std::uint32_t> comparison_list_;
  Eigen::Vector3f center_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_sum_ = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f normal_ = Eigen::Vector3f::UnitZ();
};

// The flatness of what stands for many points is the surer one.
std::vector<std::uint32_t> flattest_first(const std::vector<float>& variations,
                                          std::span<const std::uint32_t> weights) {
  constexpr float kFlattest = 1e-6F;  // smaller differences are those of rounding
  // Floats that are not negative are ordered like their bits.
  std::vector<std::uint64_t> keys(variations.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const float doubt = std::max(variations[i], kFlattest) / static_cast<float>(weights[i]);
    keys[i] = std::uint64_t{std::bit_cast<std::uint32_t>(doubt)} << 32 | i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  return order;
}

}  // namespace

std::string RegionGrowingOptions::problem() const {
  if (num_neighbours < 3) return "num_neighbours must be at least 3";
  if (!(max_normal_angle_rad > 0.0 && max_normal_angle_rad < std::numbers::pi / 2))
    return "max_normal_angle must lie between 0 and 90 degrees";
  if (!(max_plane_distance_m > 0.0)) return "max_plane_distance_m must be greater than 0";
  if (min_points < 3) return "min_points must be at least 3";
  return {};
}

std::vector<std::vector<std::uint32_t>> grow_point_sets(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                                        std::span<const std::uint32_t> weights,
                                                        const RegionGrowingOptions& options) {
  RegionGrower grower(cloud, surface, weights, options);
  std::vector<std::vector<std::uint32_t>> sets;
  for (const std::uint32_t seed : flattest_first(surface.variations, weights)) {
    if (!grower.is_free(seed)) continue;
    const std::vector<std::uint32_t>& points = grower.grow(seed);
    if (grower.weight() > static_cast<std::uint64_t>(options.min_points)) sets.push_back(points);
  }
  return sets;
}

std::vector<PlaneRegion> grow_regions(const scan::PointCloud& cloud, const SurfaceNormals& surface,
                                      const RegionGrowingOptions& options) {
  const std::vector<std::uint32_t> weights(cloud.points.size(), 1);
  std::vector<PlaneRegion> regions;
  for (std::vector<std::uint32_t>& points : grow_point_sets(cloud, surface, weights, options)) {
    const std::uint32_t seed = points.front();
    regions.push_back(make_region(cloud.points, std::move(points), surface.normals[seed].cast<double>()));
  }
  return regions;
}

}  // namespace stairway::detect
