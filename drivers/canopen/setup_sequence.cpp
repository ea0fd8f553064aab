// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/setup_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr HostStamp kModePause_ns = 20'000'000;
constexpr std::uint32_t kDriveProfile = 402;
constexpr std::uint32_t kProfileVelocity = 3;
constexpr std::uint32_t kProfileVelocityBit = 1U << 2;
constexpr std::size_t kMaxName = 64;

MotorTrouble trouble_of(const SdoResult& result) {
  return result.outcome == SdoResult::Outcome::NoAnswer ? MotorTrouble::SdoTimeout : MotorTrouble::SdoAbort;
}

std::string printable(const std::string& text) {
  std::string out = text.substr(0, kMaxName);
  std::ranges::replace_if(
      out, [](char c) { return c < ' ' || c > '~'; }, ' ');
  out.erase(out.find_last_not_of(' ') + 1);
  return out;
}

}  // namespace

SetupSequence::SetupSequence(const MotorOptions& options)
    : steps_(motor_setup(options)), mode_timeout_ns_(std::llround(options.state_timeout_s * 1e9)) {}

void SetupSequence::begin(SdoClient& sdo, HostStamp now_ns) {
  next_ = 0;
  drive_ = {};
  mode_deadline_ns_ = kNever;
  request(sdo, now_ns);
}

void SetupSequence::request(SdoClient& sdo, HostStamp now_ns) {
  pause_end_ns_ = kNever;
  const SetupStep& step = steps_[next_];
  if (step.value) return sdo.write(step.object, *step.value, now_ns);
  sdo.read(step.object, now_ns);
}

SetupSequence::Advance SetupSequence::on_result(SdoClient& sdo, const SdoResult& result, HostStamp now_ns) {
  Advance advance;
  if (result.outcome != SdoResult::Outcome::Done) {
    advance = refuse(result);
  } else if (result.object == objects::kModeDisplay && result.number() != kProfileVelocity) {
    if (mode_deadline_ns_ == kNever) mode_deadline_ns_ = now_ns + mode_timeout_ns_;
    if (now_ns < mode_deadline_ns_) {
      pause_end_ns_ = now_ns + kModePause_ns;
      return advance;
    }
    advance = {Progress::Failed,
               MotorTroubleEvent{MotorTrouble::StateTimeout,
                                 "the drive does not change to profile velocity mode (6061 reads " +
                                     std::to_string(static_cast<std::int8_t>(result.number())) + ", not 3)"}};
  } else if (auto trouble = take(result)) {
    advance = {Progress::Failed, std::move(trouble)};
  }
  if (advance.progress == Progress::Failed) return advance;
  if (++next_ < steps_.size()) {
    request(sdo, now_ns);
  } else {
    advance.progress = Progress::Done;
  }
  return advance;
}

SetupSequence::Advance SetupSequence::refuse(const SdoResult& result) const {
  const char* without = steps_[next_].without;
  const bool is_tolerated = without != nullptr && result.is_missing();
  std::string detail = describe(result);
  if (is_tolerated) detail.append("; going on without: ").append(without);
  return {is_tolerated ? Progress::Going : Progress::Failed, MotorTroubleEvent{trouble_of(result), std::move(detail)}};
}

std::optional<MotorTroubleEvent> SetupSequence::take(const SdoResult& result) {
  using namespace objects;
  const std::uint32_t number = result.number();
  if (result.object == kDeviceType && (number & 0xffff) != kDriveProfile) {
    return MotorTroubleEvent{MotorTrouble::Unsuitable, "this node is no CiA 402 drive (object 1000 reads " +
                                                           hex_text(number, 8) + "): is motor.node_id right?"};
  }
  if (result.object == kSupportedModes && (number & kProfileVelocityBit) == 0) {
    return MotorTroubleEvent{MotorTrouble::Unsuitable,
                             "the drive has no profile velocity mode (object 6502 reads " + hex_text(number, 8) + ")"};
  }
  if (result.object == kDeviceName) drive_.name = printable(result.bytes);
  if (result.object == kVendor) drive_.vendor = number;
  if (result.object == kProduct) drive_.product = number;
  if (result.object == kRevision) drive_.revision = number;
  if (result.object == kSerial) drive_.serial = number;
  return std::nullopt;
}

void SetupSequence::on_time(SdoClient& sdo, HostStamp now_ns) {
  if (now_ns >= pause_end_ns_) request(sdo, now_ns);
}

}  // namespace stairway::drivers
