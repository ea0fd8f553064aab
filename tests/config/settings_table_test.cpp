// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "config/settings_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "config/load_settings.hpp"
#include "config/nearest_key.hpp"
#include "config/settings_reference.hpp"

namespace stairway::config {
namespace {

std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(SettingsTable, shipped_file_lists_every_key_with_its_default) {
  const std::filesystem::path shipped = STAIRWAY_SOURCE_DIR "/config/stairwayd.toml";
  const std::filesystem::path wanted = std::filesystem::path(testing::TempDir()) / "stairwayd.toml";
  if (read(shipped) != default_file_text()) {
    std::ofstream(wanted, std::ios::binary) << default_file_text();
    FAIL() << "the table has changed; look at the difference to " << wanted << " and copy it to " << shipped;
  }
}

TEST(SettingsTable, reference_page_is_that_of_the_table) {
  const std::filesystem::path page = STAIRWAY_SOURCE_DIR "/docs/settings.md";
  const std::filesystem::path wanted = std::filesystem::path(testing::TempDir()) / "settings.md";
  if (read(page) != settings_reference()) {
    std::ofstream(wanted, std::ios::binary) << settings_reference();
    FAIL() << "the table has changed; look at the difference to " << wanted << " and copy it to " << page;
  }
}

TEST(SettingsTable, keys_are_unique_and_plain) {
  Settings settings;
  std::set<std::string> keys;
  for (const Entry& entry : settings_table(settings)) {
    EXPECT_TRUE(keys.insert(entry.key).second) << entry.key;
    for (const char c : entry.key) EXPECT_TRUE(std::islower(c) || std::isdigit(c) || c == '_' || c == '.') << entry.key;
    EXPECT_FALSE(entry.doc.empty()) << entry.key;
    EXPECT_EQ(entry.doc.find('\n'), std::string::npos) << entry.key;
  }
}

TEST(SettingsTable, no_two_keys_share_a_place) {
  Settings settings;
  std::set<const void*> places;
  for (const Entry& entry : settings_table(settings)) {
    const void* place = nullptr;
    if (const auto* real = std::get_if<RealField>(&entry.field)) place = real->value;
    if (const auto* whole = std::get_if<WholeField>(&entry.field)) place = whole->value;
    if (const auto* text = std::get_if<TextField>(&entry.field)) place = text->value;
    if (const auto* on_off = std::get_if<SwitchField>(&entry.field)) place = on_off->value;
    if (place == nullptr) continue;
    EXPECT_TRUE(places.insert(place).second) << entry.key;
  }
}

TEST(Settings, a_disk_too_slow_for_the_units_of_its_drive_is_refused) {
  Settings settings;
  settings.motor.velocity_units_per_turn_per_s = 60.0;
  EXPECT_EQ(settings.problem(), "");
  settings.disk.period_s = 121.0;
  EXPECT_EQ(settings.problem().find("motor: "), 0U);
  settings.disk.period_s = 35.0;
  settings.disk.check_speed_rad_s = 0.05;
  EXPECT_EQ(settings.problem().find("motor: "), 0U);
}

TEST(SettingsTable, defaults_lie_within_their_ranges_and_fit_together) {
  Settings settings;
  EXPECT_EQ(settings.problem(), "");
  for (const Entry& entry : settings_table(settings)) {
    if (const auto* real = std::get_if<RealField>(&entry.field)) {
      EXPECT_GE(*real->value / real->unit.in_struct, real->min - 1e-9) << entry.key;
      EXPECT_LE(*real->value / real->unit.in_struct, real->max + 1e-9) << entry.key;
    }
    if (const auto* whole = std::get_if<WholeField>(&entry.field)) {
      EXPECT_GE(*whole->value, whole->min) << entry.key;
      EXPECT_LE(*whole->value, whole->max) << entry.key;
    }
  }
}

class WrittenSettings : public testing::Test {
 protected:
  std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) / (std::to_string(::getpid()) + "_all.toml");
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(WrittenSettings, read_back_as_they_were) {
  Settings settings;
  settings.lcm.url = "file:///tmp/a \"b\\c\".lcm";
  settings.detector.voxel_m = 0.0125;
  settings.mount.scan_plane_pitch_rad = -1.0471975511965976;
  settings.input.gravity = Eigen::Vector3d(0.1, -0.2, -9.7);
  settings.input.level = Levelling::Floor;
  settings.log.level = LogLevel::Debug;
  settings.detector.fragment_merging.enabled = false;
  std::ofstream(path_) << to_toml(settings);

  const auto loaded = load_settings({{path_}, {}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  EXPECT_EQ(to_toml(loaded->settings), to_toml(settings));
  EXPECT_NEAR(loaded->settings.mount.scan_plane_pitch_rad, settings.mount.scan_plane_pitch_rad, 1e-12);
  for (const ShownSetting& shown : show_settings(*loaded)) EXPECT_NE(shown.origin, "default") << shown.key;
}

std::vector<double> reals_of(Settings settings) {
  std::vector<double> values;
  for (const Entry& entry : settings_table(settings)) {
    if (const auto* real = std::get_if<RealField>(&entry.field)) values.push_back(*real->value);
  }
  return values;
}

// Not every number of radians is a number of degrees times pi / 180 to the last bit; these must be.
bool decides_what_is_found(const std::string& key) {
  return key.starts_with("mount.") || key.starts_with("sweep.") || key.starts_with("detector.");
}

TEST_F(WrittenSettings, reals_that_decide_what_is_found_are_the_same_to_the_last_bit) {
  Settings settings;
  // Values as the loader makes them of what a person writes, down to more digits than anybody measures.
  settings.mount.scan_plane_pitch_rad = 60.0123456 * (std::numbers::pi / 180.0);
  settings.mount.disk_z_m = 512.3456789 / 1e3;
  std::ofstream(path_) << to_toml(settings);
  const auto loaded = load_settings({{path_}, {}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  const auto before = reals_of(settings), after = reals_of(loaded->settings);
  Settings names;
  std::size_t i = 0;
  for (const Entry& entry : settings_table(names)) {
    if (!std::holds_alternative<RealField>(entry.field)) continue;
    if (decides_what_is_found(entry.key)) {
      EXPECT_EQ(after[i], before[i]) << entry.key;
    }
    ++i;
  }
}

TEST_F(WrittenSettings, shipped_file_with_every_line_switched_on_changes_nothing) {
  std::istringstream shipped(default_file_text());
  std::ofstream file(path_);
  for (std::string line; std::getline(shipped, line);) {
    const bool is_value = line.size() > 1 && line[0] == '#' && std::islower(line[1]);
    file << (is_value ? line.substr(1) : line) << '\n';
  }
  file.close();
  const auto loaded = load_settings({{path_}, {}});
  ASSERT_TRUE(loaded) << loaded.error().text;
  const auto now = show_settings(*loaded), before = show_settings({});
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_EQ(now[i].value, before[i].value) << now[i].key;
  EXPECT_EQ(loaded->origins.size(), now.size());
}

TEST(NearestKey, finds_misspelt_and_misplaced_keys_only) {
  Settings settings;
  const std::vector<Entry> table = settings_table(settings);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"detector.voxl_mm", "detector.voxel_mm"},
      {"detector.normals.voxel_mm", "detector.voxel_mm"},
      {"lcm.ulr", "lcm.url"},
      {"voxel_mm", "detector.voxel_mm"},
      {"detector.region_growing.min_point", "detector.region_growing.min_points"},
      {"colour_of_the_robot", ""},
      {std::string(100000, 'x'), ""},
  };
  for (const auto& [typed, meant] : cases) EXPECT_EQ(nearest_key(typed, table), meant) << typed.substr(0, 40);
}

}  // namespace
}  // namespace stairway::config
