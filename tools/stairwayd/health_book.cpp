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
  DeviceEntry& entry = devices_[state.device];
  entry.condition = state.condition;
  entry.text = state.text;
}

void HealthBook::note(const drivers::ClockQuality& quality) {
  const std::lock_guard lock(mutex_);
  clock_ = quality;
}

void HealthBook::note_sign(Device device, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  devices_[device].last_sign = now;
}

void HealthBook::note_stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
}

void HealthBook::note(const ipc::RecorderStatus& recording) {
  const std::lock_guard lock(mutex_);
  recording_trouble_ = recording.trouble;
  if (recording.lost_events > 0) counts_["unrecorded-messages"] = static_cast<std::int64_t>(recording.lost_events);
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

void HealthBook::count_trouble(const SourceTrouble& trouble) {
  count(trouble.name);
  if (!trouble.device) return;
  const std::lock_guard lock(mutex_);
  ++devices_[*trouble.device].troubles;
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
  for (const auto& [device, entry] : devices_) health.devices.push_back(device_health(device, entry, now));
  if (clock_)
    health.clock = {clock_->period_ms, clock_->mean_delay_ms, clock_->stamp_residual_ms, clock_->drift_ppm,
                    static_cast<std::int64_t>(clock_->resets)};
  last_report_ = now;
  scans_ = 0;
  angles_ = 0;
  return health;
}

std::string HealthBook::state_text() const {
  return measurement_text() + (recording_trouble_.empty() ? "" : "; not recording: " + recording_trouble_);
}

std::string HealthBook::measurement_text() const {
  if (is_stopped_) return "stopped";
  if (devices_.empty()) return "starting";
  if (std::string text = failures(); !text.empty()) return text;
  if (scans_ == 0) return "no scans arrive";
  if (angles_ == 0) return "no disk angles arrive";
  return is_angle_valid_ ? "scanning" : "waiting for the disk's index";
}

// Every device that has failed, else every one that is not ready yet.
std::string HealthBook::failures() const {
  std::string text;
  for (const Condition condition : {Condition::Failed, Condition::Starting}) {
    for (const auto& [device, entry] : devices_) {
      if (entry.condition != condition) continue;
      text.append(text.empty() ? "" : "; ").append(to_string(device)).append(": ").append(entry.text);
    }
    if (!text.empty()) break;
  }
  return text;
}

ipc::DeviceHealth HealthBook::device_health(Device device, const DeviceEntry& entry, Clock::time_point now) const {
  const double age_s = entry.last_sign ? std::chrono::duration<double>(now - *entry.last_sign).count() : -1.0;
  return {to_string(device), entry.text, entry.condition == Condition::Good, age_s, entry.troubles};
}

}  // namespace stairway::daemon
