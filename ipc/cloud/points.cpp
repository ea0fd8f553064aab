// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/cloud/points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace stairway::ipc::cloud {
namespace {

template <class T>
double load(const char* bytes, bool big_endian) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

bool are_native_floats_in_a_row(const std::array<Column, 3>& xyz) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Column& column = xyz[axis];
    if (column.type != ScalarType::F32 || column.stride != xyz[0].stride) return false;
    if (column.big_endian != (std::endian::native == std::endian::big)) return false;
    if (column.first != xyz[0].first + axis * sizeof(float)) return false;
  }
  return true;
}

void gather_float_triples(const Column& x, std::size_t count, std::vector<Eigen::Vector3f>& points) {
  points.resize(count);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 3> xyz;  // not read back from `points`, which stalls on the store
    std::memcpy(xyz.data(), x.first + i * x.stride, sizeof xyz);
    points[kept] = Eigen::Vector3f(xyz[0], xyz[1], xyz[2]);
    const float zero = 0.0F * xyz[0] + 0.0F * xyz[1] + 0.0F * xyz[2];  // NaN unless all are finite
    kept += zero == 0.0F ? 1 : 0;
  }
  points.resize(kept);
}

tl::expected<Eigen::Vector3f, std::string> read_row(std::string_view line, std::span<const RowItem> row) {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  for (const RowItem& item : row) {
    std::size_t words = item.repeat;
    if (item.is_list && parse_number(take_word(line), words) != std::errc{}) {
      return tl::unexpected(std::string("a list does not start with its length"));
    }
    for (std::size_t i = 0; i < words; ++i) {
      const std::string_view word = take_word(line);
      if (word.empty()) return tl::unexpected(std::string("too few numbers for the declared fields"));
      if (item.axis == kSkipped) continue;
      double value = 0.0;
      const std::errc error = parse_number(word, value);
      if (error == std::errc::invalid_argument) {
        return tl::unexpected(fmt::format("expected a number for {}, found {}", "xyz"[item.axis], quoted(word)));
      }
      if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN();
      point[item.axis] = to_float(value);
    }
  }
  if (const std::string_view word = take_word(line); !word.empty()) {
    return tl::unexpected(fmt::format("{} stands behind the last declared field", quoted(word)));
  }
  return point;
}

}  // namespace

std::size_t size_of(ScalarType type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

double load_scalar(const char* bytes, ScalarType type, bool big_endian) {
  switch (type) {
    case ScalarType::I8:
      return load<std::int8_t>(bytes, big_endian);
    case ScalarType::U8:
      return load<std::uint8_t>(bytes, big_endian);
    case ScalarType::I16:
      return load<std::int16_t>(bytes, big_endian);
    case ScalarType::U16:
      return load<std::uint16_t>(bytes, big_endian);
    case ScalarType::I32:
      return load<std::int32_t>(bytes, big_endian);
    case ScalarType::U32:
      return load<std::uint32_t>(bytes, big_endian);
    case ScalarType::I64:
      return load<std::int64_t>(bytes, big_endian);
    case ScalarType::U64:
      return load<std::uint64_t>(bytes, big_endian);
    case ScalarType::F32:
      return load<float>(bytes, big_endian);
    case ScalarType::F64:
      break;
  }
  return load<double>(bytes, big_endian);
}

LoadedCloud gather_points(const std::array<Column, 3>& xyz, std::size_t count) {
  LoadedCloud loaded;
  if (are_native_floats_in_a_row(xyz)) {
    gather_float_triples(xyz[0], count, loaded.cloud.points);
    loaded.dropped_points = count - loaded.cloud.points.size();
    return loaded;
  }
  loaded.cloud.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3f point;
    for (int axis = 0; axis < 3; ++axis) {
      const Column& column = xyz[static_cast<std::size_t>(axis)];
      point[axis] = to_float(load_scalar(column.first + i * column.stride, column.type, column.big_endian));
    }
    add_point(loaded, point);
  }
  return loaded;
}

tl::expected<LoadedCloud, CloudFileError> read_rows(TextLines& lines, std::span<const RowItem> row,
                                                    std::uint64_t count) {
  std::uint64_t words = 0;
  for (const RowItem& item : row) words += item.is_list ? 1 : item.repeat;
  const std::uint64_t room = (lines.rest().size() + 1) / (2 * std::max<std::uint64_t>(words, 1));
  if (count > room) {
    return error_at_byte(lines.offset(), CloudFileFault::Truncated,
                         fmt::format("the header declares {} points, but the file has room for {}", count, room));
  }
  LoadedCloud loaded;
  loaded.cloud.points.reserve(count);
  for (std::uint64_t i = 0; i < count;) {
    const auto line = lines.next();
    if (!line) {
      return error_at_line(lines.line_number(), CloudFileFault::Truncated,
                           fmt::format("the file ends after {} of {} declared points", i, count));
    }
    if (std::string_view words_left = *line; take_word(words_left).empty()) continue;
    const auto point = read_row(*line, row);
    if (!point) return error_at_line(lines.line_number(), CloudFileFault::Malformed, point.error());
    add_point(loaded, *point);
    ++i;
  }
  return loaded;
}

}  // namespace stairway::ipc::cloud
