// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/measurement_publisher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ipc/message_codec.hpp"
#include "scan_assembly/scan_placement.hpp"

namespace stairway::daemon {
namespace {

constexpr std::size_t kMaxWaiting = 40;
constexpr drivers::HostStamp kDiskInterval_ns = 100'000'000;
constexpr drivers::HostStamp kFreshAngle_ns = 250'000'000;
constexpr drivers::HostStamp kAnglesInterval_ns = 20'000'000;  // one by one they would be hundreds of messages a second

drivers::HostStamp last_beam_ns(const drivers::LaserScan& scan) {
  return scan::beam_stamp_ns(scan, std::max<std::size_t>(1, scan.ranges_m.size()) - 1);
}

}  // namespace

MeasurementPublisher::MeasurementPublisher(ipc::Channels channels, Publish publish, Utime utime_us)
    : channels_(std::move(channels)), publish_(std::move(publish)), utime_us_(std::move(utime_us)) {}

void MeasurementPublisher::add(drivers::LaserScan scan, const scan::AngleTrack& track) {
  send_angles();
  angles_.scan_stamp_ns = scan.first_beam_stamp_ns;
  waiting_.push_back(std::move(scan));
  send_known(track);
  if (waiting_.size() > kMaxWaiting) send_oldest(track);
}

void MeasurementPublisher::add(std::span<const drivers::AngleSample> samples, const scan::AngleTrack& track) {
  for (const drivers::AngleSample& sample : samples) {
    last_sample_ = sample;
    auto& unsent = angles_.samples;
    if (!unsent.empty() && sample.stamp_ns - unsent.front().stamp_ns >= kAnglesInterval_ns) send_angles();
    unsent.push_back(sample);
    if (last_disk_ns_ && sample.stamp_ns - *last_disk_ns_ < kDiskInterval_ns) continue;
    last_disk_ns_ = sample.stamp_ns;
    send(sample, track);
  }
  send_known(track);
}

std::int64_t MeasurementPublisher::utime_us(drivers::HostStamp stamp_ns) {
  if (!offset_us_) read_clocks(stamp_ns);
  return *offset_us_ + stamp_ns / 1000;
}

void MeasurementPublisher::send_known(const scan::AngleTrack& track) {
  const auto newest_ns = track.newest_ns();
  while (newest_ns && !waiting_.empty() && last_beam_ns(waiting_.front()) <= *newest_ns) send_oldest(track);
}

void MeasurementPublisher::send_angles() {
  if (angles_.samples.empty()) return;
  angles_.utime_us = utime_us(angles_.samples.front().stamp_ns);
  publish_(channels_.angles, ipc::encode(angles_));
  angles_.samples.clear();
}

void MeasurementPublisher::note(const SourceState& state, const scan::AngleTrack& track) {
  if (state.device == Device::Scanner) return;
  const DiskProblem before = disk_problem();
  failures_.erase(state.device);
  if (state.condition == Condition::Failed) failures_[state.device] = state.text;
  if (disk_problem() == before) return;
  const bool is_fresh = state.stamp_ns - last_sample_.stamp_ns < kFreshAngle_ns;
  send({std::max(state.stamp_ns, last_sample_.stamp_ns), last_sample_.angle_rad, last_sample_.valid && is_fresh},
       track);
}

DiskProblem MeasurementPublisher::disk_problem() const {
  for (const auto& [device, fault] : {std::pair{Device::Encoder, ipc::DiskFault::Encoder},
                                      {Device::Motor, ipc::DiskFault::Motor},
                                      {Device::Disk, ipc::DiskFault::Disk}}) {
    if (const auto failure = failures_.find(device); failure != failures_.end()) return {fault, failure->second};
  }
  return {};
}

void MeasurementPublisher::send_oldest(const scan::AngleTrack& track) {
  send_angles();
  ipc::ScanMessage message;
  message.scan = std::move(waiting_.front());
  waiting_.pop_front();
  read_clocks(message.scan.first_beam_stamp_ns);
  message.utime_us = utime_us(message.scan.first_beam_stamp_ns);
  const auto start_rad = track.at(message.scan.first_beam_stamp_ns);
  const auto end_rad = track.at(last_beam_ns(message.scan));
  message.disk_angle_valid = start_rad && end_rad;
  if (message.disk_angle_valid) {
    message.disk_angle_start_rad = *start_rad;
    message.disk_angle_end_rad = *end_rad;
  }
  publish_(channels_.scan, ipc::encode(message));
}

void MeasurementPublisher::send(const drivers::AngleSample& sample, const scan::AngleTrack& track) {
  if (sample.valid) {
    const double turns = std::abs(sample.angle_rad) / (2.0 * std::numbers::pi);
    index_count_ = std::max(index_count_, 1 + static_cast<std::int64_t>(turns));
  }
  ipc::DiskMessage message;
  message.utime_us = utime_us(sample.stamp_ns);
  message.sample = sample;
  message.speed_rad_s = track.speed_rad_s().value_or(0.0);
  message.index_count = index_count_;
  DiskProblem problem = disk_problem();
  message.fault = problem.fault;
  message.fault_text = std::move(problem.text);
  publish_(channels_.disk, ipc::encode(message));
}

}  // namespace stairway::daemon
