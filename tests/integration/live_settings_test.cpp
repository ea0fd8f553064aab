// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/live_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "config/settings_table.hpp"

namespace stairway::daemon {
namespace {

void change(config::RealField& field) {
  const double in_file = *field.value / field.unit.in_struct;
  *field.value = field.unit.to_struct(in_file < field.max ? field.max : field.min);
}
void change(config::WholeField& field) { *field.value = *field.value < field.max ? field.max : field.min; }
void change(config::SwitchField& field) { *field.value = !*field.value; }
void change(config::TextField& field) { *field.value += "x"; }
void change(config::ChoiceField& field) { field.set((field.get() + 1) % field.names.size()); }
void change(config::VectorField& field) { field.value->emplace(1.0, 2.0, 3.0); }

TEST(LiveSettings, every_key_changes_at_once_or_is_named) {
  config::Settings names;
  const std::vector<config::Entry> keys = config::settings_table(names);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    config::Settings wanted;
    std::vector<config::Entry> table = config::settings_table(wanted);
    std::visit([](auto& field) { change(field); }, table[i].field);
    LiveSettings live(config::Settings{});
    const std::vector<std::string> named = live.adopt(wanted);
    config::Settings now = live.settings();
    const bool has_changed = config::show_value(config::settings_table(now)[i]) == config::show_value(table[i]);
    EXPECT_EQ(has_changed, config::changes_live(keys[i].key)) << keys[i].key;
    EXPECT_EQ(named, has_changed ? std::vector<std::string>{} : std::vector<std::string>{keys[i].key});
  }
}

TEST(LiveSettings, detector_and_log_change_at_once_and_the_rest_is_named) {
  LiveSettings live(config::Settings{});
  config::Settings wanted;
  wanted.detector.voxel_m = 0.02;
  wanted.log.level = config::LogLevel::Debug;
  wanted.mount.disk_z_m = 0.7;
  wanted.lcm.channel_prefix = "OTHER_";
  EXPECT_EQ(live.adopt(wanted), (std::vector<std::string>{"lcm.channel_prefix", "mount.disk_z_mm"}));
  EXPECT_EQ(live.settings().detector.voxel_m, 0.02);
  EXPECT_EQ(live.settings().log.level, config::LogLevel::Debug);
  EXPECT_EQ(live.settings().mount.disk_z_m, config::Settings{}.mount.disk_z_m);
}

}  // namespace
}  // namespace stairway::daemon
