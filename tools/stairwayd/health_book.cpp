// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/health_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairway::daemon {
namespace {

// The share of the disk's turn that lies behind.
double turn_progress(double angle_rad, double speed_rad_s) {
  const double turns = angle_rad / (2.0 * std::numbers::pi);
  const double share = turns - std::floor(turns);
  return speed_rad_s < 0.0 && share > 0.0 ? 1.0 - share : share;
}

}  // namespace

void HealthBook::note(const SourceState& state) {
  const std::lock_guard lock(mutex_);
  source_ = state;
}

void HealthBook::note_scan(const drivers::LaserScan& scan) {
  const auto points = std::ranges::count(scan.statuses, drivers::BeamStatus::Ok);
  const std::lock_guard lock(mutex_);
  ++scans_;
  points_ += points;
}

void HealthBook::note_angles(std::size_t samples, const scan::AngleTrack& track) {
  const auto speed_rad_s = track.speed_rad_s();
  const auto angle_rad = speed_rad_s ? track.at(*track.newest_ns()) : tl::unexpected(scan::AngleError::Unknown);
  const std::lock_guard lock(mutex_);
  angles_ += samples;
  is_angle_valid_ = angle_rad.has_value();
  if (angle_rad) progress_ = turn_progress(*angle_rad, *speed_rad_s);
}

void HealthBook::note_sweep(const scan::Sweep& sweep) {
  const scan::BeamCounts& beams = sweep.statistics.beams;
  count("lost-scans", sweep.statistics.lost_scans);
  count("hurried-scans", sweep.statistics.hurried_scans);
  count("no-return", beams.no_return);
  count("too-near", beams.too_near);
  count("disturbed", beams.disturbed);
  count("invalid", beams.invalid);
  count("out-of-limits", beams.out_of_limits);
  count("no-angle", beams.no_angle);
  count("angle-invalid", beams.angle_invalid);
  const std::lock_guard lock(mutex_);
  sweep_ = static_cast<std::int64_t>(sweep.number) + 1;
  points_ = 0;
}

void HealthBook::count(const std::string& name, std::uint64_t number) {
  if (number == 0) return;
  const std::lock_guard lock(mutex_);
  counts_[name] += static_cast<std::int64_t>(number);
}

ipc::HealthMessage HealthBook::report(Clock::time_point now, std::int64_t utime_us) {
  const std::lock_guard lock(mutex_);
  ipc::HealthMessage health;
  health.utime_us = utime_us;
  health.state = state_text();
  health.sweep = sweep_;
  health.sweep_progress = progress_;
  health.points = points_;
  const double elapsed_s = std::chrono::duration<double>(now - last_report_).count();
  if (elapsed_s > 0.0) {
    health.scan_rate_hz = static_cast<double>(scans_) / elapsed_s;
    health.disk_rate_hz = static_cast<double>(angles_) / elapsed_s;
  }
  health.drops.assign(counts_.begin(), counts_.end());
  last_report_ = now;
  scans_ = 0;
  angles_ = 0;
  return health;
}

std::string HealthBook::state_text() const {
  if (!source_.is_delivering) return source_.text;
  if (scans_ == 0) return "no scans arrive";
  if (angles_ == 0) return "no disk angles arrive";
  return is_angle_valid_ ? "scanning" : "waiting for the disk's index";
}

}  // namespace stairway::daemon
