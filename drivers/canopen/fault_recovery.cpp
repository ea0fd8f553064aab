// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/fault_recovery.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();

std::string seconds_text(HostStamp duration_ns) {
  return std::to_string((duration_ns + 999'999'999) / 1'000'000'000) + " s";
}

}  // namespace

FaultRecovery::FaultRecovery(const MotorOptions& options)
    : most_(static_cast<std::size_t>(options.max_fault_resets)),
      window_ns_(std::llround(options.fault_reset_window_s * 1e9)) {}

void FaultRecovery::begin() {
  is_local_told_ = false;
  is_limit_told_ = false;
}

FaultRecovery::Decision FaultRecovery::decide(std::uint16_t word, HostStamp now_ns) {
  if (decode_statusword(word) != DriveState::Fault) return {};
  if ((word & statusword::kRemote) == 0) {
    return refuse(is_local_told_,
                  "the fault is not reset: the drive is not under remote control (bit 9 of statusword " +
                      hex_text(word, 4) + "); release its local control");
  }
  if (const HostStamp wanted_ns = allowed_ns(); now_ns < wanted_ns) {
    const std::string next = wanted_ns == kNever ? "reset it by hand" : "next in " + seconds_text(wanted_ns - now_ns);
    return refuse(is_limit_told_, "no more fault resets than " + std::to_string(most_) + " in " +
                                      seconds_text(window_ns_) + "; " + next + ", or remove the cause");
  }
  resets_ns_.push_back(now_ns);
  if (resets_ns_.size() > most_) resets_ns_.pop_front();
  is_limit_told_ = false;
  return {.is_reset_due = true, .hurdle = std::nullopt};
}

HostStamp FaultRecovery::allowed_ns() const {
  if (most_ == 0) return kNever;
  return resets_ns_.size() < most_ ? std::numeric_limits<HostStamp>::min() : resets_ns_.front() + window_ns_;
}

FaultRecovery::Decision FaultRecovery::refuse(bool& is_told, std::string hurdle) {
  if (std::exchange(is_told, true)) return {};
  return {.is_reset_due = false, .hurdle = std::move(hurdle)};
}

}  // namespace stairway::drivers
