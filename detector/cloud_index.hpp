// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace stairway::detect {

/// Nearest neighbours in a set of points (a nanoflann k-d tree, kept out of sight).
///
/// The points must outlive the index and stay where they are. Queries may run in several threads at once.
class CloudIndex {
 public:
  /// Builds the tree over `points` (finite, any frame [m]). Cost: O(N log N).
  explicit CloudIndex(std::span<const Eigen::Vector3f> points);
  ~CloudIndex();
  CloudIndex(CloudIndex&&) noexcept;
  CloudIndex& operator=(CloudIndex&&) noexcept;

  /// Fills `neighbours` with the up to `count` points nearest to `query`, nearest first. Ties have no order.
  void nearest(const Eigen::Vector3f& query, std::size_t count, std::vector<std::uint32_t>& neighbours) const;
  /// Fills `neighbours` with all points within `radius_m` of `query`, in no order.
  void within(const Eigen::Vector3f& query, double radius_m, std::vector<std::uint32_t>& neighbours) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace stairway::detect
