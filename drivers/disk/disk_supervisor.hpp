// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/canopen/motor_events.hpp"
#include "drivers/disk/disk_events.hpp"
#include "drivers/disk/disk_options.hpp"
#include "drivers/disk/speed_check.hpp"
#include "drivers/disk/speed_meter.hpp"
#include "drivers/encoder/encoder_events.hpp"
#include "drivers/types.hpp"

namespace stairway::drivers {

/// Decides how fast the disk should turn, and compares what was commanded with what drive and encoder say. What the
/// devices tell and times in, the wanted speed and events out.
///
/// The disk turns while scanner, drive and encoder are ready; when scanner or encoder are lost it goes on for
/// `idle_after_s`, so that a device that comes back soon finds it turning. Before the first turn, and after the drive
/// was set up anew, it turns slowly and the speeds are compared; when they do not fit, it stands for `retry_s` and says
/// which setting looks wrong. Later troubles are told once per window of time while they last; only a wrong direction
/// stops the disk, the others may pass.
class DiskSupervisor {
 public:
  /// @pre  options.problem() is empty.
  DiskSupervisor(const DiskOptions& options, const DiskUnits& units);

  /// From now on: whether the disk may turn at all, and how fast it does when it turns [rad/s], not 0.
  void order(bool may_turn, double speed_rad_s, HostStamp now_ns);

  void on_scanner(bool is_streaming, HostStamp now_ns);
  void on_motor(MotorState state, HostStamp now_ns);
  void on_feedback(const DriveFeedback& feedback);
  void on_encoder(EncoderState state, HostStamp now_ns);
  void on_angles(std::span<const AngleSample> samples);

  /// The disk was braked by others, and gets up to the wanted speed from now on.
  void expect_ramp(HostStamp now_ns) { begin_ramp(wanted_rad_s_, now_ns); }

  /// Lets time pass and gives what came of it, in order. Call it at least ten times a second, with times that do not go
  /// back.
  std::vector<DiskEvent> on_time(HostStamp now_ns);

  /// For the drive [rad/s].
  double wanted_speed_rad_s() const { return wanted_rad_s_; }
  DiskState state() const { return state_; }
  const DiskCounters& counters() const { return counters_; }

 private:
  // Whether a device is there, or was until when.
  struct Presence {
    bool is_present = false;
    std::optional<HostStamp> lost_ns;

    void set(bool is_now_present, HostStamp now_ns);
    bool is_recent(HostStamp now_ns, double idle_after_s) const;
  };

  bool has_encoder() const { return options_.angle_source == AngleSource::Encoder; }
  bool may_turn(HostStamp now_ns) const;
  void choose_state(HostStamp now_ns);
  void enter(DiskState state, HostStamp now_ns);
  double speed_in(DiskState state) const;
  void want(double speed_rad_s, HostStamp now_ns);
  void compare(HostStamp now_ns);
  void conclude(const std::optional<DiskTroubleEvent>& finding, HostStamp now_ns);
  DiskSpeeds measured() const;
  void begin_ramp(double change_rad_s, HostStamp now_ns);
  void tell(const std::optional<DiskTroubleEvent>& problem);

  DiskOptions options_;
  DiskUnits units_;
  bool is_ordered_;
  double full_speed_rad_s_;
  Presence scanner_;
  Presence encoder_;
  MotorState motor_ = MotorState::Searching;

  DiskState state_ = DiskState::Resting;
  std::optional<DiskTroubleEvent> problem_;
  bool is_checked_ = false;
  double wanted_rad_s_ = 0.0;
  HostStamp pause_end_ns_ = 0;

  HostStamp window_begin_ns_ = 0;  // in the future while a ramp goes on
  bool is_window_open_ = false;
  SpeedMeter drive_;
  SpeedMeter angle_;
  bool is_angle_valid_ = false;
  bool is_angle_broken_ = false;  // the next sample does not go on from the last
  double drive_speed_sum_rad_s_ = 0.0;
  int feedbacks_ = 0;

  DiskCounters counters_;
  std::vector<DiskEvent> events_;
};

}  // namespace stairway::drivers
