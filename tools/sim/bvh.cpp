// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/bvh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stairway::sim {
namespace {

using Box = Eigen::AlignedBox3f;

constexpr int kBins = 16;
constexpr std::uint32_t kLeafSize = 4;
constexpr int kMaxSahDepth = 40;  // below it nodes are halved, which bounds the stack of cast()
constexpr std::size_t kStackSize = 80;
constexpr float kBoxPadding_m = 2e-5F;
constexpr float kEdgeTolerance = 1e-5F;  // neighbouring triangles overlap by this share, so no ray slips between them

double half_area(const Box& box) {
  if (box.isEmpty()) return 0.0;
  const Eigen::Vector3f s = box.sizes();
  return static_cast<double>(s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
}

}  // namespace

struct Bvh::Builder {
  std::vector<Node>& nodes;
  std::vector<Box> boxes;
  std::vector<Eigen::Vector3f> centers;
  std::vector<std::uint32_t> order;

  Box bounds(std::uint32_t first, std::uint32_t count) const {
    Box box;
    for (std::uint32_t i = first; i < first + count; ++i) box.extend(boxes[order[i]]);
    return box;
  }

  // Sorts order[first, first + count) into two parts and gives the size of the first one; 0 when a leaf is cheaper.
  std::uint32_t split(std::uint32_t first, std::uint32_t count, const Box& box, int depth) {
    Box spread;
    for (std::uint32_t i = first; i < first + count; ++i) spread.extend(centers[order[i]]);
    Eigen::Index axis = 0;
    const float width = spread.sizes().maxCoeff(&axis);
    const auto begin = order.begin() + first;
    const auto end = begin + count;
    if (!(width > 0)) return count > kLeafSize ? count / 2 : 0;
    if (depth >= kMaxSahDepth) {
      if (count <= kLeafSize) return 0;
      std::nth_element(begin, begin + count / 2, end,
                       [&](auto a, auto b) { return centers[a][axis] < centers[b][axis]; });
      return count / 2;
    }
    const auto bin_of = [&](std::uint32_t i) {
      return std::min(kBins - 1, static_cast<int>(kBins * (centers[i][axis] - spread.min()[axis]) / width));
    };
    std::array<Box, kBins> bin_boxes;
    std::array<std::uint32_t, kBins> bin_counts{};
    for (auto it = begin; it != end; ++it) {
      const auto bin = static_cast<std::size_t>(bin_of(*it));
      bin_boxes[bin].extend(boxes[*it]);
      ++bin_counts[bin];
    }
    std::array<double, kBins> cost_below{};
    Box below;
    std::uint32_t n_below = 0;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
      below.extend(bin_boxes[i]);
      n_below += bin_counts[i];
      cost_below[i] = n_below * half_area(below);
    }
    Box above;
    std::uint32_t n_above = 0;
    double best = std::numeric_limits<double>::infinity();
    int best_bin = 0;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      above.extend(bin_boxes[i]);
      n_above += bin_counts[i];
      const double cost = cost_below[i - 1] + n_above * half_area(above);
      if (cost < best) {
        best = cost;
        best_bin = static_cast<int>(i);
      }
    }
    const double box_area = half_area(box);
    if (count <= kLeafSize && best + box_area >= count * box_area) return 0;
    const auto middle = std::partition(begin, end, [&](std::uint32_t i) { return bin_of(i) < best_bin; });
    return static_cast<std::uint32_t>(middle - begin);
  }

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, int depth) {
    const Box box = bounds(first, count);
    nodes[node].low = box.min().array() - kBoxPadding_m;
    nodes[node].high = box.max().array() + kBoxPadding_m;
    const std::uint32_t part = count > 1 ? split(first, count, box, depth) : 0;
    if (part == 0 || part == count) {
      nodes[node].first = first;
      nodes[node].count = count;
      return;
    }
    const auto child = static_cast<std::uint32_t>(nodes.size());
    nodes[node].first = child;
    nodes[node].count = 0;
    nodes.resize(nodes.size() + 2);
    build(child, first, part, depth + 1);
    build(child + 1, first + part, count - part, depth + 1);
  }
};

