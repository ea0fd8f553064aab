// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <tl/expected.hpp>

#include "detector/stairway.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::tools {

/// Whether the name ends in ".png" or ".svg".
bool is_plottable(const std::filesystem::path& path);

/// Draws what was found for a report: the points in grey; on the left the best stairway from the side, unrolled along
/// its ascent and cut to its width, on the right all stairways from above.
/// @param cloud  `base` frame [m]. Without a stairway both views show the whole scene.
/// @return an error in one line that names the file.
tl::expected<void, std::string> plot_detection(const std::filesystem::path& path, const std::string& title,
                                               const scan::PointCloud& cloud, const detect::Detection& detection);

}  // namespace stairway::tools
