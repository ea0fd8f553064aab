// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0

// The states of CiA 402 and what they do to the motor.
#include <cmath>

#include "tools/sim/fake_drive.hpp"

namespace stairway::sim {
namespace {

using drivers::DriveState;
using drivers::HostStamp;
using drivers::ObjectAddress;
namespace objects = drivers::objects;
namespace statusword = drivers::statusword;

std::uint16_t state_bits(DriveState state) {
  switch (state) {
    case DriveState::NotReady:
    case DriveState::Unknown:
      return 0x0000;
    case DriveState::SwitchOnDisabled:
      return 0x0040;
    case DriveState::Ready:
      return 0x0021;
    case DriveState::SwitchedOn:
      return 0x0023;
    case DriveState::Enabled:
      return 0x0027;
    case DriveState::QuickStop:
      return 0x0007;
    case DriveState::FaultReaction:
      return 0x000f;
    case DriveState::Fault:
      return 0x0008;
  }
  return 0x0000;
}

}  // namespace

std::uint16_t FakeDrive::statusword() const {
  std::uint16_t word = state_bits(state_);
  if (!faults_.is_torque_off) word |= statusword::kVoltage;
  if (!faults_.is_local) word |= statusword::kRemote;
  if (state_ != DriveState::Enabled) return word;
  const double wanted = static_cast<std::int32_t>(objects_.get(objects::kTargetVelocity));
  const double actual = motor_.speed() * options_.velocity_units_per_turn_per_s;
  if (std::abs(actual - wanted) < 1.0) word |= statusword::kTargetReached;
  if (motor_.speed() == 0.0) word |= statusword::kStandstill;
  return word;
}

void FakeDrive::on_controlword(std::uint16_t word) {
  using namespace drivers::controlword;
  const bool is_reset_edge = (word & kFaultReset) != 0 && (old_control_ & kFaultReset) == 0;
  old_control_ = word;
  if (faults_.is_local) return;
  if (state_ == DriveState::Fault) {
    if (!is_reset_edge || faults_.is_fault_stuck) return;
    fault_code_ = 0;
    send_emergency(0);
    return enter(DriveState::SwitchOnDisabled);
  }
  if (state_ == DriveState::FaultReaction || state_ == DriveState::NotReady) return;
  if ((word & 0x82) == 0) {
    if (state_ != DriveState::SwitchOnDisabled) enter(DriveState::SwitchOnDisabled);
    return;
  }
  if ((word & 0x86) == kQuickStop) {
    if (state_ == DriveState::Enabled) return begin_quick_stop();
    if (state_ != DriveState::QuickStop) enter(DriveState::SwitchOnDisabled);
    return;
  }
  switch (word & 0x8f) {
    case kShutdown:
      if (state_ != DriveState::QuickStop && !faults_.is_torque_off) enter(DriveState::Ready);
      break;
    case kSwitchOn:
      if (state_ == DriveState::Ready || state_ == DriveState::Enabled) enter(DriveState::SwitchedOn);
      break;
    case kEnable:
      if (state_ == DriveState::SwitchedOn) enter(DriveState::Enabled);
      break;
    default:
      break;
  }
}

void FakeDrive::raise_fault(std::uint16_t code, HostStamp now_ns) {
  advance(now_ns);
  fault_code_ = code;
  send_emergency(code);
  enter(DriveState::FaultReaction);
  finish_braking();
}

void FakeDrive::enter(DriveState state) {
  state_ = state;
  switch (state) {
    case DriveState::Enabled:
      return follow_target();
    case DriveState::QuickStop:
    case DriveState::FaultReaction:
      return brake(objects::kQuickStopDeceleration);
    default:
      return coast();
  }
}

void FakeDrive::begin_quick_stop() {
  const std::uint32_t option = objects_.get(objects::kQuickStopOption);
  if (option == 0) return enter(DriveState::SwitchOnDisabled);
  state_ = DriveState::QuickStop;
  brake(option == 1 || option == 5 ? objects::kDeceleration : objects::kQuickStopDeceleration);
  finish_braking();
}

double FakeDrive::ramp(ObjectAddress object) const {
  return faults_.ramp_share * objects_.get(object) / options_.acceleration_units_per_turn_per_s2;
}

void FakeDrive::follow_target() {
  const auto units = static_cast<std::int32_t>(objects_.get(objects::kTargetVelocity));
  motor_.follow(faults_.reachable_share * units / options_.velocity_units_per_turn_per_s, ramp(objects::kAcceleration),
                ramp(objects::kDeceleration));
}

void FakeDrive::brake(ObjectAddress object) { motor_.follow(0.0, ramp(object), ramp(object)); }

void FakeDrive::coast() { motor_.follow(0.0, options_.friction_turns_per_s2, options_.friction_turns_per_s2); }

void FakeDrive::watch_inputs() {
  if (faults_.is_torque_off && !drivers::is_fault(state_) && state_ != DriveState::SwitchOnDisabled) {
    enter(DriveState::SwitchOnDisabled);
  }
  if (faults_.is_quick_stop_input && state_ == DriveState::Enabled) begin_quick_stop();
}

void FakeDrive::finish_braking() {
  if (motor_.speed() != 0.0) return;
  if (state_ == DriveState::FaultReaction) state_ = DriveState::Fault;
  const std::uint32_t option = objects_.get(objects::kQuickStopOption);
  if (state_ == DriveState::QuickStop && option < 5) state_ = DriveState::SwitchOnDisabled;
}

}  // namespace stairway::sim