Bvh::Bvh(const Mesh& mesh) {
  const auto& triangles = mesh.triangles();
  if (triangles.empty()) return;
  Builder builder{nodes_, {}, {}, {}};
  for (const auto& triangle : triangles) {
    Box box;
    for (const auto& corner : triangle.corners) box.extend(Eigen::Vector3f{corner.cast<float>()});
    builder.boxes.push_back(box);
    builder.centers.push_back(box.center());
  }
  builder.order.resize(triangles.size());
  std::iota(builder.order.begin(), builder.order.end(), 0U);
  nodes_.reserve(2 * triangles.size());
  nodes_.resize(1);
  builder.build(0, 0, static_cast<std::uint32_t>(triangles.size()), 0);
  facets_.reserve(triangles.size());
  for (const std::uint32_t i : builder.order) {
    const auto& [a, b, c] = triangles[i].corners;
    facets_.push_back({a.cast<float>(), (b - a).cast<float>(), (c - a).cast<float>(), triangles[i].surface});
  }
}

Hit Bvh::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float max_range_m) const {
  Hit hit;
  if (nodes_.empty()) return hit;
  float nearest = max_range_m;
  // A tiny direction instead of zero keeps 0 * infinity out of the box test.
  const auto inverse = [](float d) { return std::abs(d) > 1e-12F ? 1.0F / d : std::copysign(1e12F, d); };
  const Eigen::Vector3f inv{inverse(direction.x()), inverse(direction.y()), inverse(direction.z())};
  const Eigen::Vector3f shift = -origin.cwiseProduct(inv);

  const auto enter_box = [&](const Node& node) {
    const Eigen::Vector3f t0 = node.low.cwiseProduct(inv) + shift;
    const Eigen::Vector3f t1 = node.high.cwiseProduct(inv) + shift;
    const float enter = std::max(std::max(std::min(t0.x(), t1.x()), std::min(t0.y(), t1.y())),
                                 std::max(std::min(t0.z(), t1.z()), 0.0F));
    const float leave = std::min(std::min(std::max(t0.x(), t1.x()), std::max(t0.y(), t1.y())),
                                 std::min(std::max(t0.z(), t1.z()), nearest));
    return enter <= leave ? enter : std::numeric_limits<float>::infinity();
  };

  struct Visit {
    std::uint32_t node;
    float enter;
  };
  std::array<Visit, kStackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0.0F};
  while (waiting > 0) {
    const Visit visit = stack[--waiting];
    if (visit.enter > nearest) continue;
    const Node& node = nodes_[visit.node];
    if (node.count == 0) {
      Visit near_child{node.first, enter_box(nodes_[node.first])};
      Visit far_child{node.first + 1, enter_box(nodes_[node.first + 1])};
      if (far_child.enter < near_child.enter) std::swap(near_child, far_child);
      if (std::isfinite(far_child.enter)) stack[waiting++] = far_child;
      if (std::isfinite(near_child.enter)) stack[waiting++] = near_child;
      continue;
    }
    // Moeller and Trumbore, Journal of Graphics Tools 2(1), 1997.
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Facet& facet = facets_[i];
      const Eigen::Vector3f p = direction.cross(facet.edge2);
      const float determinant = facet.edge1.dot(p);
      if (determinant == 0.0F) continue;
      const float scale = 1.0F / determinant;
      const Eigen::Vector3f from_corner = origin - facet.corner;
      const float u = from_corner.dot(p) * scale;
      if (!(u >= -kEdgeTolerance) || u > 1.0F + kEdgeTolerance) continue;
      const Eigen::Vector3f q = from_corner.cross(facet.edge1);
      const float v = direction.dot(q) * scale;
      if (!(v >= -kEdgeTolerance) || u + v > 1.0F + kEdgeTolerance) continue;
      const float range = facet.edge2.dot(q) * scale;
      if (range > 0.0F && range < nearest) {
        nearest = range;
        hit = {range, facet.surface};
      }
    }
  }
  return hit;
}

}  // namespace stairway::sim
