// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drivers/canopen/little_endian.hpp"

namespace stairway::sim {
namespace {

using drivers::CanFrame;
using drivers::DriveState;
using drivers::HostStamp;
using drivers::NmtCommand;
using drivers::NmtState;
using drivers::ObjectAddress;
using drivers::SdoFrame;
using drivers::SdoKind;
namespace cob = drivers::cob;
namespace objects = drivers::objects;

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr std::size_t kMostOutput = 1000;
constexpr std::uint16_t kHostLost = 0x8130;
constexpr std::uint16_t kPdoTooShort = 0x8210;
constexpr std::uint8_t kGenericError = 0x01;

HostStamp to_ns(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

FakeDrive::FakeDrive(const FakeDriveOptions& options)
    : options_(options),
      objects_(static_cast<std::uint8_t>(options.node_id), options.name, options.serial),
      motor_(options.start_ns, options.start_turns),
      now_ns_(options.start_ns),
      boot_end_ns_(options.start_ns + to_ns(options.boot_s)),
      heartbeat_due_ns_(kNever),
      host_deadline_ns_(kNever) {
  motor_.listen([this](HostStamp at_ns, double turns_per_s) {
    if (listener_) listener_(at_ns, rad_per_turn() * turns_per_s);
  });
}

void FakeDrive::listen(MotionListener listener) { listener_ = std::move(listener); }

double FakeDrive::rad_per_turn() const {
  return (options_.reverse ? -2.0 : 2.0) * std::numbers::pi * faults_.disk_turns_per_turn;
}

HostStamp FakeDrive::next_event_ns() const {
  return std::min({motor_.next_step_ns(), boot_end_ns_, heartbeat_due_ns_, host_deadline_ns_});
}

HostStamp FakeDrive::next_due_ns() const {
  return output_.empty() ? next_event_ns() : std::min(next_event_ns(), output_.begin()->first);
}

void FakeDrive::advance(HostStamp now_ns) {
  while (next_event_ns() <= now_ns) pass(std::max(now_ns_, next_event_ns()));
  pass(std::max(now_ns_, now_ns));
}

// Everything up to `now_ns`, the next event at the latest.
void FakeDrive::pass(HostStamp now_ns) {
  now_ns_ = now_ns;
  motor_.advance(now_ns);
  finish_braking();
  watch_inputs();
  if (now_ns >= boot_end_ns_) {
    boot_end_ns_ = kNever;
    send(drivers::encode_heartbeat(static_cast<std::uint8_t>(options_.node_id), NmtState::BootUp));
    nmt_state_ = NmtState::PreOperational;
  }
  if (now_ns >= heartbeat_due_ns_) {
    if (!faults_.has_no_heartbeat) {
      send(drivers::encode_heartbeat(static_cast<std::uint8_t>(options_.node_id), nmt_state_));
    }
    heartbeat_due_ns_ += static_cast<HostStamp>(objects_.get(objects::kHeartbeatPeriod)) * 1'000'000;
  }
  if (now_ns >= host_deadline_ns_) lose_host();
}

std::optional<std::pair<HostStamp, CanFrame>> FakeDrive::take(HostStamp now_ns) {
  advance(now_ns);
  if (output_.empty() || output_.begin()->first > now_ns) return std::nullopt;
  auto first = *output_.begin();
  output_.erase(output_.begin());
  return first;
}

void FakeDrive::send(const CanFrame& frame, bool is_answer) {
  if (faults_.is_silent || output_.size() >= kMostOutput) return;
  output_.emplace(now_ns_ + (is_answer ? to_ns(options_.answer_s) : 0), frame);
}

void FakeDrive::send_emergency(std::uint16_t code) {
  if (nmt_state_ == NmtState::BootUp || nmt_state_ == NmtState::Stopped) return;
  const std::uint8_t error_register = code == 0 ? 0 : kGenericError;
  send(drivers::encode_emergency(static_cast<std::uint8_t>(options_.node_id), {code, error_register, {}}));
}

void FakeDrive::receive(const CanFrame& frame, HostStamp now_ns) {
  advance(now_ns);
  if (faults_.is_deaf) return;
  if (frame.id == cob::kNmt) return on_nmt(frame);
  if (nmt_state_ == NmtState::BootUp || boot_end_ns_ != kNever) return;
  const std::uint32_t watched = objects_.get(objects::kHostHeartbeat);
  if (watched != 0 && frame.id == cob::kHeartbeat + (watched >> 16 & 0x7f)) on_host_heartbeat();
  if (nmt_state_ == NmtState::Stopped) return;
  if (frame.id == id(cob::kSdoRequest)) return on_sdo(frame);
  if (nmt_state_ != NmtState::Operational) return;
  if (frame.id == cob::kSync) return on_sync();
  for (std::uint16_t communication = 0x1400; communication <= 0x1403; ++communication) {
    const auto map = objects_.pdo(communication);
    if (map && map->identifier == frame.id) on_command_pdo(*map, frame);
  }
}

void FakeDrive::on_nmt(const CanFrame& frame) {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != options_.node_id)) return;
  const auto command = static_cast<NmtCommand>(frame.data[0]);
  const bool is_reset = command == NmtCommand::ResetNode || command == NmtCommand::ResetCommunication;
  if (is_reset) return begin_boot(command == NmtCommand::ResetNode);
  if (boot_end_ns_ != kNever) return;
  if (command == NmtCommand::Start) nmt_state_ = NmtState::Operational;
  if (command == NmtCommand::Stop) nmt_state_ = NmtState::Stopped;
  if (command == NmtCommand::EnterPreOperational) nmt_state_ = NmtState::PreOperational;
}

void FakeDrive::begin_boot(bool is_whole_node) {
  // Without its connection the drive does what 6007 says, just as when it misses the host.
  if (state_ == DriveState::Enabled) lose_host();
  if (is_whole_node) {
    objects_.reset_all();
    enter(DriveState::SwitchOnDisabled);
  } else {
    objects_.reset_communication();
  }
  upload_.clear();
  nmt_state_ = NmtState::BootUp;
  boot_end_ns_ = now_ns_ + to_ns(options_.boot_s);
  heartbeat_due_ns_ = kNever;
  host_deadline_ns_ = kNever;
}

void FakeDrive::power_cycle(HostStamp now_ns) {
  advance(now_ns);
  output_.clear();
  enter(DriveState::SwitchOnDisabled);
  begin_boot(true);
}

void FakeDrive::on_host_heartbeat() {
  const std::uint32_t period_ms = objects_.get(objects::kHostHeartbeat) & 0xffff;
  host_deadline_ns_ = now_ns_ + static_cast<HostStamp>(period_ms) * 1'000'000;
}

void FakeDrive::lose_host() {
  if (host_deadline_ns_ != kNever) send_emergency(kHostLost);
  host_deadline_ns_ = kNever;
  const std::uint32_t reaction = objects_.get(objects::kCommunicationError);
  if (nmt_state_ == NmtState::Operational && reaction == 0) nmt_state_ = NmtState::PreOperational;
  if (nmt_state_ == NmtState::Operational && reaction == 2) nmt_state_ = NmtState::Stopped;
  if (state_ != DriveState::Enabled) return;
  switch (objects_.get(objects::kConnectionLoss)) {
    case 1:
      fault_code_ = kHostLost;
      return enter(DriveState::FaultReaction);
    case 2:
      return enter(DriveState::SwitchOnDisabled);
    case 3:
      return begin_quick_stop();
    default:
      return;
  }
}

void FakeDrive::answer(const SdoFrame& frame) { send(drivers::encode_sdo(id(cob::kSdoAnswer), frame), true); }

void FakeDrive::on_sdo(const CanFrame& frame) {
  const auto request = drivers::decode_sdo_request(frame);
  if (!request) return;
  const auto refuse = [&](std::uint32_t code) {
    answer({.kind = SdoKind::Abort, .object = request->object, .number = code});
  };
  if (request->kind == SdoKind::UploadAskSegment) {
    if (upload_.empty() || request->is_toggled != is_upload_toggled_) return refuse(drivers::sdo_abort::kToggle);
    SdoFrame segment{.kind = SdoKind::UploadSegment, .is_toggled = is_upload_toggled_};
    segment.bytes = upload_.substr(0, 7);
    upload_.erase(0, 7);
    segment.is_last = upload_.empty();
    is_upload_toggled_ = !is_upload_toggled_;
    return answer(segment);
  }
  upload_.clear();
  if (request->kind != SdoKind::UploadRequest && request->kind != SdoKind::DownloadRequest) return;
  if (faults_.unanswered.contains(request->object)) return;
  if (const auto code = faults_.aborts.find(request->object); code != faults_.aborts.end()) return refuse(code->second);
  if (request->kind == SdoKind::DownloadRequest) {
    if (!request->is_expedited) return refuse(drivers::sdo_abort::kLength);
    if (const auto written = objects_.write(request->object, request->bytes); !written) return refuse(written.error());
    answer({.kind = SdoKind::DownloadDone, .object = request->object});
    return on_write(request->object);
  }
  refresh_objects();
  const auto bytes = objects_.read(request->object);
  if (!bytes) return refuse(bytes.error());
  SdoFrame upload{.kind = SdoKind::UploadAnswer, .object = request->object, .is_expedited = bytes->size() <= 4};
  if (upload.is_expedited) {
    upload.bytes = *bytes;
  } else {
    upload.number = static_cast<std::uint32_t>(bytes->size());
    upload_ = *bytes;
    is_upload_toggled_ = false;
  }
  answer(upload);
}

void FakeDrive::on_write(ObjectAddress object) {
  if (object == objects::kHeartbeatPeriod) {
    heartbeat_due_ns_ = objects_.get(object) == 0 ? kNever : now_ns_;
    advance(now_ns_);
  }
  if (object == objects::kHostHeartbeat) host_deadline_ns_ = kNever;
  if (object == objects::kMode && !faults_.is_mode_stuck) {
    objects_.set(objects::kModeDisplay, objects_.get(objects::kMode));
  }
  if (object == objects::kControlword) {
    on_controlword(static_cast<std::uint16_t>(objects_.get(objects::kControlword)));
  } else if (state_ == DriveState::Enabled) {
    follow_target();
  }
}

void FakeDrive::refresh_objects() {
  const double velocity = motor_.speed() * options_.velocity_units_per_turn_per_s;
  const auto units = static_cast<std::int32_t>(std::lround(faults_.is_velocity_reversed ? -velocity : velocity));
  const auto counts = static_cast<std::int64_t>(std::floor(motor_.turns() * options_.counts_per_turn));
  objects_.set(objects::kStatusword, statusword());
  objects_.set(objects::kActualVelocity, static_cast<std::uint32_t>(units));
  objects_.set(objects::kActualPosition, static_cast<std::uint32_t>(counts));
  objects_.set(objects::kErrorCode, fault_code_);
}

void FakeDrive::on_sync() {
  refresh_objects();
  for (std::uint16_t communication = 0x1800; communication <= 0x1803; ++communication) {
    const auto map = objects_.pdo(communication);
    if (!map || map->transmission_type == 0 || map->transmission_type > 240) continue;
    CanFrame frame{static_cast<std::uint16_t>(map->identifier), 0, {}};
    for (const drivers::MappedObject& entry : map->objects) {
      const std::size_t bytes = entry.bits / 8U;
      drivers::store_little_endian(objects_.get(entry.object), std::span(frame.data).subspan(frame.length, bytes));
      frame.length = static_cast<std::uint8_t>(frame.length + bytes);
    }
    if (faults_.is_status_pdo_short && communication == 0x1800) --frame.length;
    send(frame, true);
  }
}

void FakeDrive::on_command_pdo(const drivers::PdoMap& map, const CanFrame& frame) {
  std::size_t bits = 0;
  for (const drivers::MappedObject& entry : map.objects) bits += entry.bits;
  if (frame.length * 8U < bits) return send_emergency(kPdoTooShort);
  std::size_t position = 0;
  for (const drivers::MappedObject& entry : map.objects) {
    const std::size_t bytes = entry.bits / 8U;
    objects_.set(entry.object, drivers::load_little_endian(std::span(frame.data).subspan(position), bytes));
    position += bytes;
  }
  on_controlword(static_cast<std::uint16_t>(objects_.get(objects::kControlword)));
  if (state_ == DriveState::Enabled) follow_target();
}

}  // namespace stairway::sim
