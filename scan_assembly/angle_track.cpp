// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/angle_track.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::scan {
namespace {

using drivers::AngleSample;
using drivers::HostStamp;

constexpr double kSpeedWindow_ns = 0.2e9;

HostStamp to_ns(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

std::string AngleTrackOptions::problem() const {
  if (!(max_gap_s >= 0.001 && max_gap_s <= 10.0)) return "max_gap must lie between 0.001 and 10 s";
  if (!(max_extrapolation_s >= 0.0 && max_extrapolation_s <= 1.0))
    return "max_extrapolation must lie between 0 and 1 s";
  if (max_samples < 2 || max_samples > 10000000) return "max_samples must lie between 2 and 10000000";
  return {};
}

bool AngleTrack::add(const AngleSample& sample) {
  const bool is_newer = samples_.empty() || sample.stamp_ns > samples_.back().stamp_ns;
  if (!is_newer || !std::isfinite(sample.angle_rad)) {
    ++refused_samples_;
    return false;
  }
  samples_.push_back(sample);
  if (samples_.size() > static_cast<std::size_t>(options_.max_samples)) samples_.pop_front();
  return true;
}

tl::expected<double, AngleError> AngleTrack::at(HostStamp stamp_ns) const {
  return segment_at(stamp_ns).map([&](const AngleSegment& segment) { return segment.at(stamp_ns); });
}

tl::expected<AngleSegment, AngleError> AngleTrack::segment_at(HostStamp stamp_ns) const {
  if (samples_.empty() || stamp_ns < samples_.front().stamp_ns) return tl::unexpected(AngleError::Unknown);
  if (stamp_ns >= samples_.back().stamp_ns) return segment_past_newest(stamp_ns);
  const auto to = std::ranges::upper_bound(samples_, stamp_ns, {}, &AngleSample::stamp_ns);
  return line_through(*(to - 1), *to);
}

std::optional<HostStamp> AngleTrack::newest_ns() const {
  if (samples_.empty()) return std::nullopt;
  return samples_.back().stamp_ns;
}

std::optional<double> AngleTrack::speed_rad_s() const {
  if (samples_.size() < 2) return std::nullopt;
  const AngleSample& newest = samples_.back();
  auto oldest = samples_.end() - 1;
  while (oldest != samples_.begin() && newest.valid && is_bridged(*(oldest - 1), *oldest) &&
         static_cast<double>(newest.stamp_ns - (oldest - 1)->stamp_ns) <= kSpeedWindow_ns) {
    --oldest;
  }
  if (oldest->stamp_ns == newest.stamp_ns) return std::nullopt;
  return (newest.angle_rad - oldest->angle_rad) / (static_cast<double>(newest.stamp_ns - oldest->stamp_ns) * 1e-9);
}

bool AngleTrack::is_bridged(const AngleSample& from, const AngleSample& to) const {
  return from.valid && to.valid && to.stamp_ns - from.stamp_ns <= to_ns(options_.max_gap_s);
}

tl::expected<AngleSegment, AngleError> AngleTrack::line_through(const AngleSample& from, const AngleSample& to) const {
  if (!from.valid || !to.valid) return tl::unexpected(AngleError::Invalid);
  if (!is_bridged(from, to)) return tl::unexpected(AngleError::Unknown);
  const double speed = (to.angle_rad - from.angle_rad) / static_cast<double>(to.stamp_ns - from.stamp_ns);
  return AngleSegment{from.stamp_ns, to.stamp_ns, from.angle_rad, speed};
}

tl::expected<AngleSegment, AngleError> AngleTrack::segment_past_newest(HostStamp stamp_ns) const {
  const AngleSample& newest = samples_.back();
  if (stamp_ns == newest.stamp_ns) {
    if (!newest.valid) return tl::unexpected(AngleError::Invalid);
    return AngleSegment{newest.stamp_ns, newest.stamp_ns + 1, newest.angle_rad, 0.0};
  }
  const HostStamp end_ns = newest.stamp_ns + to_ns(options_.max_extrapolation_s);
  if (stamp_ns > end_ns || samples_.size() < 2) return tl::unexpected(AngleError::Unknown);
  auto segment = line_through(*(samples_.end() - 2), newest);
  if (!segment) return segment;
  return AngleSegment{newest.stamp_ns, end_ns + 1, newest.angle_rad, segment->speed_rad_per_ns};
}

}  // namespace stairway::scan
