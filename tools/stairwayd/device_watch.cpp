// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/device_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stairway::daemon {
namespace {

using drivers::HostStamp;

// A trouble that comes so shortly before a device fails is why it failed.
constexpr HostStamp kCauseAge_ns = 2'000'000'000;

// Tells a pause from lost scans: what comes after it is no part of the sweep before.
constexpr std::uint64_t kNewStream = scan::kMaxLostScans + 1;

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

drivers::DiskUnits units(const config::Settings& settings) {
  const drivers::MotorOptions& motor = settings.motor;
  return {.counts_per_turn = motor.counts_per_turn,
          .velocity_units_per_turn_per_s = motor.velocity_units_per_turn_per_s,
          .is_drive_reversed = motor.reverse,
          .encoder_counts_per_turn = settings.encoder.counts_per_turn,
          .is_encoder_reversed = settings.encoder.reverse,
          .acceleration_rad_s2 = std::min(motor.acceleration_rad_s2, motor.deceleration_rad_s2)};
}

const char* describe(drivers::EncoderState state) {
  return state == drivers::EncoderState::Unindexed ? "waiting for its index" : to_string(state);
}

}  // namespace

const char* to_string(Device device) {
  switch (device) {
    case Device::Scanner:
      return "scanner";
    case Device::Motor:
      return "disk motor";
    case Device::Encoder:
      return "encoder";
    case Device::Disk:
      return "disk";
  }
  return "unknown";
}

DeviceWatch::DeviceWatch(const config::Settings& settings)
    : disk_(settings.disk),
      supervisor_(settings.disk, units(settings)),
      is_turning_(settings.disk.mode != drivers::DiskMode::Idle) {
  line(Device::Disk) = {Condition::Good, to_string(drivers::DiskState::Resting), {}, {}, 0};
  for (const Device device : kDevices) {
    if (device == Device::Encoder && disk_.angle_source == drivers::AngleSource::Drive) continue;
    events_.emplace_back(SourceState{device, line(device).condition, line(device).text, 0, {}});
  }
}

void DeviceWatch::take(drivers::ScipEvent event, HostStamp now_ns) {
  std::visit(Overloaded{
                 [&](drivers::LaserScan& scan) {
                   sign(Device::Scanner, 1);
                   if (!is_turning_) return;
                   scan.sequence += sequence_shift_;
                   events_.emplace_back(std::move(scan));
                 },
                 [&](const drivers::ScipDeviceInfo& device) {
                   const drivers::VersionInfo& version = device.version;
                   events_.emplace_back(SourceNote{fmt::format("scanner {}, serial {}, firmware {}", version.product,
                                                               version.serial, version.firmware)});
                 },
                 [&](drivers::ScipTroubleEvent& trouble) {
                   report(Device::Scanner, to_string(trouble.trouble), std::move(trouble.detail), now_ns);
                 },
                 [&](const drivers::ScipStateEvent& change) {
                   const bool is_streaming = change.state == drivers::ScipState::Streaming;
                   supervisor_.on_scanner(is_streaming, now_ns);
                   set(Device::Scanner, is_streaming, to_string(change.state), now_ns);
                 },
                 [](const drivers::ScipReopenEvent&) {},
             },
             event);
}

void DeviceWatch::take(drivers::MotorEvent event, HostStamp now_ns) {
  std::visit(Overloaded{
                 [&](const drivers::DriveFeedback& feedback) {
                   sign(Device::Motor, 1);
                   supervisor_.on_feedback(feedback);
                   if (disk_.angle_source == drivers::AngleSource::Drive)
                     add_angles({{feedback.stamp_ns, feedback.angle_rad - disk_.drive_zero_rad, is_drive_running_}});
                 },
                 [&](const drivers::DriveInfo& drive) {
                   events_.emplace_back(
                       SourceNote{fmt::format("disk motor drive {}, vendor {:#x}, product {:#x}, "
                                              "revision {:#x}, serial {}",
                                              drive.name.empty() ? "without a name" : drive.name, drive.vendor,
                                              drive.product, drive.revision, drive.serial)});
                 },
                 [&](drivers::MotorTroubleEvent& trouble) {
                   report(Device::Motor, to_string(trouble.trouble), std::move(trouble.detail), now_ns);
                 },
                 [&](const drivers::MotorStateEvent& change) {
                   is_drive_running_ = change.state == drivers::MotorState::Running;
                   supervisor_.on_motor(change.state, now_ns);
                   const bool is_off = motor_wish() != MotorWish::On && change.state == drivers::MotorState::Stopped;
                   set(Device::Motor, is_drive_running_ || is_off, to_string(change.state), now_ns);
                 },
             },
             event);
}

