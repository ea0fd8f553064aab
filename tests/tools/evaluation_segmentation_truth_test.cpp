// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"
#include "tools/evaluation/segmentation_truth.hpp"

namespace stairway::evaluation {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

// One step seen from the front: a riser at x = 2, 0.2 m high, and a tread of 0.3 m behind it, both 1 m wide.
class OneStep : public testing::Test {
 protected:
  OneStep() {
    mesh_.add_polygon(Corners{{2, 0, 0}, {2, 1, 0}, {2, 1, 0.2}, {2, 0, 0.2}});
    mesh_.add_polygon(Corners{{2, 0, 0.2}, {2, 1, 0.2}, {2.3, 1, 0.2}, {2.3, 0, 0.2}});
    planes_ = truth_planes(mesh_.triangles());
    cloud_.sensor_origin = Eigen::Vector3f(0, 0.5F, 1.0F);
  }

  // 11 points on the riser and 40 on the tread.
  void measure_step() {
    for (int i = 0; i < 11; ++i) cloud_.points.emplace_back(2.0F, 0.09F * static_cast<float>(i), 0.1F);
    for (int i = 0; i < 40; ++i) cloud_.points.emplace_back(2.15F, 0.02F * static_cast<float>(i), 0.2F);
  }

  PointTruth assign(std::span<const TruthPlane> others = {}, const TruthRules& rules = {}) const {
    return assign_points(cloud_, planes_, others, sim::Bvh(mesh_), rules);
  }

