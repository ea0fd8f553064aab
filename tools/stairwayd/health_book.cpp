// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/health_book.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tools/stairwayd/reason_code.hpp"

namespace stairway::daemon {
namespace {

// The share of the disk's turn that lies behind.
double turn_progress(double angle_rad, double speed_rad_s) {
  const double turns = angle_rad / (2.0 * std::numbers::pi);
  const double share = turns - std::floor(turns);
  return speed_rad_s < 0.0 && share > 0.0 ? 1.0 - share : share;
}

double seconds_between(HealthBook::Clock::time_point from, HealthBook::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

double age_s(const std::optional<HealthBook::Clock::time_point>& since, HealthBook::Clock::time_point now) {
  return since ? seconds_between(*since, now) : -1.0;
}

std::string reason_of(const SourceState& state) {
  if (state.condition == Condition::Good) return {};
  if (!state.reason.empty()) return reason_code(state.reason);
  return state.condition == Condition::Failed ? "failed" : "starting";
}

// The scanner dates its answer within the round trip, and the answer is taken to be half of it old.
double bound_ms(const drivers::ClockQuality& quality) {
  return quality.round_trip_ms > 0.0 ? 0.5 * quality.round_trip_ms : -1.0;
}

}  // namespace

void HealthBook::note(const SourceState& state) {
  const std::lock_guard lock(mutex_);
  DeviceEntry& entry = devices_[state.device];
  entry.condition = state.condition;
  entry.text = state.text;
  entry.reason = reason_of(state);
}

void HealthBook::note(const drivers::ClockQuality& quality) {
  const std::lock_guard lock(mutex_);
  clock_ = quality;
}

void HealthBook::note(const SourceSign& sign, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  DeviceEntry& entry = devices_[sign.device];
  entry.last_sign = now;
  entry.signs += sign.count;
}

void HealthBook::note(drivers::DiskMode mode) {
  const std::lock_guard lock(mutex_);
  mode_ = mode;
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

void HealthBook::note_sweep(const scan::Sweep& sweep, Clock::time_point now) {
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
  result_.sweep = static_cast<std::int64_t>(sweep.number);
  result_.sweep_points = static_cast<std::int64_t>(sweep.cloud.points.size());
  result_.sweep_flaws = fmt::format("{}", fmt::join(sweep.statistics.flaws(), "; "));
  last_sweep_ = now;
}

void HealthBook::note_answer(const ipc::StairwaysMessage& answer, const ipc::Timings& timings, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (const auto& [stage, duration_ms] : timings) stages_.add(stage, duration_ms);
  result_.stairways = static_cast<int>(answer.detection.stairways.size());
  note_stairways(answer, now);
}

void HealthBook::note_preview(const ipc::StairwaysMessage& preview, const ipc::Timings& timings,
                              Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (const auto& [stage, duration_ms] : timings)
    if (stage == "total") stages_.add("preview", duration_ms);
  note_stairways(preview, now);
}

void HealthBook::note_stairways(const ipc::StairwaysMessage& answer, Clock::time_point now) {
  if (answer.detection.stairways.empty()) return;
  result_.stairway_sweep = answer.sweep;
  last_stairway_ = now;
}

void HealthBook::note_stage(std::string_view stage, Clock::duration duration) {
  const std::lock_guard lock(mutex_);
  stages_.add(stage, std::chrono::duration<double, std::milli>(duration).count());
}

void HealthBook::note_bus(std::string trouble) {
  const std::lock_guard lock(mutex_);
  bus_trouble_ = std::move(trouble);
}

void HealthBook::count(const std::string& name, std::uint64_t number) {
  if (number == 0) return;
  const std::lock_guard lock(mutex_);
  counts_[name] += static_cast<std::int64_t>(number);
}

void HealthBook::count_trouble(const SourceTrouble& trouble) {
  count(reason_code(trouble.name));
  if (!trouble.device) return;
  const std::lock_guard lock(mutex_);
  ++devices_[*trouble.device].troubles;
}

ipc::HealthMessage HealthBook::report(Clock::time_point now, std::int64_t utime_us) {
  const std::lock_guard lock(mutex_);
  ipc::HealthMessage health;
  health.utime_us = utime_us;
  for (const Finding& finding : findings()) {
    health.state.append(health.state.empty() ? "" : "; ").append(finding.text);
    if (!finding.reason.empty()) health.reasons.push_back(finding.reason);
  }
  health.sweep = sweep_;
  health.sweep_progress = progress_;
  health.points = points_;
  const double elapsed_s = seconds_between(last_report_, now);
  if (elapsed_s > 0.0) {
    health.scan_rate_hz = static_cast<double>(scans_) / elapsed_s;
    health.disk_rate_hz = static_cast<double>(angles_) / elapsed_s;
  }
  health.drops.assign(counts_.begin(), counts_.end());
  for (const auto& [device, entry] : devices_) health.devices.push_back(device_health(device, entry, now, elapsed_s));
  if (clock_)
    health.clock = {clock_->source,        clock_->period_ms,
                    clock_->latency_ms,    clock_->round_trip_ms,
                    bound_ms(*clock_),     clock_->sync_residual_ms,
                    clock_->mean_delay_ms, clock_->stamp_residual_ms,
                    clock_->drift_ppm,     static_cast<std::int64_t>(clock_->resets)};
  health.stages = stages_.report();
  health.result = result_health(now);
  last_report_ = now;
  scans_ = 0;
  angles_ = 0;
  for (auto& [device, entry] : devices_) entry.signs = 0;
  return health;
}

std::vector<HealthBook::Finding> HealthBook::findings() const {
  std::vector<Finding> found = measurement_findings();
  if (!recording_trouble_.empty()) found.push_back({"not recording: " + recording_trouble_, "not-recording"});
  if (!bus_trouble_.empty()) found.push_back({"not sending: " + bus_trouble_, "not-sending"});
  return found;
}

std::vector<HealthBook::Finding> HealthBook::measurement_findings() const {
  if (is_stopped_) return {{"stopped", "stopped"}};
  if (devices_.empty()) return {{"starting", "starting"}};
  if (auto failed = device_findings(Condition::Failed); !failed.empty()) return failed;
  if (mode_ == drivers::DiskMode::Idle) return {{"idle: the disk rests until a command", {}}};
  if (auto starting = device_findings(Condition::Starting); !starting.empty()) return starting;
  if (scans_ == 0) return {{"no scans arrive", "no-scans"}};
  if (angles_ == 0) return {{"no disk angles arrive", "no-angles"}};
  if (!is_angle_valid_) return {{"waiting for the disk's index", "no-index"}};
  return {{"scanning", {}}};
}

std::vector<HealthBook::Finding> HealthBook::device_findings(Condition condition) const {
  std::vector<Finding> found;
  for (const auto& [device, entry] : devices_) {
    if (entry.condition != condition) continue;
    found.push_back({fmt::format("{}: {}", to_string(device), entry.text),
                     reason_code(fmt::format("{}: {}", to_string(device), entry.reason))});
  }
  return found;
}

ipc::DeviceHealth HealthBook::device_health(Device device, const DeviceEntry& entry, Clock::time_point now,
                                            double elapsed_s) const {
  const double rate_hz = elapsed_s > 0.0 ? static_cast<double>(entry.signs) / elapsed_s : 0.0;
  return {to_string(device),           entry.text,    entry.reason, entry.condition == Condition::Good, rate_hz,
          age_s(entry.last_sign, now), entry.troubles};
}

ipc::ResultHealth HealthBook::result_health(Clock::time_point now) const {
  ipc::ResultHealth result = result_;
  result.sweep_age_s = age_s(last_sweep_, now);
  result.stairway_age_s = age_s(last_stairway_, now);
  return result;
}

}  // namespace stairway::daemon
