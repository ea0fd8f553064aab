// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "drivers/canopen/canopen_frames.hpp"
#include "drivers/canopen/cia402.hpp"
#include "drivers/canopen/sdo_frames.hpp"
#include "tools/sim/fake_drive_motor.hpp"
#include "tools/sim/fake_drive_objects.hpp"

namespace stairway::sim {

/// What the simulated drive is and where the disk stands.
struct FakeDriveOptions {
  int node_id = 1;
  drivers::HostStamp start_ns = 0;                       ///< when it is switched on
  double counts_per_turn = 204800.0;                     ///< of its position, in one turn of the disk
  double velocity_units_per_turn_per_s = 204800.0;       ///< of its speeds
  double acceleration_units_per_turn_per_s2 = 204800.0;  ///< of its ramps
  bool reverse = false;                                  ///< it counts up while the disk turns clockwise
  double start_turns = 0.0;                              ///< its position at the start, in turns of its own direction
  double boot_s = 0.05;                                  ///< from reset to boot-up
  double answer_s = 0.0005;                              ///< from request to answer, from SYNC to process data
  double friction_turns_per_s2 = 0.1;                    ///< what brakes the disk while the motor is off
  std::string name = "Simulated disk drive";             ///< object 1008; empty: there is none
  std::uint32_t serial = 1;
};

/// What is wrong with the simulated drive; may be changed at any time.
struct FakeDriveFaults {
  bool is_silent = false;             ///< sends nothing; still hears
  bool is_deaf = false;               ///< hears nothing; still sends
  bool has_no_heartbeat = false;      ///< sends everything else
  bool is_local = false;              ///< remote bit 0: controlwords have no effect
  bool is_torque_off = false;         ///< safe torque off: no voltage, cannot be switched on
  bool is_quick_stop_input = false;   ///< an emergency stop's contact
  bool is_fault_stuck = false;        ///< faults come back as soon as they are reset
  bool is_velocity_reversed = false;  ///< 606C has the wrong sign
  bool is_status_pdo_short = false;   ///< TPDO 1 has one byte less than it is mapped to
  bool is_mode_stuck = false;         ///< 6061 does not change
  double reachable_share = 1.0;       ///< of the target speed
  double ramp_share = 1.0;            ///< of the ramps that were set
  double disk_turns_per_turn = 1.0;   ///< of the disk while the drive believes in one: wrong units in the settings
  std::map<drivers::ObjectAddress, std::uint32_t> aborts;  ///< objects that are refused, with the code
  std::set<drivers::ObjectAddress> unanswered;             ///< objects without an answer
};

/// A CiA 402 drive in profile velocity mode as its CAN cable shows it: NMT, boot-up, heartbeat both ways, SDO expedited
/// and in segments, process data as they were mapped, SYNC, EMCY, the states of CiA 402 with ramps, quick stop and
/// fault reaction, and the disk that it turns. It has no thread or clock; results depend on what is received and when.
class FakeDrive {
 public:
  /// The disk's true speed, counter-clockwise from above, from this instant on; changes come in steps of 5 ms.
  using MotionListener = std::function<void(drivers::HostStamp, double speed_rad_s)>;

  explicit FakeDrive(const FakeDriveOptions& options);
  FakeDrive(const FakeDrive&) = delete;
  FakeDrive& operator=(const FakeDrive&) = delete;

  /// Takes what some other node sent at `now_ns`; times do not go back.
  void receive(const drivers::CanFrame& frame, drivers::HostStamp now_ns);
  /// When it will have something to say or the disk's speed changes; the greatest stamp when nothing is to come.
  drivers::HostStamp next_due_ns() const;
  /// Lets time pass: the disk turns, frames wait to be taken.
  void advance(drivers::HostStamp now_ns);
  /// The oldest frame that it has sent up to `now_ns`, with its time; empty when there is none. More than 1000 waiting
  /// ones are dropped.
  std::optional<std::pair<drivers::HostStamp, drivers::CanFrame>> take(drivers::HostStamp now_ns);

  void listen(MotionListener listener);
  /// Power off and on: everything is as at the start, but the disk turns on by its inertia.
  void power_cycle(drivers::HostStamp now_ns);
  /// A fault: EMCY, fault reaction, fault.
  void raise_fault(std::uint16_t code, drivers::HostStamp now_ns);
  FakeDriveFaults& faults() { return faults_; }

  drivers::DriveState state() const { return state_; }
  drivers::NmtState nmt_state() const { return nmt_state_; }
  std::uint16_t statusword() const;
  /// As of the last `advance`, `receive` or `take`.
  double disk_speed_rad_s() const { return rad_per_turn() * motor_.speed(); }
  const FakeDriveObjects& objects() const { return objects_; }

 private:
  void pass(drivers::HostStamp now_ns);
  drivers::HostStamp next_event_ns() const;
  double rad_per_turn() const;

  void on_nmt(const drivers::CanFrame& frame);
  void on_host_heartbeat();
  void on_sdo(const drivers::CanFrame& frame);
  void on_write(drivers::ObjectAddress object);
  void on_sync();
  void on_command_pdo(const drivers::PdoMap& map, const drivers::CanFrame& frame);
  void on_controlword(std::uint16_t word);
  void begin_boot(bool is_whole_node);
  void lose_host();
  void refresh_objects();

  void enter(drivers::DriveState state);
  void begin_quick_stop();
  void follow_target();
  void brake(drivers::ObjectAddress ramp);
  void coast();
  void watch_inputs();
  void finish_braking();
  double ramp(drivers::ObjectAddress object) const;

  void send(const drivers::CanFrame& frame, bool is_answer = false);
  void send_emergency(std::uint16_t code);
  void answer(const drivers::SdoFrame& frame);
  std::uint16_t id(std::uint16_t base) const { return static_cast<std::uint16_t>(base + options_.node_id); }

  FakeDriveOptions options_;
  FakeDriveFaults faults_;
  FakeDriveObjects objects_;
  FakeDriveMotor motor_;
  MotionListener listener_;
  drivers::HostStamp now_ns_;

  drivers::NmtState nmt_state_ = drivers::NmtState::BootUp;
  drivers::DriveState state_ = drivers::DriveState::SwitchOnDisabled;
  std::uint16_t old_control_ = 0;
  std::uint16_t fault_code_ = 0;
  drivers::HostStamp boot_end_ns_;
  drivers::HostStamp heartbeat_due_ns_;
  drivers::HostStamp host_deadline_ns_;
  std::string upload_;  // what remains of a segmented answer
  bool is_upload_toggled_ = false;
  std::multimap<drivers::HostStamp, drivers::CanFrame> output_;
};

}  // namespace stairway::sim
