// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cloud_index.hpp"

#include <nanoflann.hpp>

namespace stairway::detect {
namespace {

struct PointAdaptor {
  std::span<const Eigen::Vector3f> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*unused*/) const {
    return false;
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointAdaptor>, PointAdaptor, 3,
                                                   std::uint32_t>;
constexpr std::size_t kLeafSize = 16;

// nanoflann's own radius result also stores and sorts distances, which nobody here reads.
class IndicesWithin {
 public:
  using DistanceType = float;
  IndicesWithin(float squared_radius, std::vector<std::uint32_t>& found)
      : squared_radius_(squared_radius), found_(found) {}
  bool addPoint(float squared_distance, std::uint32_t index) {
    if (squared_distance <= squared_radius_) found_.push_back(index);
    return true;
  }
  bool full() const { return true; }
  float worstDist() const { return squared_radius_; }

 private:
  float squared_radius_;
  std::vector<std::uint32_t>& found_;
};

}  // namespace

struct CloudIndex::Tree {
  explicit Tree(std::span<const Eigen::Vector3f> points)
      : adaptor{points}, index(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {
    index.buildIndex();
  }
  PointAdaptor adaptor;
  KdTree index;
};

CloudIndex::CloudIndex(std::span<const Eigen::Vector3f> points) : tree_(std::make_unique<Tree>(points)) {}
CloudIndex::~CloudIndex() = default;
CloudIndex::CloudIndex(CloudIndex&&) noexcept = default;
CloudIndex& CloudIndex::operator=(CloudIndex&&) noexcept = default;

void CloudIndex::nearest(const Eigen::Vector3f& query, std::size_t count,
                         std::vector<std::uint32_t>& neighbours) const {
  neighbours.resize(count);
  thread_local std::vector<float> squared_distances;
  squared_distances.resize(count);
  neighbours.resize(tree_->index.knnSearch(query.data(), count, neighbours.data(), squared_distances.data()));
}

void CloudIndex::within(const Eigen::Vector3f& query, double radius_m, std::vector<std::uint32_t>& neighbours) const {
  neighbours.clear();
  // nanoflann's L2 distances, and so its radii, are squared.
  IndicesWithin result(static_cast<float>(radius_m * radius_m), neighbours);
  tree_->index.findNeighbors(result, query.data(), nanoflann::SearchParams(0, 0.0F, false));
}

}  // namespace stairway::detect
