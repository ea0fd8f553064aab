// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/cia402.hpp"
#include "drivers/canopen/fault_recovery.hpp"
#include "drivers/canopen/feedback_assembler.hpp"
#include "drivers/canopen/motor_events.hpp"
#include "drivers/canopen/motor_options.hpp"
#include "drivers/canopen/process_data.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/canopen/setup_sequence.hpp"
#include "drivers/canopen/stop_sequence.hpp"
#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// Finds a CiA 402 drive, sets it up for profile velocity, enables it and lets it follow a wanted speed; tells the
/// disk's angle and speed at every SYNC. Frames and times in, events and frames out; it has no port, thread or clock.
///
/// Search (reset of the drive's communication, boot-up or heartbeat), objects, NMT start, then the states of CiA 402 by
/// what the drive's statusword says, target 0 until it is enabled. This host's heartbeat runs from the first frame on.
/// A drive that restarts is set up again from the start; one that falls silent is searched again, and nothing is
/// enabled without a statusword that came after. Faults are told with the drive's code and reset at most
/// `max_fault_resets` times per window, and only while the drive is under remote control. Other failures switch the
/// drive off and wait, longer each time up to `max_backoff_s`, without end.
///
/// Call `on_arrivals` or `on_time` at least once per `deadline()`, with times that do not go back, and send what
/// `take_output` gives, in order. Frames may come late and in batches; polls up to 50 ms apart are fine.
class MotorSession {
 public:
  /// @pre  options.problem() is empty.
  explicit MotorSession(const MotorOptions& options);

  /// Takes what arrived, by arrival; later than `now_ns` counts as now. Then lets time pass as `on_time` does. Events
  /// come in the order in which they happened.
  std::vector<MotorEvent> on_arrivals(std::span<const CanArrival> arrivals, HostStamp now_ns);
  /// Lets time pass: time-outs, heartbeat, SYNC.
  std::vector<MotorEvent> on_time(HostStamp now_ns) { return on_arrivals({}, now_ns); }
  /// The port failed, or could not be opened: waits, then searches from the start.
  std::vector<MotorEvent> on_disconnect(HostStamp now_ns, std::string_view detail);
  /// The port could not place a frame of the output; the others were not tried.
  std::vector<MotorEvent> on_unsent(HostStamp now_ns);
  /// Cuts the pause short that precedes the next attempt, e.g. because the interface came back.
  void retry_now(HostStamp now_ns);

  /// Frames to send; empty when none. Nothing while the link is down.
  std::vector<CanFrame> take_output();
  /// When something is due if no frames come [ns].
  HostStamp deadline() const;

  /// From now on and as soon as the drive is enabled; 0 brakes and leaves it enabled [rad/s of the disk]. NaN is 0.
  void set_speed(double speed_rad_s);
  double wanted_speed_rad_s() const { return wanted_rad_s_; }
  /// Begins the stop sequence at the next call, from any state; it ends in `Stopped`, where it stays until `start`.
  void stop();
  /// Likewise, with the drive's quick stop for a brake.
  void quick_stop();
  /// Begins again after a stop; during one, as soon as it has ended.
  void start();

  MotorState state() const;
  /// The last stop sequence ended with a drive that said that the disk stands and that it is off.
  bool has_stopped_safely() const { return step_ == Step::Stopped && stopping_.is_standing() && stopping_.is_off(); }
  /// The drive said that the disk stands, in the last stop sequence.
  bool has_seen_standstill() const { return step_ == Step::Stopped && stopping_.is_standing(); }
  const MotorCounters& counters() const { return counters_; }
  const MotorOptions& options() const { return options_; }

 private:
  enum class Step : std::uint8_t {
    Start,
    Search,
    Setup,
    StartNode,
    Enable,
    Run,
    ReadFault,
    WaitReset,
    ResetFault,
    Backoff,
    Stop,
    Stopped,
  };
  enum class Request : std::uint8_t { None, Stop, QuickStop, Start };

