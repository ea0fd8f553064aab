// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "ipc/cloud_file.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/evaluation/depth_camera.hpp"
#include "tools/sim/helmet_scene.hpp"

namespace stairway::evaluation {
namespace {

const Table& table(const Result& result, std::string_view name) {
  for (const Table& candidate : result.tables) {
    if (candidate.name == name) return candidate;
  }
  throw std::runtime_error("no such table");
}

void expect_full_rows(const Result& result) {
  for (const Table& each : result.tables) {
    for (const auto& row : each.rows) EXPECT_EQ(row.size(), each.columns.size()) << each.name;
  }
}

TEST(DepthCameraExperiment, tells_rates_steps_and_errors_beside_the_paper) {
  Request request;
  request.seed = 1000;
  request.share = 0.02;  // two frames with stairs, one without
  double last = 0.0;
  request.progress = [&](double done, std::string_view) { last = done; };
  const Result result = run_depth_camera(request);
  expect_full_rows(result);
  EXPECT_EQ(last, 1.0);
  const auto& rates = table(result, "depth-camera-rates").rows;
  EXPECT_EQ(std::get<double>(rates[0][1]), 2.0);
  EXPECT_EQ(std::get<double>(rates[0][2]), 1.0);
  EXPECT_EQ(std::get<double>(rates[0][3]), 100.0);
  EXPECT_EQ(std::get<double>(rates[0][4]), 100.0);
  EXPECT_EQ(table(result, "depth-camera-steps").rows.size(), 10U);
  EXPECT_EQ(table(result, "depth-camera-errors").rows.size(), 2U);
  ASSERT_EQ(result.charts.size(), 1U);
  EXPECT_FALSE(result.notes.empty());
}

TEST(DepthCameraExperiment, takes_the_frames_of_a_folder_instead) {
  const test::TemporaryFolder folder;
  const sim::HelmetScene view = sim::random_helmet_scene(1002, sim::HelmetSubject::Ascending);
  const sim::DepthCameraOptions camera;
  const auto image = simulate_depth_image(sim::build_scene(view.scene), view.pose, camera, 1002);
  ASSERT_TRUE(ipc::write_ply(folder.path("a.ply"), sim::to_cloud(image, camera.intrinsics, view.pose), {}));
  test::write_text(folder.path("labels.csv"), "file,stairs\na.ply,ascending\na.ply,none\n");
  Request request;
  request.data = folder.path();
  const Result result = run_depth_camera(request);
  test::write_text(folder.path("labels.csv"), "file,stairs\nb.ply,ascending\n");
  EXPECT_THROW(run_depth_camera(request), std::runtime_error);
  expect_full_rows(result);
  const auto& rates = table(result, "depth-camera-rates").rows;
  EXPECT_EQ(std::get<double>(rates[0][3]), 100.0);
  EXPECT_EQ(std::get<double>(rates[0][4]), 0.0);
}

}  // namespace
}  // namespace stairway::evaluation
