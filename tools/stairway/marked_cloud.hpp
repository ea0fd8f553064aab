// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <tl/expected.hpp>
#include <vector>

#include "detector/stairway.hpp"
#include "ipc/cloud_file.hpp"

namespace stairway::tools {

/// What marks the stairways in a cloud, point by point.
struct CloudMarks {
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< treads blue, risers green, the rest grey
  std::vector<std::uint32_t> labels;                 ///< number of the stairway, 1 being the first; 0 elsewhere
};
CloudMarks mark_stairways(const scan::PointCloud& cloud, const std::vector<detect::Stairway>& stairways);

/// Writes the cloud with its stairways marked. A PCD if `path` ends in ".pcd", else a PLY.
tl::expected<void, ipc::CloudFileError> write_marked_cloud(const std::filesystem::path& path,
                                                           const scan::PointCloud& cloud,
                                                           const std::vector<detect::Stairway>& stairways);

/// The same without marks.
tl::expected<void, ipc::CloudFileError> write_cloud(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                                    const ipc::PointAttributes& attributes = {});

}  // namespace stairway::tools
