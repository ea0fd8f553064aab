// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/stair_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

StairGraph graph_of(const StairModel& model, std::size_t count) {
  StairGraph graph{.model = model};
  for (std::size_t i = 0; i < count; ++i) graph.parts.push_back({static_cast<int>(i), i});
  return graph;
}

TEST(StairFit, finds_the_model_its_parts_were_made_from) {
  const StairModel truth = test::make_model(0.168, 0.301, 0.5, {1.0, 0.7, 0.17});
  const std::vector<StairPart> parts = test::flight_of_risers(truth, 8);
  StairModel start = truth;
  start.height_m += 0.004;
  start.depth_m -= 0.005;
  start.descent = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()) * start.descent;
  start.nosing += Eigen::Vector3d(0.01, 0.0, -0.01);
  const StairFit fit = fit_stairway(graph_of(start, parts.size()), parts, View::FromBelow);
  EXPECT_NEAR(fit.model.height_m, truth.height_m, 2e-5);
  EXPECT_NEAR(fit.model.depth_m, truth.depth_m, 2e-5);
  EXPECT_GT(fit.model.descent.dot(truth.descent), 1.0 - 1e-8);
}

TEST(StairFit, tells_an_uncertainty_that_grows_with_the_scatter) {
  const StairModel truth = test::make_model(0.17, 0.29);
  std::mt19937 engine(4);
  const auto sigma_at = [&](double scatter) {
    std::normal_distribution<double> noise(0.0, scatter);
    std::vector<StairPart> parts = test::flight_of_risers(truth, 10);
    for (StairPart& part : parts) {
      part.centroid.x() += noise(engine);
      part.top.z() += noise(engine);
    }
    return fit_stairway(graph_of(truth, parts.size()), parts, View::FromBelow).sigmas.height_m;
  };
  EXPECT_GT(sigma_at(0.010), 3.0 * sigma_at(0.001));
}

TEST(StairFit, leaves_a_model_alone_that_too_few_parts_support) {
  const StairModel model = test::make_model(0.17, 0.29);
  const std::vector<StairPart> parts = test::flight_of_risers(model, 1);
  EXPECT_EQ(fit_stairway(graph_of(model, 1), parts, View::FromBelow).model.height_m, model.height_m);
}

}  // namespace
}  // namespace stairway::detect
