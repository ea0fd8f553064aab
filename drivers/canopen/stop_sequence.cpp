// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/stop_sequence.hpp"

#include <cmath>

namespace stairway::drivers {
namespace {

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr HostStamp kPause_ns = 20'000'000;
constexpr HostStamp kOffTime_ns = 500'000'000;  // of a drive that closes a brake before it lets go

}  // namespace

StopSequence::StopSequence(const MotorOptions& options)
    : units_(options),
      standstill_rad_s_(options.standstill_speed_rad_s),
      timeout_ns_(std::llround(options.stop_timeout_s * 1e9)) {}

void StopSequence::begin(SdoClient& sdo, bool is_quick, HostStamp now_ns) {
  is_quick_ = is_quick;
  is_standing_ = false;
  is_off_ = false;
  brake_end_ns_ = now_ns + timeout_ns_;
  request(sdo, Step::Brake, now_ns);
}

void StopSequence::request(SdoClient& sdo, Step step, HostStamp now_ns) {
  using namespace objects;
  step_ = step;
  pause_end_ns_ = kNever;
  switch (step) {
    case Step::Brake:
      if (is_quick_) return sdo.write(kControlword, ObjectValue{controlword::kQuickStop, 2}, now_ns);
      return sdo.write(kTargetVelocity, ObjectValue{0, 4}, now_ns);
    case Step::AskState:
    case Step::CheckState:
      return sdo.read(kStatusword, now_ns);
    case Step::AskSpeed:
      return sdo.read(kActualVelocity, now_ns);
    case Step::Shutdown:
      return sdo.write(kControlword, ObjectValue{controlword::kShutdown, 2}, now_ns);
    case Step::DisableVoltage:
      return sdo.write(kControlword, ObjectValue{controlword::kDisableVoltage, 2}, now_ns);
    case Step::EndWatch:
      return sdo.write(kHostHeartbeat, ObjectValue{0, 4}, now_ns);
  }
}

bool StopSequence::on_result(SdoClient& sdo, const SdoResult& result, HostStamp now_ns) {
  if (result.outcome == SdoResult::Outcome::NoAnswer) return true;
  const bool is_done = result.outcome == SdoResult::Outcome::Done;
  switch (step_) {
    case Step::AskState: {
      const auto word = static_cast<std::uint16_t>(result.number());
      is_standing_ = is_done && decode_statusword(word) == DriveState::Enabled && (word & statusword::kStandstill) != 0;
      break;
    }
    case Step::AskSpeed: {
      const auto velocity = static_cast<std::int32_t>(result.number());
      is_standing_ |= is_done && std::abs(units_.speed_rad_s(velocity)) <= standstill_rad_s_;
      if (is_standing_ || now_ns >= brake_end_ns_) break;
      pause_end_ns_ = now_ns + kPause_ns;
      return false;
    }
    case Step::DisableVoltage:
      off_end_ns_ = now_ns + kOffTime_ns;
      break;
    case Step::CheckState:
      is_off_ = is_done && drivers::is_off(decode_statusword(static_cast<std::uint16_t>(result.number())));
      if (is_off_) break;
      if (now_ns >= off_end_ns_) return true;
      pause_end_ns_ = now_ns + kPause_ns;
      return false;
    case Step::EndWatch:
      return true;
    default:
      break;
  }
  request(sdo, static_cast<Step>(static_cast<int>(step_) + 1), now_ns);
  return false;
}

void StopSequence::on_time(SdoClient& sdo, HostStamp now_ns) {
  if (now_ns < pause_end_ns_) return;
  request(sdo, step_ == Step::CheckState ? Step::CheckState : Step::AskState, now_ns);
}

}  // namespace stairway::drivers
