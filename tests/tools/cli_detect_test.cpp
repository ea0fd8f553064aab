// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "ipc/cloud_file.hpp"
#include "tests/tools/cli_process.hpp"
#include "tests/tools/temporary_folder.hpp"

namespace stairway {
namespace {

using nlohmann::json;
using test::run_stairway;
using test::TemporaryFolder;

const std::vector<std::string> kCoarse{"--set", "disk.period_s=4"};

std::vector<json> json_lines(const std::string& text) {
  std::vector<json> objects;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) objects.push_back(json::parse(line));
  return objects;
}

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

test::Outcome detect(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"detect", "--format", "json"});
  arguments.insert(arguments.end(), kCoarse.begin(), kCoarse.end());
  return run_stairway(arguments);
}

scan::PointCloud read_cloud(const std::string& path) { return ipc::read_cloud_file(path)->cloud; }

/// The flight and the floor before it, cut out of a coarse sweep to be quick; made once.
const std::string& flight_cloud() {
  static const TemporaryFolder folder;
  static const std::string path = [] {
    const std::string file = folder.path("flight.pcd");
    EXPECT_EQ(run_stairway({"simulate", "straight-flight", "--disk-period", "4", "-o", file}).exit_code, 0);
    scan::PointCloud cloud = read_cloud(file);
    std::erase_if(cloud.points, [](const Eigen::Vector3f& p) {
      return p.x() < 1.0F || p.x() > 6.0F || std::abs(p.y()) > 1.2F || p.z() > 2.5F;
    });
    EXPECT_TRUE(ipc::write_pcd(file, cloud));
    return file;
  }();
  return path;
}

void expect_flight(const json& answer) {
  ASSERT_GE(answer["stairways"].size(), 1U);
  const json& flight = answer["stairways"][0];
  EXPECT_EQ(flight["kind"], "straight");
  EXPECT_EQ(flight["direction"], "ascending");
  EXPECT_NEAR(flight["step_height"].get<double>(), 0.170, 0.004);
  EXPECT_NEAR(flight["step_depth"].get<double>(), 0.290, 0.008);
  EXPECT_NEAR(flight["heading"].get<double>(), 0.0, 0.02);
}

