// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/tools/temporary_folder.hpp"
#include "tools/evaluation/paper_stairways.hpp"
#include "tools/evaluation/segmentation.hpp"
#include "tools/sim/stl_file.hpp"

namespace stairway::evaluation {
namespace {

TEST(SegmentationExperiment, places_every_stairway_in_its_room) {
  for (int position = 0; position < 50; ++position) {
    SCOPED_TRACE(position);
    const sim::SceneSpec spec = segmentation_scene(1000, position);
    EXPECT_EQ(spec.problem(), "");
    const double distance = spec.stairs.front().position.norm();
    EXPECT_GE(distance, 1.0);
    EXPECT_LE(distance, 4.5);
  }
}

TEST(SegmentationExperiment, repeats_a_position_and_varies_them_by_the_seed) {
  EXPECT_EQ(segmentation_scene(1000, 3).stairs[0].position, segmentation_scene(1000, 3).stairs[0].position);
  EXPECT_NE(segmentation_scene(1000, 3).stairs[0].position, segmentation_scene(1001, 3).stairs[0].position);
}

TEST(SegmentationExperiment, gives_the_four_measures_of_three_methods) {
  Request request;
  request.seed = 1000;
  request.share = 0.01;
  const Result result = run_segmentation(request);
  ASSERT_EQ(result.tables.size(), 2U);
  ASSERT_EQ(result.tables[0].rows.size(), 12U);
  for (const auto& row : result.tables[0].rows) {
    ASSERT_EQ(row.size(), result.tables[0].columns.size());
    const double mean = std::get<double>(row[3]);
    EXPECT_GT(mean, 20.0);
    EXPECT_LE(mean, 100.0);
  }
  ASSERT_EQ(result.tables[1].rows.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(result.tables[1].rows[1][1])) << "no normals to split and merge";
  ASSERT_EQ(result.charts.size(), 2U);
  for (const Chart& chart : result.charts)
    for (const Curve& curve : chart.curves) EXPECT_EQ(curve.y.size(), chart.categories.size());
}

TEST(SegmentationExperiment, takes_a_model_from_a_file_as_it_takes_its_own) {
  const test::TemporaryFolder folder;
  Request request;
  request.seed = 1000;
  request.share = 0.01;  // one position, before stairway I
  const auto own = run_segmentation(request).tables[0].rows;
  request.model = folder.path("stairs.stl");
  sim::write_stl(request.model, sim::flight_model(paper_stairways()[0].flight));
  const Result result = run_segmentation(request);
  EXPECT_EQ(result.tables[0].rows, own);
  EXPECT_NE(result.notes.back().find(request.model.string()), std::string::npos);
  sim::write_stl(request.model, sim::flight_model(paper_stairways()[2].flight));
  EXPECT_NE(run_segmentation(request).tables[0].rows, own);
  sim::write_stl(request.model, sim::build_scene(segmentation_scene(1000, 0)).mesh);
  EXPECT_THROW(run_segmentation(request), std::runtime_error) << "a room is no stairway";
}

}  // namespace
}  // namespace stairway::evaluation
