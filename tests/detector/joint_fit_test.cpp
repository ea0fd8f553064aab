// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/joint_fit.hpp"

#include <gtest/gtest.h>

#include "detector/stairway_detector.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

StairModel model_of(const Stairway& truth) {
  StairModel model;
  model.height_m = truth.step_height;
  model.depth_m = truth.step_depth;
  model.descent = -Eigen::Vector3d(std::cos(truth.heading), std::sin(truth.heading), 0.0);
  model.nosing = truth.nosings.front().middle();
  return model;
}

struct Case {
  const char* name;
  bool open;
  double distance_m;
  double max_height_error_m;
  double max_depth_error_m;
};

// Starts 4 mm and 1 degree off, as a graph from two noisy planes would.
TEST(JointFit, comes_back_to_the_truth_from_a_graph_that_is_a_little_off) {
  for (const Case& c :
       {Case{"closed at 1 m", false, 1.0, 0.001, 0.0005}, Case{"closed at 3 m", false, 3.0, 0.001, 0.001},
        Case{"open at 1 m", true, 1.0, 0.0015, 0.002}}) {
    SCOPED_TRACE(c.name);
    sim::StairSpec flight;
    flight.open_risers = c.open;
    const test::SimulatedRoom room = test::simulate(flight, c.distance_m, 0.3, 12.0);
    StairGraph graph;
    graph.model = model_of(room.truth);
    graph.model.height_m += 0.004;
    graph.model.depth_m -= 0.004;
    graph.model.descent = Eigen::AngleAxisd(0.017, Eigen::Vector3d::UnitZ()) * graph.model.descent;
    graph.parts = {{2, 0}, {3, 1}, {4, 2}};
    const std::optional<JointFit> fit = fit_jointly(room.cloud, graph, {-0.5, 0.5}, View::FromBelow);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->model.height_m, room.truth.step_height, c.max_height_error_m);
    EXPECT_NEAR(fit->model.depth_m, room.truth.step_depth, c.max_depth_error_m);
    EXPECT_NEAR(std::atan2(-fit->model.descent.y(), -fit->model.descent.x()), room.truth.heading, 0.004);
    EXPECT_EQ(fit->last - fit->first + 1, 10) << "follows the flight to both ends";
    EXPECT_NEAR(fit->sides.length(), room.truth.width, 0.03);
  }
}

// Their scatter alone would make steps that nothing confirms a tenth of that.
TEST(JointFit, is_as_unsure_as_the_spot_is_wide_where_no_beams_confirm_the_steps) {
  constexpr double kDistance_m = 1.5;
  sim::StairSpec flight;
  flight.open_risers = true;
  const test::SimulatedRoom room = test::simulate(flight, kDistance_m, 0.0, 12.0);
  StairGraph graph;
  graph.model = model_of(room.truth);
  graph.parts = {{2, 0}, {3, 1}, {4, 2}};
  JointFitOptions options;
  const std::optional<JointFit> confirmed = fit_jointly(room.cloud, graph, {-0.5, 0.5}, View::FromBelow, options);
  options.beams.min_explained = 1.0;
  const std::optional<JointFit> alone = fit_jointly(room.cloud, graph, {-0.5, 0.5}, View::FromBelow, options);
  ASSERT_TRUE(confirmed && alone);
  const double spot_m = options.measurement.spot_rad * kDistance_m;
  EXPECT_GT(alone->sigmas.height_m, 0.05 * spot_m);
  EXPECT_GT(alone->sigmas.depth_m, 0.05 * spot_m);
  EXPECT_GT(alone->sides_sigma_m, confirmed->sides_sigma_m);
  EXPECT_LT(confirmed->sigmas.height_m, 0.3 * alone->sigmas.height_m);
}

TEST(JointFit, has_nothing_to_fit_to_a_graph_without_parts_or_width) {
  const scan::PointCloud room = test::simulate_room(3, 2.0);
  StairGraph graph;
  graph.model.height_m = 0.17;
  graph.model.depth_m = 0.29;
  EXPECT_FALSE(fit_jointly(room, graph, {-0.5, 0.5}, View::FromBelow));
  graph.parts = {{0, 0}, {1, 1}, {2, 2}};
  EXPECT_FALSE(fit_jointly(room, graph, {0.5, 0.5}, View::FromBelow));
}

TEST(JointFit, finds_no_steps_where_there_are_none) {
  const scan::PointCloud room = test::simulate_room(3, 8.0);
  StairGraph graph;
  graph.model.height_m = 0.17;
  graph.model.depth_m = 0.29;
  graph.model.descent = -Eigen::Vector3d::UnitX();
  graph.model.nosing = {0.6, 0.0, 0.17};
  graph.parts = {{0, 0}, {1, 1}, {2, 2}};
  const std::optional<JointFit> fit = fit_jointly(room, graph, {-0.5, 0.5}, View::FromBelow);
  if (fit) {
    EXPECT_NE(broken_rule(*fit, {}, {}, {}), "");
  }
}

}  // namespace
}  // namespace stairway::detect
