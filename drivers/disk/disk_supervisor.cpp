// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk/disk_supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stairway::drivers {
namespace {

// Of a ramp that keeps to the drive's acceleration; some drives round their ramps.
constexpr double kRampMargin = 2.0;

HostStamp to_ns(double seconds) { return std::llround(1e9 * seconds); }

bool is_set_up(MotorState state) { return state != MotorState::Searching && state != MotorState::Configuring; }

}  // namespace

void DiskSupervisor::Presence::set(bool is_now_present, HostStamp now_ns) {
  if (is_present && !is_now_present) lost_ns = now_ns;
  is_present = is_now_present;
}

bool DiskSupervisor::Presence::is_recent(HostStamp now_ns, double idle_after_s) const {
  return is_present || (lost_ns && now_ns - *lost_ns < to_ns(idle_after_s));
}

DiskSupervisor::DiskSupervisor(const DiskOptions& options, const DiskUnits& units)
    : options_(options),
      units_(units),
      is_ordered_(options.mode != DiskMode::Idle),
      full_speed_rad_s_(options.speed_rad_s()) {}

void DiskSupervisor::order(bool may_turn, double speed_rad_s, HostStamp now_ns) {
  is_ordered_ = may_turn;
  full_speed_rad_s_ = speed_rad_s;
  if (speed_in(state_) != wanted_rad_s_) want(speed_in(state_), now_ns);
}

void DiskSupervisor::on_scanner(bool is_streaming, HostStamp now_ns) { scanner_.set(is_streaming, now_ns); }

void DiskSupervisor::on_encoder(EncoderState state, HostStamp now_ns) {
  encoder_.set(state != EncoderState::Absent, now_ns);
  is_angle_broken_ = true;
}

void DiskSupervisor::on_motor(MotorState state, HostStamp now_ns) {
  if (!is_set_up(state)) is_checked_ = false;
  if (state != motor_) begin_ramp(wanted_rad_s_, now_ns);
  motor_ = state;
}

void DiskSupervisor::on_feedback(const DriveFeedback& feedback) {
  drive_.add(feedback.stamp_ns, feedback.angle_rad);
  if (!is_window_open_) return;
  drive_speed_sum_rad_s_ += feedback.speed_rad_s;
  ++feedbacks_;
}

void DiskSupervisor::on_angles(std::span<const AngleSample> samples) {
  for (const AngleSample& sample : samples) {
    // The index gives the angle another zero.
    const bool is_continued = sample.valid == is_angle_valid_ && !is_angle_broken_;
    angle_.add(sample.stamp_ns, sample.angle_rad, is_continued);
    is_angle_valid_ = sample.valid;
    is_angle_broken_ = false;
  }
}

std::vector<DiskEvent> DiskSupervisor::on_time(HostStamp now_ns) {
  choose_state(now_ns);
  compare(now_ns);
  return std::exchange(events_, {});
}

bool DiskSupervisor::may_turn(HostStamp now_ns) const {
  const bool is_angle_expected = !has_encoder() || encoder_.is_recent(now_ns, options_.idle_after_s);
  return is_ordered_ && is_angle_expected && scanner_.is_recent(now_ns, options_.idle_after_s) && is_set_up(motor_);
}

void DiskSupervisor::choose_state(HostStamp now_ns) {
  if (state_ == DiskState::Paused) {
    if (now_ns >= pause_end_ns_) enter(DiskState::Resting, now_ns);
    return;
  }
  if (!may_turn(now_ns)) return enter(DiskState::Resting, now_ns);
  if (!is_checked_) return enter(motor_ == MotorState::Running ? DiskState::Checking : DiskState::Resting, now_ns);
  enter(DiskState::Turning, now_ns);
}

void DiskSupervisor::enter(DiskState state, HostStamp now_ns) {
  if (state == state_) return;
  state_ = state;
  want(speed_in(state), now_ns);
  if (state == DiskState::Paused) pause_end_ns_ = now_ns + to_ns(options_.retry_s);
  events_.emplace_back(DiskStateEvent{state_, problem_});
}

