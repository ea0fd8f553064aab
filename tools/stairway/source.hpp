// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "config/settings.hpp"
#include "ipc/stairway_json.hpp"
#include "scan_assembly/point_cloud.hpp"
#include "tools/sim/scene.hpp"

namespace stairway::tools {

/// A SOURCE of the command line, in memory; of a recording one sweep.
struct Source {
  std::string name;                                    ///< as the user called it
  scan::PointCloud cloud;                              ///< in the frame of the file; `base` when simulated [m]
  std::size_t dropped_points = 0;                      ///< of the file, because a coordinate was not finite
  ipc::Timings timings;                                ///< "read" of a file, "simulate" of a scene [ms]
  std::optional<std::vector<detect::Stairway>> truth;  ///< of a simulated scene
};

/// A SOURCE that cannot be had; one line that names it and says why.
struct SourceError {
  std::string text;
};

/// Reads a cloud file (PCD or PLY), or simulates a sweep in the scene of a "sim:SCENE" with the settings' seed and
/// disk period, and with the scene's mount or, for most scenes, the settings'.
tl::expected<Source, SourceError> open_source(const std::string& name, const config::Settings& settings);

/// Builds what load_scene() finds; the name may begin with "sim:".
tl::expected<sim::Scene, SourceError> open_scene(const std::string& name);

}  // namespace stairway::tools
