// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "scan_assembly/point_cloud.hpp"

namespace stairway::ipc {

/// What kind of trouble a cloud file made.
enum class CloudFileFault {
  Unreadable,  ///< the file cannot be opened or read
  NotACloud,   ///< neither PCD nor PLY, or a variant of them that is not supported
  Malformed,   ///< the header or the data contradict the format
  Truncated,   ///< the header declares more points than the file holds
  TooLarge,    ///< above `kMaxCloudFileBytes`
  Unwritable,  ///< the file cannot be created or written
};
std::string_view to_string(CloudFileFault fault);

/// `text` is one line for a person: the file, the place (line or byte), what is wrong and what was expected.
struct CloudFileError {
  CloudFileFault fault = CloudFileFault::Malformed;
  std::string text;
};

/// The points of a file.
struct LoadedCloud {
  scan::PointCloud cloud;          ///< finite points in the file's own frame and order [m]
  std::size_t dropped_points = 0;  ///< points left out because a coordinate was NaN, infinite or beyond float
};

/// Larger files are refused [bytes].
inline constexpr std::uint64_t kMaxCloudFileBytes = std::uint64_t{4} << 30;

/// Reads a PCD (ascii, binary, binary_compressed) or PLY (ascii, binary in both byte orders) file; the contents decide
/// which, not the name.
///
/// x, y and z may be of any integer or floating type and stand in any order; other fields, elements and lists are
/// skipped. Lines may end in CR LF. Bytes after the last point are ignored. The translation of a PCD's VIEWPOINT
/// becomes `sensor_origin` unless it is zero, the value of files that do not know; PLY has no place for it.
/// A file with a valid header and no points gives an empty cloud.
///
/// Memory: the file and the points, nothing that a header could inflate: declared sizes are checked against the file.
/// Cost: 1.5 million float points of a cached binary PCD in about 20 ms, most of it page faults.
tl::expected<LoadedCloud, CloudFileError> read_cloud_file(const std::filesystem::path& path);

/// The same for a file already in memory; `error.text` then names no file.
tl::expected<LoadedCloud, CloudFileError> decode_cloud(std::string_view bytes);

/// What to write beside the coordinates; each span is empty or as long as the cloud.
struct PointAttributes {
  std::span<const std::array<std::uint8_t, 3>> colours;  ///< red, green, blue
  std::span<const std::uint32_t> labels;                 ///< e.g. the number of the plane or stairway a point is on
};

/// Writes a binary PCD 0.7 (fields x y z [rgb] [label]); `sensor_origin` becomes the VIEWPOINT.
tl::expected<void, CloudFileError> write_pcd(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                             const PointAttributes& attributes = {});

/// Writes a binary little-endian PLY (x y z [red green blue] [label]).
tl::expected<void, CloudFileError> write_ply(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                             const PointAttributes& attributes = {});

}  // namespace stairway::ipc
