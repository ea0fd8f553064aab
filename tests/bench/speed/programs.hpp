// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/speed/run_report.hpp"

namespace stairway::bench {

/// The sweep as a file in `folder`; made when it is not there.
std::filesystem::path sweep_file(const std::filesystem::path& folder);
/// Beginnings of the walk through the tower, in the order of `sizes`; always made.
std::vector<std::filesystem::path> tower_files(const std::filesystem::path& folder,
                                               const std::vector<std::size_t>& sizes);

/// @param cloud  "sweep" or "tower".
RunReport run_detector(const std::filesystem::path& file, const std::string& cloud);
/// @param settings  "usual" or "same".
RunReport run_pcl_segmentation(const std::filesystem::path& file, const std::string& settings);

}  // namespace stairway::bench
