// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/detection_pass.hpp"

#include <fmt/format.h>

#include <numbers>

#include "detector/levelling.hpp"
#include "scan_assembly/frames.hpp"
#include "tools/common/stage_timer.hpp"

namespace stairway::tools {
namespace {

bool is_tilted(const config::InputOptions& input) {
  return input.gravity || input.roll_rad != 0.0 || input.pitch_rad != 0.0;
}

bool needs_levelling(const config::InputOptions& input) {
  return is_tilted(input) || input.level == config::Levelling::Floor;
}

std::optional<Eigen::Vector3f> presumed_sensor_origin(const config::Settings& settings) {
  if (is_tilted(settings.input)) return Eigen::Vector3f::Zero();
  if (needs_levelling(settings.input)) return std::nullopt;
  return scan::make_calibration(settings.mount).mean_sensor_origin().cast<float>();
}

detect::Rejection floor_not_found(const detect::FloorOptions& options) {
  const double max_tilt_deg = options.max_tilt_rad * 180.0 / std::numbers::pi;
  return {
      "floor-not-found",
      fmt::format("no plane within {:.0f} degrees of level holds {:.0f} % of the points; for a cloud that is tilted "
                  "more, set input.gravity, or input.roll_deg and input.pitch_deg",
                  max_tilt_deg, 100.0 * options.min_share),
      {{"max_tilt", options.max_tilt_rad}, {"min_share", options.min_share}}};
}

}  // namespace

std::optional<detect::Rejection> turn_into_base(scan::PointCloud& cloud, const config::Settings& settings) {
  const config::InputOptions& input = settings.input;
  if (input.sensor) cloud.sensor_origin = input.sensor->cast<float>();
  if (!cloud.sensor_origin) cloud.sensor_origin = presumed_sensor_origin(settings);
  if (input.merged) cloud.sensor_origin.reset();
  if (is_tilted(input)) {
    cloud =
        detect::transformed(cloud, input.gravity ? detect::upright_from_gravity(*input.gravity)
                                                 : detect::upright_from_roll_pitch(input.roll_rad, input.pitch_rad));
  }
  if (input.level == config::Levelling::Floor) {
    const detect::FloorOptions options;
    const auto floor = detect::find_floor(cloud, options);
    if (!floor) return floor_not_found(options);
    cloud = detect::transformed(cloud, floor->T_level_cloud);
  }
  return std::nullopt;
}

DetectionPass detect_once(scan::PointCloud cloud, const config::Settings& settings,
                          const std::function<void(std::string_view)>& on_stage) {
  DetectionPass pass{.cloud = std::move(cloud), .detection = {}, .timings = {}};
  StageTimer timer;
  const auto begin_stage = [&](std::string_view stage) {
    timer.begin(stage);
    if (on_stage) on_stage(stage);
  };
  if (needs_levelling(settings.input)) begin_stage("levelling");
  if (auto rejection = turn_into_base(pass.cloud, settings)) {
    pass.detection.rejected.push_back(std::move(*rejection));
  } else {
    pass.detection = detect::detect_stairways(pass.cloud, settings.detector, begin_stage);
    if (pass.detection.level) pass.cloud = detect::transformed(pass.cloud, pass.detection.level->T_level_cloud);
  }
  timer.stop();
  pass.timings = timer.timings();
  return pass;
}

}  // namespace stairway::tools
