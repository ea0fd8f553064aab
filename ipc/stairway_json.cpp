// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/stairway_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace stairway::ipc {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(double value, double steps_per_unit) {
  const double result = std::round(value * steps_per_unit) / steps_per_unit;
  if (!std::isfinite(result)) return nullptr;
  return result + 0.0;  // turns -0 into 0
}

Json number(double value) { return rounded(value, 1e6); }

Json point(const Eigen::Vector3d& p) { return Json::array({number(p.x()), number(p.y()), number(p.z())}); }

Json to_json(const detect::Stairway& stairway) {
  Json nosings = Json::array();
  for (const detect::Nosing& nosing : stairway.nosings) {
    nosings.push_back(Json::array({point(nosing.left), point(nosing.right)}));
  }
  Json sizes = Json::array();
  for (const detect::StepSize& size : stairway.step_sizes) {
    sizes.push_back({{"height", number(size.height)},
                     {"height_sigma", number(size.height_sigma)},
                     {"depth", number(size.depth)},
                     {"depth_sigma", number(size.depth_sigma)}});
  }
  return {{"kind", to_string(stairway.kind)},
          {"direction", to_string(stairway.direction)},
          {"steps", stairway.nosings.size()},
          {"step_height", number(stairway.step_height)},
          {"step_depth", number(stairway.step_depth)},
          {"width", number(stairway.width)},
          {"pitch", number(stairway.pitch())},
          {"heading", number(stairway.heading)},
          {"turn_per_step", number(stairway.turn_per_step)},
          {"step_height_sigma", number(stairway.step_height_sigma)},
          {"step_depth_sigma", number(stairway.step_depth_sigma)},
          {"width_sigma", number(stairway.width_sigma)},
          {"heading_sigma", number(stairway.heading_sigma)},
          {"anchor", point(stairway.anchor)},
          {"anchor_side", to_string(stairway.anchor_side)},
          {"railing", {{"left", stairway.railing_left}, {"right", stairway.railing_right}}},
          {"nosings", std::move(nosings)},
          {"irregular", stairway.is_irregular},
          {"step_sizes", std::move(sizes)},
          {"score", number(stairway.score)}};
}

Json to_json(const detect::Rejection& rejection) {
  Json figures = Json::object();
  for (const auto& [figure, value] : rejection.figures) figures[figure] = number(value);
  return {{"reason", rejection.reason}, {"detail", rejection.detail}, {"figures", std::move(figures)}};
}

Json to_json(const detect::SceneLevel& level) {
  return {{"roll", number(level.roll_rad)},
          {"pitch", number(level.pitch_rad)},
          {"sigma", number(level.sigma_rad)},
          {"planes", level.planes},
          {"floor_slope", level.floor_slope_rad ? number(*level.floor_slope_rad) : Json(nullptr)}};
}

}  // namespace

std::string detection_json(std::string_view source, std::size_t points, const Timings& timings,
                           const detect::Detection& detection) {
  Json timing_ms = Json::object();
  for (const auto& [stage, duration_ms] : timings) timing_ms[stage] = rounded(duration_ms, 1e3);
  Json stairways = Json::array();
  for (const detect::Stairway& stairway : detection.stairways) stairways.push_back(to_json(stairway));
  Json rejected = Json::array();
  for (const detect::Rejection& rejection : detection.rejected) rejected.push_back(to_json(rejection));
  Json object{{"source", source},
              {"points", points},
              {"timing_ms", std::move(timing_ms)},
              {"stairways", std::move(stairways)},
              {"rejected", std::move(rejected)}};
  if (detection.level) object["level"] = to_json(*detection.level);
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stairway::ipc
