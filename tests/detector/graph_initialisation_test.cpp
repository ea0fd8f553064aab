// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/graph_initialisation.hpp"

#include <gtest/gtest.h>

#include "tests/detector/part_fixtures.hpp"

namespace stairway::detect {
namespace {

const StairModel kModel = test::make_model(0.17, 0.29, 0.4, {1.5, -0.3, 0.17});

void expect_same(const StairModel& model, const StairModel& expected) {
  EXPECT_NEAR(model.height_m, expected.height_m, 1e-9);
  EXPECT_NEAR(model.depth_m, expected.depth_m, 1e-9);
  EXPECT_LT((model.descent - expected.descent).norm(), 1e-9);
  EXPECT_NEAR(model.nosing.dot(model.descent), expected.nosing.dot(expected.descent), 1e-9);
  EXPECT_NEAR(model.nosing.z(), expected.nosing.z(), 1e-9);
}

TEST(GraphInitialisation, of_two_risers_takes_h_from_their_tops_and_from_their_bottoms) {
  const std::vector<StairPart> parts{test::riser_of(kModel, 0), test::riser_of(kModel, 1)};
  const std::vector<Initialisation> starts = initialise_graphs(parts);
  ASSERT_EQ(starts.size(), 2U);
  for (const Initialisation& start : starts) {
    EXPECT_EQ(start.parts, (std::array<std::size_t, 2>{0, 1}));
    expect_same(start.model, kModel);
  }
}

TEST(GraphInitialisation, of_two_risers_survives_one_hidden_edge) {
  const std::vector<StairPart> parts{test::riser_of(kModel, 0), test::riser_of(kModel, 1, 1.2, 0.05)};
  const std::vector<Initialisation> starts = initialise_graphs(parts);
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_NEAR(starts[0].model.height_m, 0.17, 1e-9) << "h_tt";
  EXPECT_NEAR(starts[1].model.height_m, 0.22, 1e-9) << "h_bb";
}

TEST(GraphInitialisation, does_not_mind_where_the_normals_point_or_which_part_comes_first) {
  std::vector<StairPart> parts{test::riser_of(kModel, 1), test::riser_of(kModel, 0)};
  parts[0].facing = -parts[0].facing;
  const std::vector<Initialisation> starts = initialise_graphs(parts);
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_EQ(starts[0].parts, (std::array<std::size_t, 2>{1, 0}));
  expect_same(starts[0].model, kModel);
}

TEST(GraphInitialisation, of_two_treads_takes_d_and_s_from_either) {
  const std::vector<StairPart> parts{test::tread_of(kModel, 0), test::tread_of(kModel, 1)};
  const std::vector<Initialisation> starts = initialise_graphs(parts);
  ASSERT_EQ(starts.size(), 4U);
  for (const Initialisation& start : starts) expect_same(start.model, kModel);
}

TEST(GraphInitialisation, refuses_what_no_stairway_is) {
  const auto count = [](double h, double d) {
    const StairModel model = test::make_model(h, d);
    return initialise_graphs({test::riser_of(model, 0), test::riser_of(model, 1)}).size();
  };
  EXPECT_EQ(count(0.17, 0.29), 2U);
  EXPECT_EQ(count(0.09, 0.29), 0U) << "too low";
  EXPECT_EQ(count(0.30, 0.30), 0U) << "too high";
  EXPECT_EQ(count(0.17, 0.45), 0U) << "too deep";
  EXPECT_EQ(count(0.17, 0.02), 0U) << "a wall of shelves";
}

TEST(GraphInitialisation, refuses_parts_side_by_side_or_crosswise) {
  const StairModel model = test::make_model(0.17, 0.29);
  StairPart aside = test::riser_of(model, 1, 0.5);
  for (Eigen::Vector3d* p :
       {&aside.centroid, &aside.top, &aside.bottom, &aside.front, &aside.back, &aside.end_a, &aside.end_b})
    p->y() += 0.6;
  EXPECT_TRUE(initialise_graphs({test::riser_of(model, 0, 0.5), aside}).empty());
  StairPart across = test::riser_of(model, 1);
  across.facing = Eigen::Vector3d::UnitY();
  EXPECT_TRUE(initialise_graphs({test::riser_of(model, 0), across}).empty());
  EXPECT_TRUE(initialise_graphs({test::riser_of(model, 0), test::tread_of(model, 1)}).empty());
}

}  // namespace
}  // namespace stairway::detect
