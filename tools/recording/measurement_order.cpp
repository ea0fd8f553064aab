// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/measurement_order.hpp"

#include <algorithm>
#include <utility>

namespace stairway::tools {
namespace {

// Seconds of angles: a scan that has not come by then is lost.
constexpr std::size_t kMaxWaitingAngles = 500;

}  // namespace

void MeasurementOrder::add(ipc::ScanMessage message) { scans_.push_back(std::move(message.scan)); }

void MeasurementOrder::add(ipc::AnglesMessage message) { angles_.push_back(std::move(message)); }

std::optional<Measurement> MeasurementOrder::next() {
  if (is_angles_turn()) {
    auto samples = std::move(angles_.front().samples);
    angles_.pop_front();
    return samples;
  }
  if (scans_.empty()) return std::nullopt;
  drivers::LaserScan scan = std::move(scans_.front());
  scans_.pop_front();
  last_scan_ns_ = std::max(last_scan_ns_, scan.first_beam_stamp_ns);
  return scan;
}

bool MeasurementOrder::is_angles_turn() const {
  if (angles_.empty()) return false;
  const drivers::HostStamp wanted_ns = angles_.front().scan_stamp_ns;
  if (wanted_ns <= last_scan_ns_) return true;
  if (!scans_.empty()) return scans_.front().first_beam_stamp_ns > wanted_ns;
  return is_ended_ || angles_.size() > kMaxWaitingAngles;
}

}  // namespace stairway::tools
