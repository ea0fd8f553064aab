// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/disk_motion.hpp"

#include <algorithm>

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr std::size_t kMaxLegs = 1000;

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

}  // namespace stairway::sim