  void enter(Step step, HostStamp deadline_ns);
  void begin_search(HostStamp now_ns);
  void begin_setup(HostStamp now_ns);
  void begin_stop(bool is_quick, HostStamp now_ns);
  void end_stop();
  void back_off(HostStamp now_ns);
  void fail(MotorTrouble trouble, std::string detail, HostStamp now_ns);

  void on_frame(const CanFrame& frame, HostStamp at_ns);
  void on_condition(CanCondition condition, HostStamp at_ns);
  void on_heartbeat(const CanFrame& frame, HostStamp at_ns);
  void on_boot_up(HostStamp at_ns);
  void on_emergency(const CanFrame& frame, HostStamp at_ns);
  void on_status_pdo(const CanFrame& frame, HostStamp at_ns);
  void on_position_pdo(const CanFrame& frame, HostStamp at_ns);
  void on_sdo_result(const SdoResult& result, HostStamp at_ns);

  void step_enable(HostStamp at_ns);
  void step_run(HostStamp at_ns);
  void begin_fault(HostStamp at_ns);
  void step_fault(HostStamp at_ns);
  void tell_fault(const SdoResult& result, HostStamp at_ns);
  void wait_to_reset(HostStamp now_ns);
  void try_reset(HostStamp now_ns);
  void give_feedback();
  void watch_target(const DriveFeedback& feedback);

  void obey_request(HostStamp now_ns);
  void advance_transfers(HostStamp now_ns);
  void watch_drive(HostStamp now_ns);
  void watch_step(HostStamp now_ns);
  void tell_missing_drive(HostStamp now_ns);
  void send_cyclic(HostStamp now_ns);
  void follow_wanted(HostStamp now_ns);
  void command(std::uint16_t control, std::int32_t target);
  void send_command(HostStamp now_ns);
  void send(const CanFrame& frame);

  bool is_watched() const { return step_ >= Step::StartNode && step_ <= Step::ResetFault; }
  bool is_operational() const { return step_ >= Step::Enable && step_ <= Step::ResetFault; }
  bool is_at_rest() const { return step_ == Step::Backoff || step_ == Step::Stopped || step_ == Step::Start; }
  void report(MotorTrouble trouble, std::string detail, HostStamp at_ns);
  std::vector<MotorEvent> take_events();

  MotorOptions options_;
  MotorUnits units_;
  std::uint8_t node_;
  SdoClient sdo_;
  SetupSequence setup_;
  StopSequence stopping_;
  FaultRecovery recovery_;

  Step step_ = Step::Start;
  HostStamp step_deadline_ns_ = std::numeric_limits<HostStamp>::min();
  HostStamp now_ns_ = std::numeric_limits<HostStamp>::min();
  Request request_ = Request::None;
  double wanted_rad_s_ = 0.0;
  int failures_ = 0;             // in a row
  bool is_muted_ = false;        // the link is down
  bool is_unsent_told_ = false;  // since a frame was last heard
  HostStamp probe_ns_ = 0;       // when a search takes a drive that has not restarted

  HostStamp heartbeat_ns_ = std::numeric_limits<HostStamp>::min();  // the drive's last
  HostStamp status_ns_ = 0;                                         // its last statusword's
  std::uint16_t status_ = 0;
  DriveState drive_state_ = DriveState::Unknown;
  std::optional<DriveState> acted_on_;  // the state that the last command answered
  std::optional<Emergency> emergency_;

  DriveCommand command_{controlword::kDisableVoltage, 0};
  bool is_command_new_ = false;
  HostStamp command_due_ns_ = 0;
  HostStamp sync_due_ns_ = 0;
  HostStamp host_heartbeat_due_ns_ = std::numeric_limits<HostStamp>::max();
  HostStamp reach_deadline_ns_ = std::numeric_limits<HostStamp>::max();
  HostStamp target_ns_ = 0;  // when the target last changed

  FeedbackAssembler assembler_;
  double speed_rad_s_ = 0.0;  // last told by the drive
  int good_feedbacks_ = 0;    // since enabled

  MotorCounters counters_;
  std::map<std::string, HostStamp> told_ns_;
  std::vector<CanFrame> output_;
  std::vector<MotorEvent> events_;
};

}  // namespace stairway::drivers
