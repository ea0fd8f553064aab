// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/clock_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::drivers {
namespace {

constexpr double kNsPerMs = 1e6;
constexpr double kNsPerSecond = 1e9;
constexpr double kMaxPeriodError = 0.02;  // of the nominal period
constexpr double kMaxStampError = 0.3;    // of a period; beyond it the count of turns is a guess
constexpr std::size_t kAnchorScans = 40;  // by then the fit is better than the stamp's rounding
constexpr double kMinDriftSpan_ms = 10e3;
constexpr double kMaxLatency_ns = 100e6;

bool is_within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::string ClockOptions::problem() const {
  if (!is_within(minimum_latency_ns, 0.0, 1e9)) return "minimum_latency must lie between 0 and 1000 ms";
  if (!is_within(window_s, 0.5, 60.0)) return "window must lie between 0.5 and 60 s";
  if (!is_within(max_gap_s, 0.1, 10.0)) return "max_gap must lie between 0.1 and 10 s";
  if (!is_within(max_step_ns, 1e5, 1e9)) return "max_step must lie between 0.1 and 1000 ms";
  return {};
}

HostStamp ClockMapping::Line::at(std::int64_t n) const {
  return arrival_ns + std::llround(static_cast<double>(n - turn) * period_ns);
}

double ClockMapping::Line::delay_ns(const Arrival& arrival) const {
  return static_cast<double>(arrival.arrival_ns - at(arrival.turn));
}

ClockMapping::ClockMapping(const ClockOptions& options, double nominal_period_ns)
    : options_(options), nominal_period_ns_(nominal_period_ns), latency_ns_(options.minimum_latency_ns) {
  line_.period_ns = nominal_period_ns;
}

ScanTime ClockMapping::add(std::int64_t device_stamp_ms, HostStamp arrival_ns, bool is_exact) {
  const Arrival arrival{next_turn(device_stamp_ms, arrival_ns), device_stamp_ms, arrival_ns, is_exact};
  last_ = arrival;
  drop_steps(arrival);
  window_.push_back(arrival);
  drop_before(arrival.turn - std::llround(options_.window_s * kNsPerSecond / line_.period_ns));
  build_hull();
  line_ = line_below();
  if (!anchor_ && window_.size() >= kAnchorScans) {
    anchor_ = Arrival{arrival.turn, device_stamp_ms, line_.at(arrival.turn), true};
  }
  if (reading_ && window_.size() >= kAnchorScans) measure_latency();
  return {static_cast<std::uint64_t>(arrival.turn), line_.at(arrival.turn) - std::llround(latency_ns_),
          line_.period_ns};
}

void ClockMapping::reset() {
  if (window_.empty()) return;
  window_.clear();
  anchor_.reset();
  ++resets_;
}

void ClockMapping::set_nominal_period(double nominal_period_ns) {
  reset();
  nominal_period_ns_ = nominal_period_ns;
  line_.period_ns = nominal_period_ns;
}

std::int64_t ClockMapping::next_turn(std::int64_t device_stamp_ms, HostStamp arrival_ns) {
  if (!last_) return 0;
  const double device_gap_ns = static_cast<double>(device_stamp_ms - last_->device_stamp_ms) * kNsPerMs;
  const double turns = std::max(1.0, std::round(device_gap_ns / line_.period_ns));
  const bool is_continued = !window_.empty() && device_gap_ns <= options_.max_gap_s * kNsPerSecond &&
                            std::abs(device_gap_ns - turns * line_.period_ns) <= kMaxStampError * line_.period_ns;
  if (is_continued) return last_->turn + static_cast<std::int64_t>(turns);
  reset();
  const double host_gap_ns = static_cast<double>(arrival_ns - last_->arrival_ns);
  return last_->turn + std::max<std::int64_t>(1, std::llround(host_gap_ns / line_.period_ns));
}

void ClockMapping::drop_steps(const Arrival& arrival) {
  if (window_.empty()) {
    last_on_time_ns_ = arrival.arrival_ns;
    return;
  }
  if (!arrival.is_exact) return;
  const double delay_ns = line_.delay_ns(arrival);
  const bool is_early = delay_ns < -options_.max_step_ns;
  const bool is_late = delay_ns > options_.max_step_ns;
  if (!is_late) last_on_time_ns_ = arrival.arrival_ns;
  const bool is_late_for_long = is_late && static_cast<double>(arrival.arrival_ns - last_on_time_ns_) > kNsPerSecond;
  if (is_early || is_late_for_long) {
    reset();
    last_on_time_ns_ = arrival.arrival_ns;
  }
}

void ClockMapping::drop_before(std::int64_t turn) {
  while (window_.front().turn < turn) window_.pop_front();
}

void ClockMapping::build_hull() {
  hull_.clear();
  const Arrival& origin = window_.front();
  const bool has_exact = std::ranges::any_of(window_, &Arrival::is_exact);
  double sum_turns = 0.0;
  int count = 0;
  for (const Arrival& arrival : window_) {
    if (has_exact && !arrival.is_exact) continue;
    const HullPoint c{static_cast<double>(arrival.turn - origin.turn),
                      static_cast<double>(arrival.arrival_ns - origin.arrival_ns)};
    sum_turns += c.turns;
    ++count;
    while (hull_.size() >= 2) {
      const HullPoint& a = hull_[hull_.size() - 2];
      const HullPoint& b = hull_.back();
      const bool is_b_below_ac =
          (b.arrival_ns - a.arrival_ns) * (c.turns - a.turns) < (c.arrival_ns - a.arrival_ns) * (b.turns - a.turns);
      if (is_b_below_ac) break;
      hull_.pop_back();
    }
    hull_.push_back(c);
  }
  mean_turns_ = sum_turns / count;
}

ClockMapping::Line ClockMapping::line_below() const {
  double period_ns = line_.period_ns;
  for (std::size_t i = 1; i < hull_.size(); ++i) {
    period_ns = (hull_[i].arrival_ns - hull_[i - 1].arrival_ns) / (hull_[i].turns - hull_[i - 1].turns);
    if (hull_[i].turns >= mean_turns_) break;
  }
  period_ns =
      std::clamp(period_ns, (1.0 - kMaxPeriodError) * nominal_period_ns_, (1.0 + kMaxPeriodError) * nominal_period_ns_);
  const auto lowest = std::ranges::min_element(
      hull_, {}, [&](const HullPoint& point) { return point.arrival_ns - point.turns * period_ns; });
  const Arrival& origin = window_.front();
  return {origin.turn + std::llround(lowest->turns), origin.arrival_ns + std::llround(lowest->arrival_ns), period_ns};
}

// Both clocks' readings are rounded down to the millisecond, so that the rounding cancels in the mean.
void ClockMapping::measure_latency() {
  double sum_ns = 0.0;
  for (const Arrival& arrival : window_) {
    const double elapsed_ns = static_cast<double>(arrival.device_stamp_ms - reading_->device_stamp_ms) * kNsPerMs;
    sum_ns += static_cast<double>(line_.at(arrival.turn) - reading_->host_ns) - elapsed_ns;
  }
  const double latency_ns = sum_ns / static_cast<double>(window_.size());
  if (is_within(latency_ns, 0.0, kMaxLatency_ns)) {
    latency_ns_ = latency_ns;
    round_trip_ns_ = static_cast<double>(reading_->round_trip_ns);
  }
  reading_.reset();
}

const char* to_string(ClockSource source) {
  switch (source) {
    case ClockSource::Passive:
      return "passive";
    case ClockSource::TimeAdjustment:
      return "tm";
    case ClockSource::SyncPulse:
      return "sync";
  }
  return "unknown";
}

ClockQuality ClockMapping::quality() const {
  ClockQuality quality;
  quality.source = round_trip_ns_ > 0.0 ? ClockSource::TimeAdjustment : ClockSource::Passive;
  quality.latency_ms = latency_ns_ / kNsPerMs;
  quality.round_trip_ms = round_trip_ns_ / kNsPerMs;
  quality.period_ms = line_.period_ns / kNsPerMs;
  quality.resets = resets_;
  quality.scans_in_fit = window_.size();
  if (window_.empty()) return quality;
  for (const Arrival& arrival : window_) quality.mean_delay_ms += line_.delay_ns(arrival) / kNsPerMs;
  quality.mean_delay_ms /= static_cast<double>(window_.size());
  quality.stamp_residual_ms = stamp_residual_ms();
  if (!anchor_) return quality;
  const auto device_ms = static_cast<double>(last_->device_stamp_ms - anchor_->device_stamp_ms);
  const double host_ms = static_cast<double>(line_.at(last_->turn) - anchor_->arrival_ns) / kNsPerMs;
  if (device_ms >= kMinDriftSpan_ms) quality.drift_ppm = (host_ms / device_ms - 1.0) * 1e6;
  return quality;
}

double ClockMapping::stamp_residual_ms() const {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
  for (const Arrival& arrival : window_) {
    const auto x = static_cast<double>(arrival.turn - window_.front().turn);
    const auto y = static_cast<double>(arrival.device_stamp_ms - window_.front().device_stamp_ms);
    n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
  }
  const double vxx = sxx - sx * sx / n;
  const double vxy = sxy - sx * sy / n;
  const double vyy = syy - sy * sy / n;
  if (vxx <= 0.0) return 0.0;
  return std::sqrt(std::max(0.0, vyy - vxy * vxy / vxx) / n);
}

}  // namespace stairway::drivers