void DeviceWatch::take(drivers::EncoderEvent event, HostStamp now_ns) {
  std::visit(Overloaded{
                 [&](std::vector<drivers::AngleSample>& samples) {
                   sign(Device::Encoder, samples.size());
                   supervisor_.on_angles(samples);
                   add_angles(std::move(samples));
                 },
                 [&](drivers::EncoderTroubleEvent& trouble) {
                   report(Device::Encoder, to_string(trouble.trouble), std::move(trouble.detail), now_ns);
                 },
                 [&](const drivers::EncoderStateEvent& change) {
                   supervisor_.on_encoder(change.state, now_ns);
                   set(Device::Encoder, change.state == drivers::EncoderState::Indexed, describe(change.state), now_ns);
                 },
             },
             event);
}

void DeviceWatch::order(const DiskOrder& order, HostStamp now_ns) {
  supervisor_.order(order.is_turning, order.speed_rad_s, now_ns);
  if (is_turning_ && !order.is_turning) sequence_shift_ += kNewStream;
  is_turning_ = order.is_turning;
}

MotorWish DeviceWatch::motor_wish() const {
  if (is_reversed_) return MotorWish::QuickStop;
  return is_turning_ ? MotorWish::On : MotorWish::Off;
}

void DeviceWatch::pass_time(HostStamp now_ns) {
  for (drivers::DiskEvent& event : supervisor_.on_time(now_ns)) {
    std::visit(Overloaded{
                   [&](drivers::DiskTroubleEvent& trouble) {
                     report(Device::Disk, to_string(trouble.trouble), std::move(trouble.detail), now_ns);
                   },
                   [&](drivers::DiskStateEvent& change) {
                     is_reversed_ = change.state == drivers::DiskState::Paused && change.problem &&
                                    change.problem->trouble == drivers::DiskTrouble::Reversed;
                     const bool is_checking = change.state == drivers::DiskState::Checking;
                     if (change.problem) {
                       return tell(Device::Disk, Condition::Failed, change.problem->detail,
                                   to_string(change.problem->trouble), now_ns);
                     }
                     tell(Device::Disk, is_checking ? Condition::Starting : Condition::Good, to_string(change.state),
                          is_checking ? to_string(change.state) : "", now_ns);
                   },
               },
               event);
  }
}

std::vector<SourceEvent> DeviceWatch::take_events() {
  for (const Device device : kDevices) {
    const std::size_t count = std::exchange(signs_[static_cast<std::size_t>(device)], 0);
    if (count > 0) events_.emplace_back(SourceSign{device, count});
  }
  return std::exchange(events_, {});
}

void DeviceWatch::set(Device device, bool is_good, std::string text, HostStamp now_ns) {
  Line& entry = line(device);
  if (is_good || (entry.condition == Condition::Good && now_ns - entry.trouble_ns > kCauseAge_ns))
    entry.trouble.clear();
  if (is_good) return tell(device, Condition::Good, std::move(text), {}, now_ns);
  if (entry.trouble.empty()) return tell(device, Condition::Starting, text, text, now_ns);
  tell(device, Condition::Failed, entry.trouble, entry.reason, now_ns);
}

void DeviceWatch::tell(Device device, Condition condition, std::string text, std::string reason, HostStamp now_ns) {
  Line& entry = line(device);
  if (entry.condition == condition && entry.text == text) return;
  entry.condition = condition;
  entry.text = text;
  events_.emplace_back(SourceState{device, condition, std::move(text), now_ns, std::move(reason)});
}

void DeviceWatch::report(Device device, const char* trouble, std::string detail, HostStamp now_ns) {
  Line& entry = line(device);
  entry.trouble = detail.empty() ? trouble : detail;
  entry.reason = trouble;
  entry.trouble_ns = now_ns;
  events_.emplace_back(SourceTrouble{device, fmt::format("{}: {}", to_string(device), trouble), std::move(detail)});
  if (device != Device::Disk && entry.condition != Condition::Good)
    tell(device, Condition::Failed, entry.trouble, entry.reason, now_ns);
}

void DeviceWatch::add_angles(std::vector<drivers::AngleSample> samples) {
  auto* last = events_.empty() ? nullptr : std::get_if<std::vector<drivers::AngleSample>>(&events_.back());
  if (last == nullptr) {
    events_.emplace_back(std::move(samples));
  } else {
    last->insert(last->end(), samples.begin(), samples.end());
  }
}

}  // namespace stairway::daemon
