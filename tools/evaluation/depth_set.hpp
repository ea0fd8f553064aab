// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

namespace stairway::evaluation {

/// What a person says is on a frame.
enum class FrameLabel { Ascending, Descending, None };

struct LabelledFrame {
  std::filesystem::path cloud;  ///< PCD or PLY
  FrameLabel label = FrameLabel::None;
  std::optional<Eigen::Vector3d> gravity;  ///< downwards in the cloud's frame, of any length
};

/// Reads DIR/labels.csv of a folder of recorded frames: a head line "file,stairs" or "file,stairs,gx,gy,gz", then one
/// line per frame with the cloud's path (relative to the folder), one of ascending, descending, none, and gravity or
/// three empty fields. Empty lines and lines that begin with # are left out.
///
/// @return in the order of the file. Throws std::runtime_error that names file and line.
std::vector<LabelledFrame> read_labels(const std::filesystem::path& folder);

}  // namespace stairway::evaluation
