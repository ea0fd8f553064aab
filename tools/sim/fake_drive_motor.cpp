// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_drive_motor.hpp"

#include <algorithm>
#include <cmath>

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr HostStamp kStep_ns = 5'000'000;

}  // namespace

void FakeDriveMotor::follow(double target, double acceleration, double deceleration) {
  target_ = target;
  acceleration_ = acceleration;
  deceleration_ = deceleration;
  if (speed_ != target_ && step_ns_ == kNever) step_ns_ = now_ns_ + kStep_ns;
}

HostStamp FakeDriveMotor::next_step_ns() const { return speed_ == target_ ? kNever : step_ns_; }

void FakeDriveMotor::advance(HostStamp now_ns) {
  while (next_step_ns() <= now_ns) {
    turns_ += speed_ * 1e-9 * static_cast<double>(step_ns_ - now_ns_);
    now_ns_ = step_ns_;
    step();
    step_ns_ = speed_ == target_ ? kNever : step_ns_ + kStep_ns;
  }
  if (now_ns <= now_ns_) return;
  turns_ += speed_ * 1e-9 * static_cast<double>(now_ns - now_ns_);
  now_ns_ = now_ns;
}

void FakeDriveMotor::step() {
  const bool is_braking = speed_ * (target_ - speed_) < 0.0;
  const double most = (is_braking ? deceleration_ : acceleration_) * 1e-9 * static_cast<double>(kStep_ns);
  const double goal = is_braking && speed_ * target_ < 0.0 ? 0.0 : target_;
  const double old_speed = speed_;
  speed_ += std::clamp(goal - speed_, -most, most);
  if (listener_ && speed_ != old_speed) listener_(now_ns_, speed_);
}

}  // namespace stairway::sim
