// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <tl/expected.hpp>
#include <vector>

#include "detector/stairway.hpp"
#include "ipc/cloud_file.hpp"

namespace stairway::tools {

/// Writes the cloud with its stairways marked: treads blue, risers green, the rest grey; the label is the number of the
/// stairway, 1 being the first, and 0 elsewhere. A PCD if `path` ends in ".pcd", else a PLY.
tl::expected<void, ipc::CloudFileError> write_marked_cloud(const std::filesystem::path& path,
                                                           const scan::PointCloud& cloud,
                                                           const std::vector<detect::Stairway>& stairways);

/// The same without marks.
tl::expected<void, ipc::CloudFileError> write_cloud(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                                    const ipc::PointAttributes& attributes = {});

}  // namespace stairway::tools
