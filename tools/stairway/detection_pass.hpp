// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "config/settings.hpp"
#include "detector/stairway.hpp"
#include "ipc/stairway_json.hpp"
#include "scan_assembly/point_cloud.hpp"

namespace stairway::tools {

/// Turns a cloud as `settings.input` says.
///
/// Gravity, roll and pitch are stated in the frame of a sensor; a cloud that needs them has its sensor at the origin,
/// unless it knows better. One that needs no turning was taken from the settings' mount. After levelling by the floor
/// alone nothing is known about the sensor.
/// @return nothing, or the rejection "floor-not-found"; the cloud is then turned only as far as gravity or angles go.
std::optional<detect::Rejection> turn_into_base(scan::PointCloud& cloud, const config::Settings& settings);

/// One detection in one cloud.
struct DetectionPass {
  scan::PointCloud cloud;  ///< that the answer is about, in `base`; without levelling, the file's own frame
  detect::Detection detection;
  ipc::Timings timings;  ///< total and the stages [ms]
};

/// Levels the cloud and looks for stairways. Without a floor to level by, nothing is looked for.
/// @param on_stage  told the name of each stage as it begins; may be empty.
DetectionPass detect_once(scan::PointCloud cloud, const config::Settings& settings,
                          const std::function<void(std::string_view)>& on_stage = {});

}  // namespace stairway::tools
