// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cell_groups.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace stairway::detect {
namespace {

constexpr float kFarthest_m = 1e4F;
constexpr std::uint64_t kAboveAllKeys = ~std::uint64_t{0};

struct KeyedPoint {
  std::uint64_t key;
  std::uint32_t index;
};

// Least significant digit first, so that equal keys keep their order.
void radix_sort(std::vector<KeyedPoint>& items, std::uint64_t largest_key) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;
  std::vector<KeyedPoint> other(items.size());
  for (int shift = 0; shift < 64 && (largest_key >> shift) != 0; shift += kDigitBits) {
    std::array<std::uint32_t, kBuckets> starts{};
    for (const KeyedPoint& item : items) ++starts[(item.key >> shift) & (kBuckets - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts) sum += std::exchange(start, sum);
    for (const KeyedPoint& item : items) other[starts[(item.key >> shift) & (kBuckets - 1)]++] = item;
    items.swap(other);
  }
}

int bits_for(std::uint64_t cells) {
  int bits = 1;
  while ((cells >> bits) != 0) ++bits;
  return bits;
}

}  // namespace

CellGroups group_by_cell(std::span<const Eigen::Vector3f> points, double leaf_m) {
  const auto usable = [](const Eigen::Vector3f& p) {
    return p.array().abs().maxCoeff<Eigen::PropagateNaN>() < kFarthest_m;
  };
  Eigen::Array3f low = Eigen::Array3f::Constant(kFarthest_m);
  Eigen::Array3f high = -low;
  for (const Eigen::Vector3f& p : points) {
    if (!usable(p)) continue;
    low = low.min(p.array());
    high = high.max(p.array());
  }
  CellGroups groups;
  if ((low > high).any()) return groups;

  const double per_leaf = 1.0 / leaf_m;
  const Eigen::Array3d first_cell = (low.cast<double>() * per_leaf).floor() - kCellMargin;
  const auto cell_of = [&](float value, int axis) {
    // Not negative, so that cutting off does what std::floor would, without a call.
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value * per_leaf - first_cell[axis]));
  };
  const int y_shift = bits_for(cell_of(high.x(), 0) + kCellMargin);
  const int z_shift = y_shift + bits_for(cell_of(high.y(), 1) + kCellMargin);
  groups.y_shift = y_shift;
  groups.z_shift = z_shift;
  std::vector<KeyedPoint> keyed;
  keyed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i];
    if (!usable(p)) continue;
    keyed.push_back({cell_of(p.x(), 0) | cell_of(p.y(), 1) << y_shift | cell_of(p.z(), 2) << z_shift,
                     static_cast<std::uint32_t>(i)});
  }
  radix_sort(keyed, (cell_of(high.z(), 2) + 1) << z_shift);

  groups.order.reserve(keyed.size());
  groups.keys.back() = keyed.front().key;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i > 0 && keyed[i].key != keyed[i - 1].key) {
      groups.starts.push_back(static_cast<std::uint32_t>(i));
      groups.keys.push_back(keyed[i].key);
    }
    groups.order.push_back(keyed[i].index);
  }
  groups.starts.push_back(static_cast<std::uint32_t>(keyed.size()));
  groups.keys.push_back(kAboveAllKeys);
  return groups;
}

CellRows::CellRows(const CellGroups& groups, int reach)
    : groups_(&groups), length_(2 * static_cast<std::uint64_t>(reach)) {
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      const auto steps = [](int count, int shift) { return static_cast<std::uint64_t>(count) << shift; };
      rows_.push_back({steps(z, groups.z_shift) + steps(y, groups.y_shift) + steps(-reach, 0), 0});
    }
  }
}

}  // namespace stairway::detect
