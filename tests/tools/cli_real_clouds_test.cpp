// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/cli_process.hpp"

/// Clouds that real sensors took of real stairs; the limits were read off the clouds by hand.
namespace stairway {
namespace {

using nlohmann::json;

struct RealStair {
  const char* file;
  std::vector<std::string> settings;
  double min_height_m, max_height_m;
  double min_depth_m, max_depth_m;
};

void PrintTo(const RealStair& stair, std::ostream* out) { *out << stair.file; }

class RealClouds : public ::testing::TestWithParam<RealStair> {};

TEST_P(RealClouds, best_stairway_has_the_measures_of_the_real_one) {
  const char* folder = std::getenv("STAIRWAY_SHARED_DATA");
  const auto file = std::filesystem::path(folder ? folder : STAIRWAY_SHARED_DATA) / "clouds" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here; set STAIRWAY_SHARED_DATA to its folder";
  std::vector<std::string> arguments{"detect", "--format", "json", file.string()};
  arguments.insert(arguments.end(), GetParam().settings.begin(), GetParam().settings.end());
  const test::Outcome outcome = test::run_stairway(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  ASSERT_FALSE(answer["stairways"].empty()) << answer["rejected"];
  const json& best = answer["stairways"][0];
  EXPECT_GE(best["step_height"].get<double>(), GetParam().min_height_m);
  EXPECT_LE(best["step_height"].get<double>(), GetParam().max_height_m);
  EXPECT_GE(best["step_depth"].get<double>(), GetParam().min_depth_m);
  EXPECT_LE(best["step_depth"].get<double>(), GetParam().max_depth_m);
}

const std::vector<std::string> kCamera{"--profile", "depth-camera"};
// Its x axis points down, within three degrees.
const std::vector<std::string> kCameraAsTaken{"--profile", "depth-camera",     "--set", "input.gravity=[1, 0, 0]",
                                              "--set",     "input.level=floor"};

// The first reading of the metal stair divides its run of 4.97 m by 22 risers: 226 mm. Between its first and its last
// nosing lie 21 treads, which makes 237 mm; where the fit comes nearer to that, the upper limit follows.
const std::vector<std::string> kSeenFromAbove{"--set", "input.sensor_m=[0.2, 0, 1.72]"};
const std::vector<std::string> kAsTaken{"--set", "input.level=floor", "--set", "input.sensor_m=[0, 0, 0]"};

INSTANTIATE_TEST_SUITE_P(
    All, RealClouds,
    ::testing::Values(RealStair{"lidar_metal_stair.pcd", kSeenFromAbove, 0.194, 0.202, 0.218, 0.242},
                      RealStair{"lidar_metal_stair_unlevelled.pcd", kAsTaken, 0.194, 0.202, 0.218, 0.242},
                      RealStair{"kinect2_stair_level.pcd", kCamera, 0.1035, 0.112, 0.270, 0.283},
                      RealStair{"kinect2_stair.pcd", kCameraAsTaken, 0.1035, 0.112, 0.270, 0.283}),
    [](const auto& stair) { return std::filesystem::path(stair.param.file).stem().string(); });

}  // namespace
}  // namespace stairway
