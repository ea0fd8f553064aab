// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/disk_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr std::size_t kMaxLegs = 1000;
constexpr HostStamp kRestInterval_ns = 50'000'000;

}  // namespace

DiskMotion::DiskMotion(HostStamp start_ns, double start_angle_rad, double speed_rad_s)
    : legs_{{start_ns, start_angle_rad, speed_rad_s}} {}

void DiskMotion::set_speed(HostStamp stamp_ns, double speed_rad_s) {
  stamp_ns = std::max(stamp_ns, legs_.back().start_ns);
  legs_.push_back({stamp_ns, angle_at(stamp_ns), speed_rad_s});
  if (legs_.size() > kMaxLegs) legs_.pop_front();
}

const DiskMotion::Leg& DiskMotion::leg_at(HostStamp stamp_ns) const {
  const auto after = std::upper_bound(legs_.begin(), legs_.end(), stamp_ns,
                                      [](HostStamp stamp, const Leg& leg) { return stamp < leg.start_ns; });
  return after == legs_.begin() ? legs_.front() : *std::prev(after);
}

double DiskMotion::angle_at(HostStamp stamp_ns) const {
  const Leg& leg = leg_at(stamp_ns);
  return leg.angle_rad + leg.speed_rad_s * 1e-9 * static_cast<double>(stamp_ns - leg.start_ns);
}

std::optional<HostStamp> DiskMotion::next_change(HostStamp stamp_ns) const {
  const auto after = std::upper_bound(legs_.begin(), legs_.end(), stamp_ns,
                                      [](HostStamp stamp, const Leg& leg) { return stamp < leg.start_ns; });
  return after == legs_.end() ? std::nullopt : std::optional{after->start_ns};
}

FakeEncoder::FakeEncoder(const DiskMotion& motion, HostStamp start_ns, int counts_per_turn)
    : radians_per_count_{2 * std::numbers::pi / counts_per_turn},
      counts_per_turn_{counts_per_turn},
      count_{std::llround(motion.angle_at(start_ns) / radians_per_count_)},
      stamp_ns_{start_ns},
      is_homed_{count_ % counts_per_turn_ == 0} {}

HostStamp FakeEncoder::next_sample_ns(const DiskMotion& motion) const {
  const double speed = motion.speed_at(stamp_ns_);
  const HostStamp rest = stamp_ns_ + kRestInterval_ns;
  if (speed == 0.0) return rest;
  const double next_angle = radians_per_count_ * static_cast<double>(count_ + (speed > 0 ? 1 : -1));
  const double wait_ns = 1e9 * (next_angle - motion.angle_at(stamp_ns_)) / speed;
  return wait_ns < static_cast<double>(kRestInterval_ns) ? stamp_ns_ + std::max<HostStamp>(1, std::llround(wait_ns))
                                                         : rest;
}

std::vector<drivers::AngleSample> FakeEncoder::samples_until(const DiskMotion& motion, HostStamp now_ns) {
  std::vector<drivers::AngleSample> samples;
  for (;;) {
    HostStamp next = next_sample_ns(motion);
    // A change of speed before the expected edge moves it; look again from there.
    const auto change = motion.next_change(stamp_ns_);
    const bool is_changed = change && *change < next;
    if (is_changed) next = *change;
    if (next > now_ns) return samples;
    step_to(next, std::llround(motion.angle_at(next) / radians_per_count_));
    if (!is_changed) samples.push_back({next, radians_per_count_ * static_cast<double>(count_), is_homed_});
  }
}

void FakeEncoder::step_to(HostStamp stamp_ns, std::int64_t count) {
  stamp_ns_ = stamp_ns;
  count_ = count;
  if (count % counts_per_turn_ == 0) is_homed_ = true;
}

}  // namespace stairway::sim
