// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "ipc/cloud_file.hpp"

namespace stairway::ipc::cloud {

tl::expected<LoadedCloud, CloudFileError> decode_pcd(std::string_view bytes);
tl::expected<LoadedCloud, CloudFileError> decode_ply(std::string_view bytes);

/// Both need spans of the right length; see PointAttributes.
std::string encode_pcd(const scan::PointCloud& cloud, const PointAttributes& attributes);
std::string encode_ply(const scan::PointCloud& cloud, const PointAttributes& attributes);

}  // namespace stairway::ipc::cloud
