// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ipc/cloud/text_lines.hpp"
#include "ipc/cloud_file.hpp"

namespace stairway::ipc::cloud {

enum class ScalarType : std::uint8_t { I8, U8, I16, U16, I32, U32, I64, U64, F32, F64 };
std::size_t size_of(ScalarType type);

/// The number at `bytes` as a double; `size_of(type)` bytes must be readable.
double load_scalar(const char* bytes, ScalarType type, bool big_endian);

/// One coordinate of all points: the value of point i starts at `first + i * stride`.
struct Column {
  const char* first = nullptr;
  std::size_t stride = 0;
  ScalarType type = ScalarType::F32;
  bool big_endian = false;
};

/// Collects `count` points from their x, y and z columns; the caller has checked that the bytes are there.
LoadedCloud gather_points(const std::array<Column, 3>& xyz, std::size_t count);

inline constexpr int kSkipped = -1;

/// One item of a line of numbers: a number, several alike, or a list that starts with its length.
struct RowItem {
  int axis = kSkipped;  ///< 0 1 2 for x y z
  std::size_t repeat = 1;
  bool is_list = false;
};

/// Reads `count` points, one a line; blank lines are passed over.
tl::expected<LoadedCloud, CloudFileError> read_rows(TextLines& lines, std::span<const RowItem> row,
                                                    std::uint64_t count);

/// Appends finite points and counts the others.
inline void add_point(LoadedCloud& loaded, const Eigen::Vector3f& point) {
  if (point.allFinite()) {
    loaded.cloud.points.push_back(point);
  } else {
    ++loaded.dropped_points;
  }
}

/// NaN and the infinities stay; a value that float cannot hold becomes one.
inline float to_float(double value) {
  constexpr double kMax = std::numeric_limits<float>::max();
  if (value > kMax) return std::numeric_limits<float>::infinity();
  if (value < -kMax) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

}  // namespace stairway::ipc::cloud