TEST(DetectVerb, json_line_has_the_keys_of_the_contract_and_those_of_single_steps_and_level) {
  const auto outcome = detect({"sim:straight-flight"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto answers = json_lines(outcome.out);
  ASSERT_EQ(answers.size(), 1U);
  const json& answer = answers[0];
  EXPECT_EQ(keys(answer), (std::set<std::string>{"level", "source", "points", "timing_ms", "stairways", "rejected"}));
  EXPECT_EQ(keys(answer["level"]), (std::set<std::string>{"roll", "pitch", "sigma", "planes", "floor_slope"}));
  EXPECT_EQ(answer["source"], "sim:straight-flight");
  EXPECT_GT(answer["points"].get<int>(), 100'000);
  EXPECT_GT(answer["timing_ms"]["total"].get<double>(), 0.0);
  ASSERT_EQ(answer["stairways"].size(), 1U);
  EXPECT_EQ(keys(answer["stairways"][0]),
            (std::set<std::string>{
                "kind",          "direction", "steps",         "step_height",       "step_depth",       "width",
                "pitch",         "heading",   "turn_per_step", "step_height_sigma", "step_depth_sigma", "width_sigma",
                "heading_sigma", "anchor",    "anchor_side",   "railing",           "nosings",          "irregular",
                "step_sizes",    "score"}));
  EXPECT_EQ(keys(answer["stairways"][0]["step_sizes"][0]),
            (std::set<std::string>{"height", "height_sigma", "depth", "depth_sigma"}));
  EXPECT_EQ(answer["stairways"][0]["step_sizes"].size(), answer["stairways"][0]["nosings"].size());
  EXPECT_EQ(keys(answer["stairways"][0]["railing"]), (std::set<std::string>{"left", "right"}));
  EXPECT_EQ(answer["stairways"][0]["nosings"].size(), answer["stairways"][0]["steps"].get<std::size_t>());
  expect_flight(answer);
}

TEST(DetectVerb, total_counts_the_stages_but_not_the_reading) {
  const auto outcome = detect({flight_cloud()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json timing = json_lines(outcome.out)[0]["timing_ms"];
  ASSERT_TRUE(timing.contains("read"));
  double stages = 0.0;
  for (const auto& [name, duration] : timing.items())
    if (name != "total" && name != "read") stages += duration.get<double>();
  EXPECT_GE(timing.size(), 4U);
  EXPECT_NEAR(timing["total"].get<double>(), stages, 1.0 + 0.01 * stages);
}

TEST(DetectVerb, other_sources_are_done_when_some_cannot_be_read) {
  const TemporaryFolder folder;
  const std::string bytes = test::read_text(flight_cloud());
  test::write_text(folder.path("truncated.pcd"), bytes.substr(0, bytes.size() / 2));
  test::write_text(folder.path("malformed.ply"), "ply\nformat ascii 1.0\nelement vertex many\nend_header\n");
  test::write_text(folder.path("recording.lcm"), "");
  const auto outcome = detect({folder.path("missing.pcd"), folder.path("truncated.pcd"), folder.path("malformed.ply"),
                               folder.path("recording.lcm"), "sim:no-such-scene", flight_cloud()});
  EXPECT_EQ(outcome.exit_code, 1);
  for (const char* name : {"missing.pcd", "truncated.pcd", "malformed.ply", "recording.lcm", "sim:no-such-scene"})
    EXPECT_NE(outcome.err.find(name), std::string::npos) << name << " is not in: " << outcome.err;
  const auto answers = json_lines(outcome.out);
  ASSERT_EQ(answers.size(), 1U);
  expect_flight(answers[0]);
}

TEST(DetectVerb, every_source_gets_its_line_in_the_order_given) {
  const auto outcome = detect({flight_cloud(), "sim:empty-room", flight_cloud()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto answers = json_lines(outcome.out);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[1]["source"], "sim:empty-room");
  EXPECT_TRUE(answers[1]["stairways"].empty());
  EXPECT_EQ(answers[0]["stairways"], answers[2]["stairways"]);
}

TEST(DetectVerb, wrong_usage_exits_2_and_prints_no_answer) {
  const std::pair<std::vector<std::string>, std::string> table[] = {
      {{}, "verb"},
      {{"frobnicate"}, "frobnicate"},
      {{"detect"}, "SOURCE"},
      {{"detect", "--format", "xml", "a.pcd"}, "xml"},
      {{"detect", "--frobnicate", "a.pcd"}, "--frobnicate"},
      {{"detect", "--plot", "a.jpg", "a.pcd"}, "a.jpg"},
      {{"detect", "--plot", "a.png", "a.pcd", "b.pcd"}, "--plot"},
      {{"detect", "--set", "detector.voxel_mm=-5", "a.pcd"}, "detector.voxel_mm"},
      {{"detect", "--config", "/no/such/file.toml", "a.pcd"}, "/no/such/file.toml"},
      {{"detect", "--profile", "telescope", "a.pcd"}, "telescope"},
  };
  for (const auto& [arguments, named] : table) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    const auto outcome = run_stairway(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  }
}

TEST(DetectVerb, unknown_setting_names_the_nearest_one) {
  const auto outcome = run_stairway({"detect", "--set", "detector.voxel_mn=20", "a.pcd"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("detector.voxel_mm"), std::string::npos) << outcome.err;
}

TEST(DetectVerb, answers_the_same_on_two_runs) {
  const auto first = json_lines(detect({flight_cloud(), "sim:random-stairs:17"}).out);
  const auto second = json_lines(detect({flight_cloud(), "sim:random-stairs:17"}).out);
  ASSERT_EQ(first.size(), 2U);
  for (std::size_t i = 0; i < first.size(); ++i) {
    json a = first[i], b = second.at(i);
    a.erase("timing_ms");
    b.erase("timing_ms");
    EXPECT_EQ(a.dump(), b.dump());
  }
}

TEST(DetectVerb, points_that_are_not_finite_are_left_out) {
  const TemporaryFolder folder;
  scan::PointCloud cloud = read_cloud(flight_cloud());
  const std::size_t finite = cloud.points.size();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < finite; i += 7) cloud.points.emplace_back(nan, 1.0F, nan);
  std::rotate(cloud.points.begin(), cloud.points.end() - 500, cloud.points.end());
  ASSERT_TRUE(ipc::write_pcd(folder.path("holes.pcd"), cloud));
  const auto outcome = detect({folder.path("holes.pcd")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json_lines(outcome.out)[0];
  EXPECT_EQ(answer["points"].get<std::size_t>(), finite);
  expect_flight(answer);
}

TEST(DetectVerb, reads_ply_with_further_fields_like_the_plain_cloud) {
  const TemporaryFolder folder;
  const scan::PointCloud cloud = read_cloud(flight_cloud());
  std::ostringstream ply;
  ply << "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex " << cloud.points.size()
      << "\nproperty uchar red\nproperty double x\nproperty double y\nproperty float intensity\nproperty double z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  ply.precision(9);
  for (const Eigen::Vector3f& p : cloud.points) ply << "7 " << p.x() << ' ' << p.y() << " 0.5 " << p.z() << '\n';
  ply << "3 0 1 2\n";
  test::write_text(folder.path("rich.ply"), ply.str());
  const auto outcome = detect({folder.path("rich.ply")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_flight(json_lines(outcome.out)[0]);
}

TEST(DetectVerb, missing_floor_is_a_rejection_and_no_failure) {
  const TemporaryFolder folder;
  scan::PointCloud wall;
  for (int y = 0; y < 200; ++y)
    for (int z = 0; z < 200; ++z)
      wall.points.emplace_back(2.0F, 0.01F * static_cast<float>(y), 0.01F * static_cast<float>(z));
  ASSERT_TRUE(ipc::write_ply(folder.path("wall.ply"), wall));
  const auto outcome = detect({folder.path("wall.ply"), "--set", "input.level=floor"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json_lines(outcome.out)[0];
  EXPECT_EQ(answer["points"], 40'000);
  ASSERT_EQ(answer["rejected"].size(), 1U);
  EXPECT_EQ(answer["rejected"][0]["reason"], "floor-not-found");
}

TEST(DetectVerb, cloud_in_millimetres_is_told_from_an_empty_place) {
  const TemporaryFolder folder;
  scan::PointCloud cloud = read_cloud(flight_cloud());
  for (Eigen::Vector3f& p : cloud.points) p *= 1000.0F;
  ASSERT_TRUE(ipc::write_pcd(folder.path("mm.pcd"), cloud));
  const auto outcome = detect({folder.path("mm.pcd")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json_lines(outcome.out)[0];
  EXPECT_TRUE(answer["stairways"].empty());
  ASSERT_FALSE(answer["rejected"].empty());
  EXPECT_EQ(answer["rejected"][0]["reason"], "units-suspicious");
  EXPECT_GT(answer["rejected"][0]["figures"]["extent"], 1000.0);
}

TEST(DetectVerb, levels_a_tilted_cloud_by_the_floor_by_angles_and_by_gravity) {
  const TemporaryFolder folder;
  const std::string tilted = folder.path("tilted.pcd");
  ASSERT_EQ(
      run_stairway({"simulate", "straight-flight", "--disk-period", "4", "--tilt-pitch", "5", "-o", tilted}).exit_code,
      0);
  const double sine = std::sin(5.0 * M_PI / 180.0), cosine = std::cos(5.0 * M_PI / 180.0);
  const std::vector<std::string> ways[] = {
      {"--set", "input.level=floor"},
      {"--set", "input.pitch_deg=5"},
      {"--set", "input.gravity=[" + std::to_string(sine) + ", 0, " + std::to_string(-cosine) + "]"},
  };
  for (std::vector<std::string> way : ways) {
    SCOPED_TRACE(way.back());
    way.push_back(tilted);
    const auto outcome = detect(way);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_flight(json_lines(outcome.out)[0]);
  }
}

TEST(DetectVerb, text_shows_the_truth_of_a_simulated_scene_and_the_differences) {
  const auto outcome = run_stairway({"detect", "sim:straight-flight", kCoarse[0], kCoarse[1]});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"straight", "truth", "170.0", "290.0", "difference"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << outcome.out;
}

TEST(DetectVerb, draws_pictures_and_colours_points) {
  const TemporaryFolder folder;
  for (const char* name : {"plot.png", "plot.svg"}) {
    const auto outcome = detect({flight_cloud(), "--plot", folder.path(name), "--output", folder.path("marked.ply")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(test::read_text(folder.path(name)).size(), 20'000U);
  }
  EXPECT_EQ(test::read_text(folder.path("plot.png")).substr(1, 3), "PNG");
  EXPECT_NE(test::read_text(folder.path("plot.svg")).find("<svg"), std::string::npos);
  EXPECT_EQ(read_cloud(folder.path("marked.ply")).points.size(), read_cloud(flight_cloud()).points.size());
}

TEST(DetectVerb, picture_that_cannot_be_written_is_a_failure_that_names_it) {
  for (const std::string file : {"/no/such/folder/a.png", "/no/such/folder/a.svg"}) {
    const auto outcome = detect({flight_cloud(), "--plot", file});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_EQ(json_lines(outcome.out).size(), 1U);
  }
}

TEST(DetectVerb, cloud_without_points_is_answered) {
  const TemporaryFolder folder;
  ASSERT_TRUE(ipc::write_ply(folder.path("empty.ply"), {}));
  const auto outcome = detect({folder.path("empty.ply"), "--plot", folder.path("empty.png")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json_lines(outcome.out)[0]["points"], 0);
}

}  // namespace
}  // namespace stairway