double DiskSupervisor::speed_in(DiskState state) const {
  if (state == DiskState::Turning) return full_speed_rad_s_;
  if (state != DiskState::Checking) return 0.0;
  return std::copysign(std::min(std::abs(full_speed_rad_s_), options_.check_speed_rad_s), full_speed_rad_s_);
}

void DiskSupervisor::want(double speed_rad_s, HostStamp now_ns) {
  begin_ramp(speed_rad_s - wanted_rad_s_, now_ns);
  wanted_rad_s_ = speed_rad_s;
}

void DiskSupervisor::begin_ramp(double change_rad_s, HostStamp now_ns) {
  const double ramp_s = kRampMargin * std::abs(change_rad_s) / units_.acceleration_rad_s2;
  window_begin_ns_ = now_ns + to_ns(ramp_s + options_.settle_s);
  is_window_open_ = false;
}

void DiskSupervisor::compare(HostStamp now_ns) {
  if (motor_ != MotorState::Running || now_ns < window_begin_ns_) return;
  // Nothing is proved without the encoder.
  if (state_ == DiskState::Checking && has_encoder() && !encoder_.is_present) return begin_ramp(0.0, now_ns);
  if (!is_window_open_) {
    is_window_open_ = true;
    window_begin_ns_ = now_ns;
    drive_.restart();
    angle_.restart();
    drive_speed_sum_rad_s_ = 0.0;
    feedbacks_ = 0;
    return;
  }
  if (now_ns - window_begin_ns_ < to_ns(options_.check_window_s)) return;
  const bool is_check = state_ == DiskState::Checking;
  const SpeedLimits limits{is_check ? options_.check_tolerance : options_.slip_tolerance, options_.standing_speed_rad_s,
                           is_check};
  is_window_open_ = false;
  window_begin_ns_ = now_ns;
  conclude(compare_speeds(measured(), limits, units_), now_ns);
}

DiskSpeeds DiskSupervisor::measured() const {
  DiskSpeeds speeds;
  speeds.wanted_rad_s = wanted_rad_s_;
  if (feedbacks_ > 0) speeds.drive_speed_rad_s = drive_speed_sum_rad_s_ / feedbacks_;
  speeds.drive_position_rad_s = drive_.mean_rad_s();
  // Of an encoder that is gone, its own state tells.
  speeds.has_encoder = has_encoder() && encoder_.is_present;
  if (speeds.has_encoder) speeds.encoder_rad_s = angle_.mean_rad_s();
  return speeds;
}

void DiskSupervisor::conclude(const std::optional<DiskTroubleEvent>& finding, HostStamp now_ns) {
  if (finding) {
    ++counters_.troubles[static_cast<std::size_t>(finding->trouble)];
    events_.emplace_back(*finding);
  }
  // A disk that stands says nothing about what was wrong while it turned.
  const bool is_telling = finding || wanted_rad_s_ != 0.0 || (problem_ && problem_->trouble == DiskTrouble::Unasked);
  if (is_telling) tell(finding);
  const bool is_grave = finding && finding->trouble == DiskTrouble::Reversed;
  if (state_ == DiskState::Checking) {
    is_checked_ = !finding;
    enter(finding ? DiskState::Paused : DiskState::Turning, now_ns);
  } else if (state_ == DiskState::Turning && is_grave) {
    is_checked_ = false;
    enter(DiskState::Paused, now_ns);
  }
}

void DiskSupervisor::tell(const std::optional<DiskTroubleEvent>& problem) {
  const bool is_same =
      problem.has_value() == problem_.has_value() && (!problem || problem->trouble == problem_->trouble);
  problem_ = problem;
  if (!is_same) events_.emplace_back(DiskStateEvent{state_, problem_});
}

}  // namespace stairway::drivers