  static constexpr std::uint32_t kRiser = 0;
  static constexpr std::uint32_t kTread = 1;
  sim::Mesh mesh_;
  std::vector<TruthPlane> planes_;
  scan::PointCloud cloud_;
};

TEST_F(OneStep, shows_its_tread_only_from_above_and_its_riser_only_from_before) {
  const sim::Bvh scene(mesh_);
  EXPECT_TRUE(is_visible(planes_[kRiser], scene, {0, 0.5F, 1.0F}, {}));
  EXPECT_TRUE(is_visible(planes_[kTread], scene, {0, 0.5F, 1.0F}, {}));
  EXPECT_FALSE(is_visible(planes_[kTread], scene, {0, 0.5F, 0.1F}, {})) << "hidden behind the riser";
  EXPECT_TRUE(is_visible(planes_[kRiser], scene, {0, 0.5F, 0.1F}, {}));
}

TEST_F(OneStep, is_hidden_by_a_wall_before_it) {
  mesh_.add_polygon(Corners{{1, -5, -1}, {1, 5, -1}, {1, 5, 5}, {1, -5, 5}});
  EXPECT_FALSE(is_visible(planes_[kRiser], sim::Bvh(mesh_), {0, 0.5F, 1.0F}, {}));
}

TEST_F(OneStep, owns_the_points_that_lie_nearest) {
  cloud_.points = {{1.97F, 0.5F, 0.1F},    // 3 cm before the riser
                   {2.2F, 0.5F, 0.24F},    // 4 cm above the tread
                   {1.9F, 0.5F, 0.1F},     // 10 cm off
                   {2.2F, 0.5F, 0.1F},     // inside, 10 cm from both
                   {2.02F, 0.5F, 0.19F}};  // inside, 1 cm below the tread, 2 cm behind the riser
  const PointTruth truth = assign({}, {.min_points = 1});
  EXPECT_EQ(truth.plane_of, (std::vector<std::uint32_t>{kRiser, kTread, kNoPlane, kNoPlane, kTread}));
}

TEST_F(OneStep, leaves_points_to_a_plane_of_the_room_that_is_nearer) {
  sim::Mesh room;
  room.add_polygon(Corners{{0, -5, 0}, {0, 5, 0}, {9, 5, 0}, {9, -5, 0}});
  cloud_.points = {{1.97F, 0.5F, 0.01F}, {1.97F, 0.5F, 0.1F}};
  const PointTruth truth = assign(truth_planes(room.triangles()), {.min_points = 1});
  EXPECT_EQ(truth.plane_of, (std::vector<std::uint32_t>{kNoPlane, kRiser}));
}

TEST_F(OneStep, has_no_detectable_plane_with_too_few_points) {
  measure_step();
  const PointTruth truth = assign();
  EXPECT_EQ(truth.is_detectable, (std::vector<bool>{false, true})) << "11 and 40 points";
  EXPECT_EQ(truth.plane_of[0], kNoPlane);
  EXPECT_EQ(truth.plane_of[20], kTread);
}

// A grid of points from y = 0 over `length_m` along the tread, x from 2.01 to 2.29.
detect::PlaneRegion region_on_tread(scan::PointCloud& cloud, double start_m, double length_m, double z_m) {
  const auto first = static_cast<std::uint32_t>(cloud.points.size());
  detect::test::add_rectangle(cloud, {2.01, start_m + 0.01, z_m}, {0.28, 0, 0}, {0, length_m - 0.02, 0}, 0.02);
  std::vector<std::uint32_t> points;
  for (auto i = first; i < cloud.points.size(); ++i) points.push_back(i);
  return detect::make_region(cloud, std::move(points));
}

TEST_F(OneStep, is_matched_by_regions_that_lie_on_it) {
  const std::vector<bool> all{true, true};
  const auto match = [&](const detect::PlaneRegion& region) {
    return match_regions(std::span(&region, 1), cloud_.points, planes_, all).front();
  };
  EXPECT_EQ(match(region_on_tread(cloud_, 0.0, 1.0, 0.2)), kTread);
  EXPECT_EQ(match(region_on_tread(cloud_, 0.4, 0.2, 0.2)), kTread) << "a small piece of it";
  EXPECT_EQ(match(region_on_tread(cloud_, 0.0, 1.0, 0.24)), kTread) << "4 cm above";
  EXPECT_EQ(match(region_on_tread(cloud_, 0.0, 1.0, 0.26)), kNoPlane) << "6 cm above";
  EXPECT_EQ(match(region_on_tread(cloud_, 0.0, 1.9, 0.2)), kTread) << "10 of 19 cells long";
  EXPECT_EQ(match(region_on_tread(cloud_, 0.0, 2.2, 0.2)), kNoPlane) << "10 of 22";
}

TEST_F(OneStep, is_not_matched_when_it_is_not_detectable_or_the_region_is_tilted) {
  const detect::PlaneRegion flat = region_on_tread(cloud_, 0.0, 1.0, 0.2);
  EXPECT_EQ(match_regions(std::span(&flat, 1), cloud_.points, planes_, {true, false}).front(), kNoPlane);
  for (const double tilt_deg : {12.0, 18.0}) {
    detect::PlaneRegion tilted = flat;
    tilted.axes.axes.col(2) = Eigen::Vector3d(std::sin(tilt_deg * M_PI / 180), 0, std::cos(tilt_deg * M_PI / 180));
    EXPECT_EQ(match_regions(std::span(&tilted, 1), cloud_.points, planes_, {true, true}).front(),
              tilt_deg < 15 ? kTread : kNoPlane);
  }
}

TEST(SegmentationMeasures, are_the_shares_of_planes_and_points) {
  // Planes 0, 1 and 2 have 4, 4 and 2 points; plane 3 is not detectable; two points belong to nothing.
  const PointTruth truth{{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, kNoPlane, kNoPlane}, {true, true, true, false}};
  const std::vector<detect::PlaneRegion> regions{
      {{0, 1, 2, 10}, {}},  // found plane 0 with 3 of its points and a stray one
      {{3, 4}, {}},         // found plane 0 again, 1 of its points and a wrong one
      {{5, 6, 7}, {}},      // found plane 1, 3 of its points
      {{8, 9, 11}, {}}};    // found nothing
  const std::vector<std::uint32_t> match_of{0, 0, 1, kNoPlane};
  const SegmentationMeasures measures = measure(regions, match_of, truth);
  EXPECT_DOUBLE_EQ(measures.plane_recall, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(measures.plane_precision, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(measures.point_recall, 7.0 / 10.0);
  EXPECT_DOUBLE_EQ(measures.point_precision, 7.0 / 9.0);
}

TEST(SegmentationMeasures, of_nothing_are_zero) {
  const SegmentationMeasures measures = measure({}, {}, {{kNoPlane}, {false}});
  EXPECT_EQ(measures.plane_recall, 0.0);
  EXPECT_EQ(measures.point_precision, 0.0);
}

}  // namespace
}  // namespace stairway::evaluation
