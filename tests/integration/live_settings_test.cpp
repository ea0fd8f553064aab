// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/live_settings.hpp"

#include <gtest/gtest.h>

namespace stairway::daemon {
namespace {

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
