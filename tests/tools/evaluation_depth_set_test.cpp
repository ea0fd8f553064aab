// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/tools/temporary_folder.hpp"
#include "tools/evaluation/depth_frame.hpp"
#include "tools/evaluation/depth_set.hpp"

namespace stairway::evaluation {
namespace {

class DepthSet : public ::testing::Test {
 protected:
  void write(const std::string& text) const { test::write_text(folder_.path("labels.csv"), text); }

  std::string failure() const {
    try {
      read_labels(folder_.path());
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  const test::TemporaryFolder folder_;
};

TEST_F(DepthSet, names_clouds_labels_and_gravity) {
  write("# indoors\nfile,stairs,gx,gy,gz\na.pcd,ascending,0,9.8,0\r\n\nsub/b.ply,none,,,\nc.pcd,descending\n");
  const auto frames = read_labels(folder_.path());
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].cloud, folder_.path("a.pcd"));
  EXPECT_EQ(frames[0].label, FrameLabel::Ascending);
  ASSERT_TRUE(frames[0].gravity);
  EXPECT_EQ(*frames[0].gravity, Eigen::Vector3d(0, 9.8, 0));
  EXPECT_EQ(frames[1].label, FrameLabel::None);
  EXPECT_FALSE(frames[1].gravity);
  EXPECT_EQ(frames[2].label, FrameLabel::Descending);
}

TEST_F(DepthSet, says_which_line_is_wrong) {
  EXPECT_NE(failure().find("labels.csv: cannot be opened"), std::string::npos) << failure();
  for (const auto& [text, what] : {std::pair{"a.pcd,none\n", ":1: the first line"},
                                   {"file,stairs\na.pcd,stairs\n", ":2: \"stairs\" must be"},
                                   {"file,stairs\n\na.pcd\n", ":3: must have 2 fields"},
                                   {"file,stairs\n,none\n", ":2: has no file"},
                                   {"file,stairs,gx,gy,gz\na.pcd,none,0,x,1\n", ":2: \"x\" must be a number"},
                                   {"file,stairs,gx,gy,gz\na.pcd,none,0,0,0\n", ":2: gravity"},
                                   {"file,stairs\n", "names no frame"}}) {
    SCOPED_TRACE(text);
    write(text);
    EXPECT_NE(failure().find(what), std::string::npos) << failure();
  }
}

detect::Stairway five_steps(double shift_m, double height_m = 0.17) {
  detect::Stairway stairway;
  stairway.step_height = height_m;
  stairway.step_depth = 0.3;
  for (int i = 0; i < 5; ++i) {
    stairway.nosings.push_back(
        {{1 + 0.3 * i + shift_m, 0.5, height_m * (i + 1)}, {1 + 0.3 * i + shift_m, -0.5, height_m * (i + 1)}});
  }
  return stairway;
}

TEST(DepthFrame, counts_the_steps_of_the_true_stairway_from_the_sensor) {
  const detect::Stairway truth = five_steps(0.0);
  detect::Stairway found = five_steps(0.02, 0.175);
  found.nosings.pop_back();
  DepthFrame frame;
  compare(frame, truth, {found});
  EXPECT_TRUE(frame.is_found);
  EXPECT_EQ(frame.others, 0U);
  EXPECT_EQ(frame.is_step_found, (std::vector<bool>{true, true, true, true, false}));
  EXPECT_NEAR(*frame.height_error_m, 0.005, 1e-12);

  detect::Stairway down = truth;
  down.direction = found.direction = detect::StairwayDirection::Descending;
  frame = {};
  compare(frame, down, {found});
  EXPECT_EQ(frame.is_step_found, (std::vector<bool>{false, true, true, true, true}));
}

TEST(DepthFrame, takes_nothing_else_for_the_true_stairway) {
  DepthFrame frame;
  detect::Stairway wrong_way = five_steps(0.0);
  wrong_way.direction = detect::StairwayDirection::Descending;
  detect::Stairway elsewhere = five_steps(3.0);
  detect::Stairway short_one = five_steps(0.0);
  short_one.nosings.resize(2);
  compare(frame, five_steps(0.0), {wrong_way, elsewhere, short_one});
  EXPECT_FALSE(frame.is_found);
  EXPECT_EQ(frame.others, 3U);
  EXPECT_FALSE(frame.height_error_m);
}

}  // namespace
}  // namespace stairway::evaluation
