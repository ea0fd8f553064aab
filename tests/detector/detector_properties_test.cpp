// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "detector/levelling.hpp"
#include "detector/stairway_detector.hpp"
#include "tests/detector/scene_fixtures.hpp"

namespace stairway::detect {
namespace {

class DetectorProperties : public testing::Test {
 protected:
  static void SetUpTestSuite() { room_ = new test::SimulatedRoom(test::simulate(sim::StairSpec{}, 2.0, 0.2, 8.0)); }
  static void TearDownTestSuite() { delete room_; }
  static const test::SimulatedRoom& room() { return *room_; }

 private:
  inline static test::SimulatedRoom* room_ = nullptr;
};

void expect_same(const Stairway& found, const Stairway& expected, double tolerance_m) {
  EXPECT_NEAR(found.step_height, expected.step_height, tolerance_m);
  EXPECT_NEAR(found.step_depth, expected.step_depth, tolerance_m);
  EXPECT_NEAR(found.width, expected.width, 10 * tolerance_m);
  EXPECT_LT(test::turn_between(found.heading, expected.heading), 5 * tolerance_m);
  ASSERT_EQ(found.nosings.size(), expected.nosings.size());
  EXPECT_LT((found.anchor - expected.anchor).norm(), 10 * tolerance_m);
}

TEST_F(DetectorProperties, finds_the_simulated_flight) {
  const Detection detection = detect_stairways(room().cloud);
  ASSERT_EQ(detection.stairways.size(), 1U);
  const Stairway& found = detection.stairways[0];
  EXPECT_EQ(found.kind, StairwayKind::Straight);
  EXPECT_EQ(found.direction, StairwayDirection::Ascending);
  expect_same(found, room().truth, 0.003);
  for (std::size_t i = 0; i < found.nosings.size(); ++i)
    EXPECT_LT((found.nosings[i].middle() - room().truth.nosings[i].middle()).norm(), 0.02);
  EXPECT_GT(found.step_height_sigma, 0.0);
  EXPECT_GT(found.step_depth_sigma, 0.0);
  EXPECT_GT(found.heading_sigma, 0.0);
}

TEST_F(DetectorProperties, gives_the_same_answer_twice) {
  const Detection once = detect_stairways(room().cloud);
  const Detection again = detect_stairways(room().cloud);
  ASSERT_EQ(once.stairways.size(), again.stairways.size());
  for (std::size_t i = 0; i < once.stairways.size(); ++i) {
    EXPECT_EQ(once.stairways[i].step_height, again.stairways[i].step_height);
    EXPECT_EQ(once.stairways[i].anchor, again.stairways[i].anchor);
  }
}

TEST_F(DetectorProperties, gives_the_same_answer_on_any_number_of_threads) {
  DetectorOptions options;
  options.threads = 1;
  const Detection alone = detect_stairways(room().cloud, options);
  ASSERT_FALSE(alone.stairways.empty());
  for (const int threads : {2, 3, 8}) {
    SCOPED_TRACE(::testing::Message() << threads << " threads");
    options.threads = threads;
    const Detection together = detect_stairways(room().cloud, options);
    ASSERT_EQ(together.stairways.size(), alone.stairways.size());
    for (std::size_t i = 0; i < alone.stairways.size(); ++i) {
      EXPECT_EQ(together.stairways[i].step_height, alone.stairways[i].step_height);
      EXPECT_EQ(together.stairways[i].anchor, alone.stairways[i].anchor);
    }
  }
}

TEST_F(DetectorProperties, does_not_depend_on_the_order_of_points) {
  scan::PointCloud shuffled = room().cloud;
  std::shuffle(shuffled.points.begin(), shuffled.points.end(), std::mt19937(9));
  const Detection detection = detect_stairways(shuffled);
  ASSERT_EQ(detection.stairways.size(), 1U);
  expect_same(detection.stairways[0], detect_stairways(room().cloud).stairways.at(0), 1e-4);
}

TEST_F(DetectorProperties, turns_and_moves_with_the_scene) {
  const Stairway straight = detect_stairways(room().cloud).stairways.at(0);
  for (const double angle : {0.5, 1.9, -2.6}) {
    SCOPED_TRACE(angle);
    const Eigen::Isometry3d turn =
        Eigen::Translation3d(0.31, -1.27, 0.0) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ());
    const Detection detection = detect_stairways(transformed(room().cloud, turn));
    ASSERT_EQ(detection.stairways.size(), 1U);
    Stairway expected = straight;
    expected.heading = std::remainder(straight.heading + angle, 2.0 * M_PI);
    expected.anchor = turn * straight.anchor;
    expect_same(detection.stairways[0], expected, 0.001);
  }
}

TEST_F(DetectorProperties, ignores_points_that_are_not_finite) {
  scan::PointCloud spoilt = room().cloud;
  for (std::size_t i = 0; i < spoilt.points.size(); i += 50)
    spoilt.points.push_back(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  spoilt.points.emplace_back(std::numeric_limits<float>::infinity(), 0.0F, 0.0F);
  const Detection detection = detect_stairways(spoilt);
  ASSERT_EQ(detection.stairways.size(), 1U);
  expect_same(detection.stairways[0], detect_stairways(room().cloud).stairways.at(0), 1e-4);
}

TEST_F(DetectorProperties, works_with_each_strategy_of_the_paper) {
  for (const Strategy strategy : {Strategy::Greedy, Strategy::Thorough, Strategy::Optimizing}) {
    SCOPED_TRACE(static_cast<int>(strategy));
    DetectorOptions options;
    options.competition.strategy = strategy;
    const Detection detection = detect_stairways(room().cloud, options);
    ASSERT_FALSE(detection.stairways.empty());
    // The first initialisation that comes along need not be a good one.
    const double tolerance_m = strategy == Strategy::Greedy ? 0.03 : 0.015;
    EXPECT_NEAR(detection.stairways[0].step_height, room().truth.step_height, tolerance_m);
    EXPECT_NEAR(detection.stairways[0].step_depth, room().truth.step_depth, tolerance_m);
  }
}

TEST_F(DetectorProperties, finds_the_flight_with_each_segmentation_of_the_paper) {
  for (const SegmentationMethod method :
       {SegmentationMethod::RegionGrowing, SegmentationMethod::SplitAndMerge, SegmentationMethod::VoxelSac}) {
    SCOPED_TRACE(static_cast<int>(method));
    DetectorOptions options;
    options.segmentation.method = method;
    const Detection detection = detect_stairways(room().cloud, options);
    ASSERT_EQ(detection.stairways.size(), 1U);
    expect_same(detection.stairways[0], room().truth, 0.003);
  }
}

TEST_F(DetectorProperties, tells_the_stages_in_order) {
  std::vector<std::string> stages;
  detect_stairways(room().cloud, {}, [&](std::string_view stage) { stages.emplace_back(stage); });
  EXPECT_EQ(stages, (std::vector<std::string>{"voxel_grid", "normals", "segmentation", "plane_finder", "stair_graph",
                                              "fit", "railing", "localisation"}));
}

}  // namespace
}  // namespace stairway::detect
