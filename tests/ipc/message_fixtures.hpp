// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "ipc/messages.hpp"

namespace stairway::ipc::test {

inline const DiskMessage kDisk{1, {2, -3.5, true}, 0.18, 12, DiskFault::Motor, "drive silent for 1.2 s"};
inline const AnglesMessage kAngles{-7, 123'456'789, {{1, -0.1, true}, {2, 1.0 / 3.0, false}, {3, 1e300, true}}};
inline const HealthMessage kHealth{
    1,
    "scanning",
    {"encoder:disconnected", "not-recording"},
    3,
    0.25,
    40.0,
    1000.0,
    123456,
    {{"no-return", 77}, {"late", 0}},
    {{"scanner", "streaming", "", true, 40.0, 0.02, 3}, {"encoder", "no chip", "disconnected", false, 0.0, -1.0, 7}},
    {drivers::ClockSource::TimeAdjustment, 25.01, 23.1, 0.9, 0.45, 0.1, 0.7, 0.3, -12.5, 2},
    {{"acquisition", 0.3, 1.2}, {"total", 800.0, 950.5}},
    {2, 0.5, 1513400, "a third of the turn is missing", 1, 2, 0.25}};
inline const CommandMessage kCommand{7, -3, CommandAction::SetSpeed, -0.5};
inline const CommandAckMessage kAck{8,   -3, CommandResult::BadValue, "no such speed", drivers::DiskMode::SingleSweep,
                                    0.25};
inline const CloudSliceMessage kSlice{5, 4, 3, 1, 2, 10, 12, {{1.0F, -2.0F, 0.1F}, {1e30F, 0.0F, -0.0F}}};
inline const RawMessage kRaw{6, 5, "scanner", true, std::string("MD\n\0\xff", 5)};
inline const SettingsMessage kSettings{1, "0.1.0", "[lcm]\nurl = \"memq://\"\n"};

inline detect::Stairway sample_stairway() {
  detect::Stairway stairway;
  stairway.kind = detect::StairwayKind::Spiral;
  stairway.direction = detect::StairwayDirection::Descending;
  stairway.step_height = 0.17012345;
  stairway.step_depth = 0.29;
  stairway.width = 1.2;
  stairway.heading = -1.0 / 3.0;
  stairway.turn_per_step = 0.1;
  stairway.step_height_sigma = 0.0002;
  stairway.step_depth_sigma = 0.0003;
  stairway.width_sigma = 0.002;
  stairway.heading_sigma = 0.0004;
  stairway.anchor = {1.0, -2.0, -0.0};
  stairway.anchor_side = detect::AnchorSide::Left;
  stairway.railing_left = true;
  stairway.nosings = {{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}, {10, 11, 12}}, {{0.1, 0.2, 0.3}, {-0.4, -0.5, -0.6}}};
  stairway.score = 12.5;
  return stairway;
}

inline StairwaysMessage sample_stairways() {
  StairwaysMessage message{1'700'000'000'000'001, 1'699'999'999'965'000, 7, false, {}, {42, 0}};
  message.detection.stairways = {sample_stairway(), {}};
  message.detection.stairways[0].is_irregular = true;
  message.detection.stairways[0].step_sizes = {
      {0.17, 0.001, 0.29, 0.002}, {0.182, 0.0011, 0.288, 0.0021}, {0.165, 0.0012, 0.291, 0.0022}};
  message.detection.rejected = {{"too-few-steps", "2 steps, 3 are needed", {{"steps", 2.0}, {"limit", 3.0}}},
                                {"", "", {}}};
  return message;
}

inline ScanMessage sample_scan() {
  ScanMessage message;
  message.utime_us = -5;
  message.scan = {std::uint64_t{1} << 40, 99'000'000'000, 123'456'789'012'345, 17361.1, -2.35, 0.00436, {}, {}, {}};
  for (int i = 0; i < 1081; ++i) {
    const bool is_ok = i % 5 == 0;
    message.scan.statuses.push_back(static_cast<drivers::BeamStatus>(i % 5));
    message.scan.ranges_m.push_back(is_ok ? static_cast<float>(i) * 0.001F : std::numeric_limits<float>::quiet_NaN());
  }
  message.disk_angle_start_rad = 100.5;
  message.disk_angle_end_rad = 100.6;
  message.disk_angle_valid = true;
  return message;
}

}  // namespace stairway::ipc::test
