// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/recording/measurement_stream.hpp"

#include <algorithm>
#include <utility>

#include "ipc/message_codec.hpp"
#include "scan_assembly/scan_placement.hpp"

namespace stairway::tools {
namespace {

using drivers::HostStamp;

// Angles come in front of the scan that needs them, so a few scans tell.
constexpr int kScansToTell = 10;
// Messages that were overtaken on their way are younger.
constexpr HostStamp kRestart_ns = 1'000'000'000;
// Thirty years, so that sums stay far from overflow whatever is sent.
constexpr HostStamp kLastStamp_ns = 1'000'000'000'000'000'000;

bool is_possible(std::int64_t stamp) { return stamp > -kLastStamp_ns && stamp < kLastStamp_ns; }

}  // namespace

void MeasurementStream::take(std::string_view channel, std::span<const std::uint8_t> bytes) {
  const auto take_if_decoded = [&](auto message) {
    message ? take(std::move(*message)) : static_cast<void>(++undecodable_);
  };
  if (channel == channels_.scan) take_if_decoded(ipc::decode<ipc::ScanMessage>(bytes));
  if (channel == channels_.angles) take_if_decoded(ipc::decode<ipc::AnglesMessage>(bytes));
}

void MeasurementStream::take(ipc::ScanMessage message) {
  drivers::LaserScan& scan = message.scan;
  if (!is_possible(scan.first_beam_stamp_ns) || !is_possible(message.utime_us) || !is_possible(shift_ns_))
    return static_cast<void>(++undecodable_);
  follow(scan.first_beam_stamp_ns, newest_scan_ns_);
  scan.first_beam_stamp_ns += shift_ns_;
  offset_us_ = message.utime_us - scan.first_beam_stamp_ns / 1000;
  if (!has_angles_ && ++scans_without_angles_ > kScansToTell) has_angles_ = false;
  if (!has_angles_) return;
  if (!*has_angles_ && message.disk_angle_valid) {
    const std::size_t last_beam = std::max<std::size_t>(1, scan.ranges_m.size()) - 1;
    const HostStamp first_ns = scan.first_beam_stamp_ns, last_ns = scan::beam_stamp_ns(scan, last_beam);
    order_.add(ipc::AnglesMessage{
        .samples = {{first_ns, message.disk_angle_start_rad, true}, {last_ns, message.disk_angle_end_rad, true}}});
  }
  order_.add(std::move(message));
}

void MeasurementStream::take(ipc::AnglesMessage message) {
  has_angles_ = true;
  if (message.samples.empty()) return;
  const auto is_sample_possible = [](const drivers::AngleSample& sample) { return is_possible(sample.stamp_ns); };
  const bool is_all_possible = std::ranges::all_of(message.samples, is_sample_possible);
  if (!is_all_possible || !is_possible(message.utime_us) || !is_possible(shift_ns_))
    return static_cast<void>(++undecodable_);
  follow(message.samples.front().stamp_ns, newest_angle_ns_);
  for (drivers::AngleSample& sample : message.samples) sample.stamp_ns += shift_ns_;
  if (is_possible(message.scan_stamp_ns)) message.scan_stamp_ns += shift_ns_;
  newest_angle_ns_ = std::max(*newest_angle_ns_, message.samples.back().stamp_ns);
  if (!offset_us_) offset_us_ = message.utime_us - message.samples.front().stamp_ns / 1000;
  order_.add(std::move(message));
}

void MeasurementStream::follow(HostStamp stamp_ns, std::optional<HostStamp>& newest_ns) {
  if (newest_ns && stamp_ns + shift_ns_ < *newest_ns - kRestart_ns) {
    ++restarts_;
    const HostStamp newest_of_all_ns =
        std::max(newest_scan_ns_.value_or(*newest_ns), newest_angle_ns_.value_or(*newest_ns));
    shift_ns_ = newest_of_all_ns + kRestart_ns - stamp_ns;
    newest_scan_ns_.reset();
    newest_angle_ns_.reset();
    offset_us_.reset();
  }
  newest_ns = std::max(newest_ns.value_or(stamp_ns + shift_ns_), stamp_ns + shift_ns_);
}

}  // namespace stairway::tools
