// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/stairway_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ipc/stairway_text.hpp"
#include "tests/ipc/message_fixtures.hpp"

namespace stairway::ipc {
namespace {

detect::Detection one_stairway() { return {{test::sample_stairway()}, {}}; }

TEST(DetectionJson, is_one_line_with_every_field_of_the_contract) {
  const std::string line = detection_json("a.pcd", 1513400, {{"total", 812.3456}, {"read", 12.0}}, one_stairway());
  EXPECT_EQ(
      line,
      "{\"source\":\"a.pcd\",\"points\":1513400,\"timing_ms\":{\"total\":812.346,\"read\":12.0},"
      "\"stairways\":[{\"kind\":\"spiral\",\"direction\":\"descending\",\"steps\":3,"
      "\"step_height\":0.170123,\"step_depth\":0.29,\"width\":1.2,\"pitch\":0.530533,\"heading\":-0.333333,"
      "\"turn_per_step\":0.1,\"step_height_sigma\":0.0002,\"step_depth_sigma\":0.0003,\"width_sigma\":0.002,"
      "\"heading_sigma\":0.0004,\"anchor\":[1.0,-2.0,0.0],\"anchor_side\":\"left\","
      "\"railing\":{\"left\":true,\"right\":false},"
      "\"nosings\":[[[1.0,2.0,3.0],[4.0,5.0,6.0]],[[7.0,8.0,9.0],[10.0,11.0,12.0]],"
      "[[0.1,0.2,0.3],[-0.4,-0.5,-0.6]]],\"irregular\":false,\"step_sizes\":[],\"score\":12.5}],\"rejected\":[]}");
}

TEST(DetectionJson, without_stairways_tells_why) {
  const detect::Detection detection{{}, {{"too-few-steps", "2 steps, 3 are needed", {{"steps", 2.0}}}}};
  EXPECT_EQ(detection_json("a.pcd", 0, {}, detection),
            "{\"source\":\"a.pcd\",\"points\":0,\"timing_ms\":{},\"stairways\":[],\"rejected\":[{\"reason\":"
            "\"too-few-steps\",\"detail\":\"2 steps, 3 are needed\",\"figures\":{\"steps\":2.0}}]}");
}

TEST(DetectionJson, tiny_negative_numbers_become_zero_and_not_finite_ones_null) {
  detect::Detection detection = one_stairway();
  detection.stairways[0].heading = -1e-9;
  detection.stairways[0].width = std::numeric_limits<double>::quiet_NaN();
  detection.stairways[0].score = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(detection_json("a", 1, {}, detection));
  EXPECT_EQ(json["stairways"][0]["heading"].dump(), "0.0");
  EXPECT_TRUE(json["stairways"][0]["width"].is_null());
  EXPECT_TRUE(json["stairways"][0]["score"].is_null());
}

TEST(DetectionJson, is_valid_whatever_the_file_is_called) {
  for (const std::string& name : {std::string("two\nlines\"\\"), std::string("\xff\xfe.pcd"), std::string("\0x", 2)}) {
    const std::string line = detection_json(name, 1, {}, {});
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  }
}

TEST(DetectionText, shows_a_table_row_per_stairway_and_the_rejections) {
  detect::Detection detection = one_stairway();
  detection.rejected = {{"too-few-steps", "2 steps, 3 are needed", {}}};
  EXPECT_EQ(
      detection_text("a.pcd", 1000, {{"total", 812.3456}, {"read", 12.0}}, detection),
      "a.pcd: 1000 points, 1 stairway\n"
      "  kind    direction   steps  height [mm]  depth [mm]   width [mm]    pitch [deg]  heading [deg]  turn [deg] "
      " anchor x y z [mm]  railing\n"
      "  spiral  descending  3      170.1 +-0.2  290.0 +-0.3  1200.0 +-2.0  30.4         -19.1 +-0.0    5.7        "
      " 1000 -2000 0 left  left\n"
      "  rejected: 2 steps, 3 are needed (too-few-steps)\n"
      "  time: total 812.3 ms, read 12.0 ms\n");
}

TEST(DetectionText, lists_the_steps_of_an_irregular_stairway_below_the_table) {
  detect::Detection detection = one_stairway();
  detection.stairways[0].is_irregular = true;
  detection.stairways[0].step_sizes = {{0.17, 0.001, 0.29, 0.002}, {0.1821, 0.0011, 0.288, 0.0021}};
  const std::string text = detection_text("a.pcd", 1000, {}, detection);
  EXPECT_TRUE(
      text.ends_with("  stairway 1 is irregular; its steps from below:\n"
                     "    heights [mm]  170.0 +-1.0, 182.1 +-1.1\n"
                     "    depths [mm]   290.0 +-2.0, 288.0 +-2.1\n"))
      << text;
}

TEST(DetectionText, says_that_nothing_was_found) {
  EXPECT_EQ(detection_text("a.pcd", 5, {}, {}), "a.pcd: 5 points, no stairways\n");
}

}  // namespace
}  // namespace stairway::ipc
