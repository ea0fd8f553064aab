// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ipc/cloud_file.hpp"
#include "tests/tools/cli_process.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/sim/stl_file.hpp"

namespace stairway {
namespace {

using nlohmann::json;
using test::run_stairway;
using test::TemporaryFolder;

TEST(Program, every_verb_has_help_with_an_example_and_its_exit_codes) {
  EXPECT_EQ(run_stairway({"--version"}).exit_code, 0);
  EXPECT_EQ(run_stairway({"--help"}).exit_code, 0);
  for (const std::string verb : {"detect", "monitor", "simulate", "evaluate", "info", "config"}) {
    SCOPED_TRACE(verb);
    const auto outcome = run_stairway({verb, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("stairway " + verb), std::string::npos);
    EXPECT_NE(outcome.out.find("Exit codes: 0"), std::string::npos);
  }
}

TEST(SimulateVerb, lists_every_scene_by_a_name_that_can_be_simulated) {
  const TemporaryFolder folder;
  const auto list = run_stairway({"simulate", "--list"});
  ASSERT_EQ(list.exit_code, 0);
  std::istringstream names(list.out);
  int count = 0;
  for (std::string name; std::getline(names, name); ++count) {
    if (name.find("SEED") != std::string::npos) name.replace(name.find("SEED"), 4, "3");
    const auto outcome = run_stairway({"simulate", name, "--disk-period", "1", "-o", folder.path("a.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << name << ": " << outcome.err;
  }
  EXPECT_GE(count, 8);
}

TEST(SimulateVerb, writes_cloud_and_truth) {
  const TemporaryFolder folder;
  const auto outcome = run_stairway(
      {"simulate", "spiral", "--disk-period", "1", "-o", folder.path("a.pcd"), "--truth", folder.path("a.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto cloud = ipc::read_cloud_file(folder.path("a.pcd"));
  ASSERT_TRUE(cloud);
  ASSERT_TRUE(cloud->cloud.sensor_origin);
  EXPECT_FLOAT_EQ(cloud->cloud.sensor_origin->z(), 0.5F);
  const json truth = json::parse(test::read_text(folder.path("a.json")));
  EXPECT_EQ(truth["points"], cloud->cloud.points.size());
  ASSERT_EQ(truth["stairways"].size(), 1U);
  EXPECT_EQ(truth["stairways"][0]["kind"], "spiral");
  EXPECT_EQ(truth["stairways"][0]["steps"], 12);
}

TEST(SimulateVerb, seed_decides_the_bytes) {
  const TemporaryFolder folder;
  const auto cloud = [&](const char* seed) {
    EXPECT_EQ(run_stairway({"simulate", "empty-room", "--disk-period", "1", "--seed", seed, "-o", folder.path("a.ply")})
                  .exit_code,
              0);
    return test::read_text(folder.path("a.ply"));
  };
  const std::string first = cloud("1");
  EXPECT_EQ(cloud("1"), first);
  EXPECT_NE(cloud("2"), first);
}

TEST(SimulateVerb, writes_the_scene_and_its_stairway_as_triangles) {
  const TemporaryFolder folder;
  const auto outcome = run_stairway({"simulate", "open-risers", "--disk-period", "1", "-o", folder.path("a.ply"),
                                     "--mesh", folder.path("room.stl"), "--model", folder.path("stairs.stl")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const sim::SceneSpec spec = sim::load_scene("open-risers");
  EXPECT_TRUE(test::read_text(folder.path("room.stl")) == sim::encode_stl(sim::build_scene(spec).mesh));
  EXPECT_TRUE(test::read_text(folder.path("stairs.stl")) == sim::encode_stl(sim::flight_model(spec.stairs.front())));
}

TEST(SimulateVerb, trouble_is_named_and_told_by_the_exit_code) {
  const TemporaryFolder folder;
  const std::tuple<std::vector<std::string>, int, std::string> table[] = {
      {{"spiral"}, 2, "--output"},
      {{"spiral", "--disk-period", "0.5", "-o", "a.ply"}, 2, "0.5"},
      {{"spiral", "--seed", "-4", "-o", "a.ply"}, 2, "--seed"},
      {{"spyral", "-o", "a.ply"}, 1, "spyral"},
      {{"empty-room", "-o", "a.ply", "--model", "a.stl"}, 1, "has no stairway"},
      {{"spiral", "--disk-period", "1", "-o", folder.path("a.ply"), "--mesh", "/no/such/folder/a.stl"},
       1,
       "/no/such/folder/a.stl"},
      {{"spiral", "--disk-period", "1", "-o", "/no/such/folder/a.ply"}, 1, "/no/such/folder/a.ply"},
  };
  for (const auto& [arguments, exit_code, named] : table) {
    SCOPED_TRACE(::testing::PrintToString(arguments));
    std::vector<std::string> all{"simulate"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto outcome = run_stairway(all);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_NE(outcome.err.find(named), std::string::npos) << outcome.err;
  }
}

TEST(ConfigVerb, what_show_prints_is_a_settings_file_with_the_same_meaning) {
  const TemporaryFolder folder;
  const auto shown = run_stairway({"config", "show", "--profile", "depth-camera", "--set", "detector.voxel_mm=21",
                                   "--set", "input.gravity=[0, 1, -9]"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  test::write_text(folder.path("all.toml"), shown.out);
  const auto again = run_stairway({"config", "--config", folder.path("all.toml"), "--format", "json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find(R"({"key":"detector.voxel_mm","value":21,)"), std::string::npos);
  EXPECT_NE(again.out.find(R"("key":"profile","value":"depth-camera")"), std::string::npos);
  EXPECT_NE(again.out.find(R"("key":"input.gravity","value":[0,1,-9])"), std::string::npos);
  EXPECT_NE(again.out.find("all.toml:"), std::string::npos) << "origin is missing";
}

TEST(ConfigVerb, diff_shows_only_what_differs) {
  const TemporaryFolder folder;
  test::write_text(folder.path("empty.toml"), "");
  const std::string empty = folder.path("empty.toml");
  EXPECT_EQ(run_stairway({"config", "diff", "--config", empty}).out, "");
  const auto outcome =
      run_stairway({"config", "diff", "--config", empty, "--set", "detector.voxel_mm=21", "--set", "simulate.seed=1"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.find("detector.voxel_mm = 21"), 0U) << outcome.out;
  EXPECT_EQ(outcome.out.find('\n'), outcome.out.size() - 1) << outcome.out;
}

TEST(ConfigVerb, reads_the_folder_beside_the_file_as_the_daemon_does) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("conf.d"));
  test::write_text(folder.path("robot.toml"), "detector.voxel_mm = 12\nlcm = { url = \"memq://\" }\n");
  test::write_text(folder.path("conf.d/20-more.toml"), "[motor.timing]\n\nheartbeat_s = 0.2\n");
  const auto config = [&](const std::string& task) {
    return run_stairway({"config", task, "--config", folder.path("robot.toml"), "--format", "json"});
  };
  const std::string out = config("diff").out;
  EXPECT_NE(out.find("conf.d/20-more.toml:3\""), std::string::npos) << out;
  EXPECT_NE(out.find("robot.toml:2\""), std::string::npos) << out;
  EXPECT_NE(out.find(R"("key":"detector.voxel_mm","value":12,"default":10)"), std::string::npos) << out;
  EXPECT_EQ(json::parse(config("check").out)["files"].size(), 2U);

  test::write_text(folder.path("conf.d/30-wrong.toml"), "motor = { timing = { hartbeat_s = 1 } }\n");
  const auto refused = config("check");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("conf.d/30-wrong.toml:1:"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("did you mean 'motor.timing.heartbeat_s'?"), std::string::npos) << refused.err;
}

TEST(ConfigVerb, check_names_file_line_and_key) {
  const TemporaryFolder folder;
  test::write_text(folder.path("good.toml"), "[detector]\nvoxel_mm = 12\n");
  test::write_text(folder.path("bad.toml"), "[detector]\n\nvoxel_mm = \"fine\"\n");
  EXPECT_EQ(run_stairway({"config", "check", "--config", folder.path("good.toml")}).exit_code, 0);
  const auto bad = run_stairway({"config", "check", "--config", folder.path("bad.toml"), "--format", "json"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.err.find("bad.toml:3"), std::string::npos) << bad.err;
  EXPECT_EQ(json::parse(bad.out)["ok"], false);
}

TEST(InfoVerb, describes_points_extent_and_floor) {
  const TemporaryFolder folder;
  scan::PointCloud cloud{.points = {}, .sensor_origin = Eigen::Vector3f(0.0F, 0.0F, 1.5F)};
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y)
      cloud.points.emplace_back(0.03F * static_cast<float>(x), 0.03F * static_cast<float>(y), -0.25F);
  ASSERT_TRUE(ipc::write_pcd(folder.path("floor.pcd"), cloud));
  const auto outcome = run_stairway({"info", folder.path("missing.ply"), folder.path("floor.pcd"), "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const json facts = json::parse(outcome.out);
  EXPECT_EQ(facts["points"], 10'000);
  EXPECT_NEAR(facts["max"][0].get<double>(), 2.97, 1e-5);
  EXPECT_NEAR(facts["floor"]["height"].get<double>(), -0.25, 1e-4);
  EXPECT_NEAR(facts["sensor_origin"][2].get<double>(), 1.5, 1e-6);
}

TEST(Program, output_that_cannot_be_written_is_a_failure) {
  const std::string command = std::string(STAIRWAY) + " config show >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
}

}  // namespace
}  // namespace stairway
