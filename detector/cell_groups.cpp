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

// A short key above its point's index, for rooms and cells of some centimetres.
constexpr int kShortKeyBits = 32;
struct PackedPoint {
  std::uint64_t bits;
  PackedPoint() = default;
  PackedPoint(std::uint64_t key, std::uint32_t index) : bits(key << kShortKeyBits | index) {}
};

std::uint64_t key_of(const KeyedPoint& item) { return item.key; }
std::uint32_t index_of(const KeyedPoint& item) { return item.index; }
std::uint64_t key_of(const PackedPoint& item) { return item.bits >> kShortKeyBits; }
std::uint32_t index_of(const PackedPoint& item) { return static_cast<std::uint32_t>(item.bits); }

// Least significant digit first, so that equal keys keep their order.
template <class Item>
void radix_sort(std::vector<Item>& items, std::uint64_t largest_key) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kBuckets = std::size_t{1} << kDigitBits;
  std::vector<Item> other(items.size());
  for (int shift = 0; shift < 64 && (largest_key >> shift) != 0; shift += kDigitBits) {
    std::array<std::uint32_t, kBuckets> starts{};
    for (const Item& item : items) ++starts[(key_of(item) >> shift) & (kBuckets - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts) sum += std::exchange(start, sum);
    for (const Item& item : items) other[starts[(key_of(item) >> shift) & (kBuckets - 1)]++] = item;
    items.swap(other);
  }
}

int bits_for(std::uint64_t cells) {
  int bits = 1;
  while ((cells >> bits) != 0) ++bits;
  return bits;
}

}  // namespace

namespace {

bool is_usable(const Eigen::Vector3f& p) { return p.array().abs().maxCoeff<Eigen::PropagateNaN>() < kFarthest_m; }

/// Cells counted from one below all points.
class Raster {
 public:
  Raster(const Eigen::Array3f& low, const Eigen::Array3f& high, double leaf_m)
      : per_leaf_(1.0 / leaf_m), first_cell_((low.cast<double>() * per_leaf_).floor() - kCellMargin) {
    y_shift_ = bits_for(along(high.x(), 0) + kCellMargin);
    z_shift_ = y_shift_ + bits_for(along(high.y(), 1) + kCellMargin);
    largest_key_ = (along(high.z(), 2) + 1) << z_shift_;
  }

  std::uint64_t key(const Eigen::Vector3f& p) const {
    return along(p.x(), 0) | along(p.y(), 1) << y_shift_ | along(p.z(), 2) << z_shift_;
  }
  std::uint64_t largest_key() const { return largest_key_; }
  int y_shift() const { return y_shift_; }
  int z_shift() const { return z_shift_; }

 private:
  // Not negative, so that cutting off does what std::floor would, without a call.
  std::uint64_t along(float value, int axis) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value * per_leaf_ - first_cell_[axis]));
  }

  double per_leaf_;
  Eigen::Array3d first_cell_;
  int y_shift_ = 0;
  int z_shift_ = 0;
  std::uint64_t largest_key_ = 0;
};

template <class Item>
void sort_into(std::span<const Eigen::Vector3f> points, const Raster& raster, CellGroups& groups) {
  std::vector<Item> items;
  items.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_usable(points[i])) items.push_back({raster.key(points[i]), static_cast<std::uint32_t>(i)});
  radix_sort(items, raster.largest_key());
  groups.order.reserve(items.size());
  groups.keys.back() = key_of(items.front());
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (key_of(items[i]) != groups.keys.back()) {
      groups.starts.push_back(static_cast<std::uint32_t>(i));
      groups.keys.push_back(key_of(items[i]));
    }
    groups.order.push_back(index_of(items[i]));
  }
  groups.starts.push_back(static_cast<std::uint32_t>(items.size()));
  groups.keys.push_back(kAboveAllKeys);
}

}  // namespace

CellGroups group_by_cell(std::span<const Eigen::Vector3f> points, double leaf_m) {
  Eigen::Array3f low = Eigen::Array3f::Constant(kFarthest_m);
  Eigen::Array3f high = -low;
  for (const Eigen::Vector3f& p : points) {
    if (!is_usable(p)) continue;
    low = low.min(p.array());
    high = high.max(p.array());
  }
  CellGroups groups;
  if ((low > high).any()) return groups;
  const Raster raster(low, high, leaf_m);
  groups.y_shift = raster.y_shift();
  groups.z_shift = raster.z_shift();
  if (raster.largest_key() >> kShortKeyBits == 0) {
    sort_into<PackedPoint>(points, raster, groups);
  } else {
    sort_into<KeyedPoint>(points, raster, groups);
  }
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
