// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"
#include "ipc/recording/event_log_writer.hpp"

namespace stairway::test {

inline constexpr std::int64_t kFixtureScanPeriod_ns = 25'000'000;
inline constexpr std::int64_t kFixtureUtime_us = 1'700'000'000'000'000;

/// A mirror turn of 100 beams that see a wall three metres around a scanner whose disk turns once in 40 of them.
inline ipc::ScanMessage fixture_scan(int i) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  ipc::ScanMessage message;
  message.utime_us = kFixtureUtime_us + 25'000 * i;
  message.scan.sequence = static_cast<std::uint64_t>(i);
  message.scan.first_beam_stamp_ns = i * kFixtureScanPeriod_ns;
  message.scan.beam_interval_ns = 240'000.0;
  message.scan.first_angle_rad = -0.5;
  message.scan.angle_increment_rad = 0.01;
  message.scan.ranges_m.assign(100, 3.0F);
  message.scan.statuses.assign(100, drivers::BeamStatus::Ok);
  message.disk_angle_start_rad = kTurn_rad * i / 40.0;
  message.disk_angle_end_rad = kTurn_rad * (i + 99 * 0.24 / 25.0) / 40.0;
  message.disk_angle_valid = true;
  return message;
}

/// The angle at the end of that turn, which came after it.
inline ipc::AnglesMessage fixture_angles(int i) {
  const auto angle_rad = [](int scan) { return 2.0 * std::numbers::pi * scan / 40.0; };
  const std::int64_t begin_ns = i * kFixtureScanPeriod_ns;
  ipc::AnglesMessage message{kFixtureUtime_us + 25'000 * (i + 1), begin_ns, {}};
  if (i == 0) message.samples.push_back({begin_ns, angle_rad(0), true});
  message.samples.push_back({begin_ns + kFixtureScanPeriod_ns, angle_rad(i + 1), true});
  return message;
}

struct FixtureOptions {
  int scans = 45;
  bool has_angles = true;
  const char* settings = "[sweep]\nmax_points = 2000000\n[detector]\nvoxel_mm = 20\nlong_gone = 3\n";
};

/// A recording as the daemon writes it: angles, then the scan that waited for them.
inline void write_fixture(const std::filesystem::path& path, const FixtureOptions& options = {}) {
  const ipc::Channels channels;
  auto log = ipc::EventLogWriter::create(path).value();
  std::int64_t utime_us = kFixtureUtime_us;
  const auto append = [&](const std::string& channel, const ipc::Bytes& bytes) {
    if (!log.append({0, utime_us, channel, bytes})) throw std::runtime_error("the fixture does not fit the disk");
  };
  append(channels.settings, encode(ipc::SettingsMessage{utime_us, "1.2.3", options.settings}));
  for (int i = 0; i < options.scans; ++i, utime_us += 25'000) {
    if (options.has_angles) append(channels.angles, encode(fixture_angles(i)));
    append(channels.scan, encode(fixture_scan(i)));
    if (i != 40) continue;
    ipc::StairwaysMessage answer{.utime_us = utime_us, .sweep_start_utime_us = kFixtureUtime_us, .track_ids = {7}};
    answer.detection.stairways.emplace_back();
    append(channels.stairways, encode(answer));
  }
}

}  // namespace stairway::test
