// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scan_clock.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "drivers/scip/scan_conversion.hpp"

namespace stairway::drivers {
namespace {

constexpr int kRepeatsToReport = 2;  // after the first: one repetition also comes from rounding
constexpr double kMaxFuture_ns = 1e6;
constexpr int kFutureScansToReport = 20;  // in a row: single ones come from a busy host's late arrivals

std::string whole_ms(double ns) { return std::to_string(std::llround(ns / 1e6)) + " ms"; }

}  // namespace

ScanClock::ScanClock(const ScipOptions& options)
    : reference_(options.stamp_reference),
      skip_scan_(options.skip_scan),
      mapping_(options.clock, SensorParameters{}.scan_period_ns(options.skip_scan)),
      pulses_(options.sync_offset_ns) {}

void ScanClock::expect_reset() {
  unwrapper_.clear();
  mapping_.reset();
}

void ScanClock::begin_stream(const SensorParameters& sensor) {
  const double period_ns = sensor.scan_period_ns(skip_scan_);
  if (period_ns != mapping_.nominal_period_ns()) mapping_.set_nominal_period(period_ns);
  pulses_.set_turn_period(sensor.scan_period_ns(0));
  last_stamp_ms_ = -1;
  future_scans_ = 0;
  is_misplacement_told_ = false;
}

LaserScan ScanClock::to_scan(const RawScan& raw, const ScanRequest& request, const SensorParameters& sensor,
                             HostStamp arrival_ns, bool is_arrival_exact) {
  const std::int64_t stamp_ms = take_stamp(raw.stamp_ms);
  const ScanTime time = place(stamp_ms, arrival_ns, is_arrival_exact);
  LaserScan scan = to_laser_scan(raw, request, sensor, stamp_ms, time, reference_);
  check_end(scan, arrival_ns);
  check_pulses();
  return scan;
}

std::vector<ScipTroubleEvent> ScanClock::take_troubles() { return std::exchange(troubles_, {}); }

std::int64_t ScanClock::take_stamp(std::uint32_t raw_ms) {
  const auto [stamp_ms, is_reset] = unwrapper_.unwrap(raw_ms);
  const std::string detail = "device stamp " + std::to_string(stamp_ms) + " ms";
  if (is_reset) {
    troubles_.push_back({ScipTrouble::ClockReset, detail});
    mapping_.reset();
  }
  repeated_stamps_ = stamp_ms == last_stamp_ms_ ? repeated_stamps_ + 1 : 0;
  if (repeated_stamps_ == kRepeatsToReport) troubles_.push_back({ScipTrouble::RepeatedStamp, detail});
  last_stamp_ms_ = stamp_ms;
  return stamp_ms;
}

ScanTime ScanClock::place(std::int64_t device_stamp_ms, HostStamp arrival_ns, bool is_arrival_exact) {
  const auto latency_ns = std::llround(mapping_.latency_ns());
  const bool was_locked = pulses_.is_locked();
  const auto rear_ns = pulses_.match(arrival_ns - latency_ns);
  if (pulses_.is_locked() != was_locked) mapping_.reset();
  if (!pulses_.is_locked()) return mapping_.add(device_stamp_ms, arrival_ns, is_arrival_exact);
  return mapping_.add(device_stamp_ms, rear_ns ? *rear_ns + latency_ns : arrival_ns, rear_ns.has_value());
}

void ScanClock::check_end(const LaserScan& scan, HostStamp arrival_ns) {
  const double beams = static_cast<double>(scan.ranges_m.size()) - 1.0;
  const double end_ns = static_cast<double>(scan.first_beam_stamp_ns - arrival_ns) + beams * scan.beam_interval_ns;
  future_scans_ = end_ns > kMaxFuture_ns ? std::min(future_scans_ + 1, kFutureScansToReport + 1) : 0;
  if (future_scans_ != kFutureScansToReport) return;
  troubles_.push_back({ScipTrouble::FutureStamp, "a scan arrived " + whole_ms(end_ns) +
                                                     " before its last beam; check min_latency and stamp_reference"});
}

void ScanClock::check_pulses() {
  if (!pulses_.is_misplaced() || std::exchange(is_misplacement_told_, true)) return;
  troubles_.push_back(
      {ScipTrouble::SyncPulse, "pulses come " + whole_ms(pulses_.residual_ns()) +
                                   " behind the scans' clock and are left out; add that to sync_offset"});
}

ClockQuality ScanClock::quality() const {
  ClockQuality quality = mapping_.quality();
  quality.sync_residual_ms = pulses_.residual_ns() / 1e6;
  if (pulses_.is_locked()) quality.source = ClockSource::SyncPulse;
  return quality;
}

}  // namespace stairway::drivers
