// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/load_settings.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numbers>

namespace stairway::config {
namespace {

/// Settings files that vanish with the test.
class LoadSettings : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("settings_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string refusal_of(const std::string& text) {
    const auto loaded = load_settings({{file("a.toml", text)}, {}});
    if (loaded) return "accepted";
    std::string message = loaded.error().text;
    const std::string folder = folder_.string() + "/";
    const std::size_t at = message.find(folder);
    return at == std::string::npos ? message : message.erase(at, folder.size());
  }

  std::filesystem::path folder_;
};

std::string refusal_of_assignment(const std::string& assignment) {
  const auto loaded = load_settings({{}, {assignment}});
  return loaded ? "accepted" : loaded.error().text;
}

TEST_F(LoadSettings, without_sources_gives_the_defaults) {
  const auto loaded = load_settings({});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(loaded->settings.profile, "lidar");
  EXPECT_EQ(loaded->settings.lcm.url, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_TRUE(loaded->origins.empty());
}

TEST_F(LoadSettings, the_daemons_files_are_the_named_one_and_then_conf_d_by_name) {
  const auto main_file = file("robot.toml", "");
  std::filesystem::create_directories(folder_ / "conf.d");
  file("conf.d/20-mount.toml", "");
  file("conf.d/10-lidar.toml", "");
  file("conf.d/notes.txt", "");
  EXPECT_EQ(usual_files(main_file), (std::vector<std::filesystem::path>{main_file, folder_ / "conf.d/10-lidar.toml",
                                                                        folder_ / "conf.d/20-mount.toml"}));
  EXPECT_EQ(usual_files(folder_ / "other/absent.toml").size(), 1U) << "so that its absence is told";
}

TEST_F(LoadSettings, converts_units_once) {
  const auto loaded = load_settings({{file("a.toml",
                                           "[mount]\nscan_plane_pitch_deg = -60\ndisk_z_mm = 512.5\n"
                                           "[lidar]\nmin_latency_ms = 20\n[sweep]\nmax_range_m = 12.5\n")},
                                     {}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_DOUBLE_EQ(loaded->settings.mount.scan_plane_pitch_rad, -std::numbers::pi / 3.0);
  EXPECT_DOUBLE_EQ(loaded->settings.mount.disk_z_m, 0.5125);
  EXPECT_DOUBLE_EQ(loaded->settings.lidar.clock.minimum_latency_ns, 20e6);
  EXPECT_DOUBLE_EQ(loaded->settings.sweep.max_range_m, 12.5);
}

TEST_F(LoadSettings, stronger_sources_win_and_are_named) {
  const auto weak =
      file("weak.toml", "profile = \"depth-camera\"\n[simulate]\nseed = 1\nspeed = 2\n[log]\nlevel = \"error\"\n");
  const auto strong = file("strong.toml", "[simulate]\n# a comment\nseed = 2\nscene = \"descending\"\n");
  const auto loaded = load_settings({{weak, strong}, {"simulate.scene=open-risers", "log.level='debug'"}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  const Settings& settings = loaded->settings;
  EXPECT_EQ(settings.simulate.speed, 2.0);
  EXPECT_EQ(settings.simulate.seed, 2);
  EXPECT_EQ(settings.simulate.scene, "open-risers");
  EXPECT_EQ(settings.log.level, LogLevel::Debug);
  EXPECT_EQ(settings.profile, "depth-camera");
  EXPECT_EQ(settings.sweep.max_range_m, 8.0);
  EXPECT_EQ(loaded->origins.at("simulate.speed"), weak.string() + ":4");
  EXPECT_EQ(loaded->origins.at("simulate.seed"), strong.string() + ":3");
  EXPECT_EQ(loaded->origins.at("simulate.scene"), "--set simulate.scene=open-risers");
  EXPECT_EQ(loaded->origins.at("sweep.max_range_m"), "profile depth-camera");
  EXPECT_EQ(loaded->origins.count("sweep.max_points"), 0U);
}

TEST_F(LoadSettings, file_wins_over_the_profile_that_an_assignment_chose) {
  const auto path = file("a.toml", "profile = \"lidar\"\n[sweep]\nmax_range_m = 5.0\n");
  const auto loaded = load_settings({{path}, {"profile=depth-camera"}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(loaded->settings.profile, "depth-camera");
  EXPECT_EQ(loaded->settings.sweep.max_range_m, 5.0);
  EXPECT_EQ(loaded->settings.sweep.min_range_m, 0.5);
}

TEST_F(LoadSettings, every_shipped_profile_loads) {
  for (const std::string_view name : profile_names()) {
    const auto loaded = load_settings({{}, {"profile=" + std::string(name)}});
    EXPECT_TRUE(loaded) << name << ": " << loaded.error().text;
  }
  EXPECT_EQ(profile_names(), (std::vector<std::string_view>{"depth-camera", "lidar"}));
}

TEST_F(LoadSettings, gravity_is_a_vector_or_nothing) {
  const auto loaded = load_settings({{file("a.toml", "[input]\ngravity = [0, -0.5, -9.8]\n")}, {}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(loaded->settings.input.gravity, Eigen::Vector3d(0.0, -0.5, -9.8));
  const auto without = load_settings({{file("a.toml", "[input]\ngravity = [0, 0, 1]\n")}, {"input.gravity=[]"}});
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->settings.input.gravity);
}

TEST_F(LoadSettings, refusal_names_place_key_and_remedy) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"[detector]\n  voxl_mm = 10\n", "a.toml:2:3: unknown key 'detector.voxl_mm'; did you mean 'detector.voxel_mm'?"},
      {"[detecter]\nvoxel_mm = 10\n", "a.toml:1:2: unknown key 'detecter'"},
      {"colour = 1\n", "a.toml:1:1: unknown key 'colour'"},
      {"detector = 3\n", "a.toml:1:1: 'detector' is a section and takes no value of its own"},
      {"[[detector]]\nvoxel_mm = 3\n", "a.toml:1:3: 'detector' is a section and takes no value of its own"},
      {"[lcm.url]\nx = 1\n", "a.toml:1:1: lcm.url: expected text, found a section"},
      {"[detector]\nvoxel_mm = \"10\"\n", "a.toml:2:12: detector.voxel_mm: expected 1..200 mm, found '10'"},
      {"[detector]\nvoxel_mm = 0.5\n", "a.toml:2:12: detector.voxel_mm: expected 1..200 mm, found 0.5"},
      {"[detector]\nvoxel_mm = nan\n", "a.toml:2:12: detector.voxel_mm: expected 1..200 mm, found nan"},
      {"[detector]\nvoxel_mm = true\n", "a.toml:2:12: detector.voxel_mm: expected 1..200 mm, found true"},
      {"[simulate]\nseed = 1.5\n", "a.toml:2:8: simulate.seed: expected 0..2147483647, found 1.5"},
      {"[simulate]\nseed = 99999999999\n", "a.toml:2:8: simulate.seed: expected 0..2147483647, found 99999999999"},
      {"[log]\nlevel = \"loud\"\n", "a.toml:2:9: log.level: expected error, warning, info or debug, found 'loud'"},
      {"[input]\ngravity = [1, 2]\n", "a.toml:2:11: input.gravity: expected [x, y, z] or [], found [ 1, 2 ]"},
      {"[input]\ngravity = [1, 2, \"z\"]\n",
       "a.toml:2:11: input.gravity: expected [x, y, z] or [], found [ 1, 2, 'z' ]"},
      {"[input]\ngravity = [0, 0, 0]\n", "the settings do not fit together: input: gravity must not be zero"},
      {"profile = \"sonar\"\n", "a.toml:1: unknown profile 'sonar'; there are: depth-camera, lidar"},
      {"profile = 3\n", "a.toml:1:11: profile: expected text, found 3"},
      {"[lcm]\nurl = \"tcp://x\"\n",
       "the settings do not fit together: lcm: url must start with udpm://, tcpq://, file:// or memq://, e.g. "
       "udpm://239.255.76.67:7667?ttl=0"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(refusal_of(text), message) << text;
}

TEST_F(LoadSettings, parts_may_refuse_a_combination) {
  EXPECT_NE(refusal_of("[sweep]\nmin_range_m = 20\nmax_range_m = 10\n").find("do not fit together: sweep: "),
            std::string::npos);
  EXPECT_NE(refusal_of("[detector.steps]\nmin_height_mm = 300\nmax_height_mm = 200\n").find("together: detector: "),
            std::string::npos);
}

TEST_F(LoadSettings, broken_toml_is_refused_with_line_and_column) {
  EXPECT_TRUE(refusal_of("[detector]\nvoxel_mm = = 3\n").starts_with("a.toml:2:12: "));
  EXPECT_TRUE(refusal_of("[sweep]\nmin_range_m = 1\nmin_range_m = 2\n").starts_with("a.toml:3:"));
  EXPECT_TRUE(refusal_of(std::string("\xff\xfe\0\0", 4)).starts_with("a.toml:1:1: "));
}

TEST_F(LoadSettings, unreadable_files_are_refused) {
  const auto missing = load_settings({{"/nonexistent/stairwayd.toml"}, {}});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().text, "/nonexistent/stairwayd.toml: cannot read the settings: No such file or directory");
  EXPECT_FALSE(load_settings({{folder_}, {}}));
  EXPECT_NE(refusal_of(std::string(2 << 20, '#')).find("2097152 bytes are no settings file"), std::string::npos);
}

TEST(Assignment, is_taken_as_toml_with_quotes_left_out) {
  const auto loaded = load_settings(
      {{},
       {"detector.voxel_mm=12.5", "lcm.url=memq://", "lcm.channel_prefix=\"A_\"", "input.gravity=[0, 0, -1]",
        "detector.competition.strategy=greedy", "detector.fragment_merging.enabled=false", "simulate.scene=true"}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_DOUBLE_EQ(loaded->settings.detector.voxel_m, 0.0125);
  EXPECT_EQ(loaded->settings.lcm.url, "memq://");
  EXPECT_EQ(loaded->settings.lcm.channel_prefix, "A_");
  EXPECT_EQ(loaded->settings.detector.competition.strategy, detect::Strategy::Greedy);
  EXPECT_FALSE(loaded->settings.detector.fragment_merging.enabled);
  EXPECT_EQ(loaded->settings.simulate.scene, "true");
}

TEST(Assignment, refusal_names_it_and_the_remedy) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"detector.voxel_mm", "--set detector.voxel_mm: expected KEY=VALUE, e.g. detector.voxel_mm=10"},
      {"=3", "--set =3: expected KEY=VALUE, e.g. detector.voxel_mm=10"},
      {"detector.voxl_mm=3",
       "--set detector.voxl_mm=3: unknown key 'detector.voxl_mm'; did you mean 'detector.voxel_mm'?"},
      {"detector=3", "--set detector=3: 'detector' is a section and takes no value of its own"},
      {"detector.voxel_mm=ten", "--set detector.voxel_mm=ten: expected 1..200 mm, found ten"},
      {"detector.voxel_mm=", "--set detector.voxel_mm=: expected 1..200 mm, found "},
      {"detector.voxel_mm=500", "--set detector.voxel_mm=500: detector.voxel_mm: expected 1..200 mm, found 500"},
      {"detector.voxel_mm=3\nlcm.url=\"x\"",
       "--set detector.voxel_mm=3\nlcm.url=\"x\": expected 1..200 mm, found 3\nlcm.url=\"x\""},
      {"profile=sonar", "--set profile=sonar: unknown profile 'sonar'; there are: depth-camera, lidar"},
  };
  for (const auto& [assignment, message] : cases) EXPECT_EQ(refusal_of_assignment(assignment), message);
}

TEST(ShowSettings, lists_every_key_with_value_range_and_origin) {
  const auto loaded = load_settings({{}, {"detector.voxel_mm=12"}});
  ASSERT_TRUE(loaded);
  bool has_voxel = false;
  for (const ShownSetting& shown : show_settings(*loaded)) {
    EXPECT_EQ(shown.origin, shown.key == "detector.voxel_mm" ? "--set detector.voxel_mm=12" : "default");
    if (shown.key != "detector.voxel_mm") continue;
    has_voxel = true;
    EXPECT_EQ(shown.value, "12");
    EXPECT_EQ(shown.range, "1..200 mm");
  }
  EXPECT_TRUE(has_voxel);
}

}  // namespace
}  // namespace stairway::config
