// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "tools/sim/scene_file.hpp"

namespace stairway::sim {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "test.toml");
  } catch (const SceneFileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SimSceneFile, errors_name_file_line_and_key) {
  const struct {
    const char* text;
    const char* expected;
  } cases[] = {
      {"[room]\nx_m = [-4, 8]\nheigth_m = 2\n", "test.toml:3: room.heigth_m is no key here"},
      {"[[stairs]]\n\nsteps = 2.5\n", "test.toml:3: stairs[0].steps must be a whole number"},
      {"[[stairs]]\n[[stairs]]\nwidth_m = \"wide\"\n", "test.toml:3: stairs[1].width_m must be a number"},
      {"[[stairs]]\nwidth_m = inf\n", "test.toml:2: stairs[0].width_m must be a number"},
      {"[[stairs]]\nrisers = \"glass\"\n", "test.toml:2: stairs[0].risers must be one of \"closed\", \"open\""},
      {"[[stairs]]\nposition_m = [1, 2, 3]\n", "test.toml:2: stairs[0].position_m must be a list of 2 numbers"},
      {"[[stairs]]\nposition_m = [2, 0]\nbearing_deg = 3\n",
       "test.toml:1: stairs[0]: give either position_m or distance_m"},
      {"\n[[stairs]]\nheight_m = 5\n", "test.toml:2: stairs[0]: height_m = 5 is not within"},
      {"[[furniture]]\nposition_m = [1, 1]\n", "test.toml:1: furniture[0]: needs a kind"},
      {"[[furniture]]\nkind = \"table\"\n", "test.toml:1: furniture[0]: needs position_m"},
      {"[[furniture]]\nkind = \"sofa\"\n", "test.toml:2: furniture[0].kind must be one of \"box\""},
      {"[stairs]\nsteps = 3\n", "test.toml:1: write [[stairs]] for each"},
      {"room = 3\n", "test.toml:1: write [room]"},
      {"[lamp]\n", "test.toml:1: lamp is no key here"},
      {"[room]\nx_m = \n", "test.toml:2: "},
      {"[room]\nx_m = [1, 8]\n", "test.toml: room: must hold the robot"},
      {"[[stairs]]\nposition_m = [7, 0]\n", "test.toml: stairs[0]: the flight with its landing does not fit"},
  };
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(text);
    EXPECT_NE(error_of(text).find(expected), std::string::npos) << error_of(text);
  }
}

TEST(SimSceneFile, reads_every_key_of_a_flight) {
  const SceneSpec spec = parse_scene(R"([room]
x_m = [-9, 9]
y_m = [-9, 9]
height_m = 5
[[stairs]]
steps = 3
height_m = 0.18
depth_m = 0.27
width_m = 1
risers = "open"
tread_thickness_m = 0.05
overhang_m = 0.01
railing = "left"
landing_m = 1.1
distance_m = 3
bearing_deg = 90
heading_deg = 100
level_m = 0.5
turn_per_step_deg = 10
height_offsets_m = [0, 0.01, 0]
depth_offsets_m = [0.01, 0, 0]
)",
                                     "t");
  EXPECT_EQ(spec.room.high.x(), 9);
  EXPECT_EQ(spec.room.height_m, 5);
  ASSERT_EQ(spec.stairs.size(), 1U);
  const StairSpec& stairs = spec.stairs[0];
  EXPECT_EQ(stairs.steps, 3);
  EXPECT_EQ(stairs.height_m, 0.18);
  EXPECT_EQ(stairs.depth_m, 0.27);
  EXPECT_EQ(stairs.width_m, 1.0);
  EXPECT_TRUE(stairs.open_risers);
  EXPECT_EQ(stairs.tread_thickness_m, 0.05);
  EXPECT_EQ(stairs.overhang_m, 0.01);
  EXPECT_TRUE(stairs.railing_left);
  EXPECT_FALSE(stairs.railing_right);
  EXPECT_EQ(stairs.landing_m, 1.1);
  EXPECT_NEAR((stairs.position - Eigen::Vector2d{0, 3}).norm(), 0, 1e-12);
  EXPECT_NEAR(stairs.heading_rad, 100 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(stairs.level_m, 0.5);
  EXPECT_NEAR(stairs.turn_per_step_rad, 10 * std::numbers::pi / 180, 1e-12);
  EXPECT_EQ(stairs.height_offsets_m, (std::vector<double>{0, 0.01, 0}));
  EXPECT_EQ(stairs.depth_offsets_m, (std::vector<double>{0.01, 0, 0}));
}

TEST(SimSceneFile, without_a_heading_the_flight_faces_the_robot) {
  EXPECT_NEAR(parse_scene("[[stairs]]\nposition_m = [0, 2]\nsteps = 2\nlanding_m = 0.5\n", "t").stairs[0].heading_rad,
              std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(
      parse_scene("[[stairs]]\nposition_m = [0, 2]\nsteps = 2\nlanding_m = 0.5\ndirection = \"descending\"\n", "t")
          .stairs[0]
          .heading_rad,
      -std::numbers::pi / 2, 1e-12);
}

TEST(SimSceneFile, every_shipped_scene_can_be_built) {
  const auto names = shipped_scene_names();
  EXPECT_GE(names.size(), 6U);
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const SceneSpec spec = load_scene(name);
    EXPECT_EQ(spec.name, name);
    EXPECT_EQ(build_scene(spec).truths.size(), spec.stairs.size());
  }
}

TEST(SimSceneFile, finds_scenes_by_seed_and_path) {
  EXPECT_EQ(load_scene("random-stairs:17").stairs.size(), 1U);
  EXPECT_TRUE(load_scene("random-room:17").stairs.empty());
  const std::string path = testing::TempDir() + "/sim_scene_file_test.toml";
  std::ofstream{path} << "[room]\nheight_m = 4\n";
  EXPECT_EQ(load_scene(path).room.height_m, 4);
}

TEST(SimSceneFile, says_what_there_is_when_a_name_is_unknown) {
  for (const char* name : {"stairs", "", "random-stairs:", "random-stairs:-1", "random-room:1x"}) {
    SCOPED_TRACE(name);
    try {
      load_scene(name);
      FAIL();
    } catch (const SceneFileError& error) {
      EXPECT_NE(std::string{error.what()}.find("straight-flight"), std::string::npos);
    }
  }
  EXPECT_THROW(load_scene("/nonexistent/scene.toml"), SceneFileError);
}

}  // namespace
}  // namespace stairway::sim
