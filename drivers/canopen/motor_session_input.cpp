// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0

// What a frame, a condition of the bus and the end of a transfer do to the session.
#include <cmath>
#include <utility>

#include "drivers/canopen/little_endian.hpp"
#include "drivers/canopen/motor_session.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr HostStamp kResetPause_ns = 500'000'000;
constexpr double kReachedShare = 0.05;
constexpr int kProvenFeedbacks = 500;  // after which earlier failures are forgiven

HostStamp to_ns(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

void MotorSession::on_frame(const CanFrame& frame, HostStamp at_ns) {
  if (step_ == Step::Stopped) return;
  is_muted_ = false;
  is_unsent_told_ = false;
  if (frame.id == cob::kHeartbeat + node_) {
    on_heartbeat(frame, at_ns);
  } else if (frame.id == cob::kTpdo1 + node_) {
    on_status_pdo(frame, at_ns);
  } else if (frame.id == cob::kTpdo2 + node_) {
    on_position_pdo(frame, at_ns);
  } else if (frame.id == cob::kEmergency + node_) {
    on_emergency(frame, at_ns);
  } else if (frame.id == cob::kSdoAnswer + node_) {
    if (sdo_.on_frame(frame, at_ns)) return;
    report(MotorTrouble::Unexpected, to_string(frame) + ": an answer too late, or to another CAN master", at_ns);
  } else if (frame.id == cob::kNmt || frame.id == cob::kSdoRequest + node_) {
    report(MotorTrouble::Unexpected, to_string(frame) + ": another CAN master commands this drive", at_ns);
  } else if (frame.id == cob::kHeartbeat + options_.host_node_id) {
    report(MotorTrouble::Unexpected,
           to_string(frame) + ": another station uses this host's node number, see motor.host_node_id", at_ns);
  }
}

void MotorSession::on_condition(CanCondition condition, HostStamp at_ns) {
  if (step_ == Step::Stopped || condition == CanCondition::Active) return;
  const bool is_back = condition == CanCondition::LinkUp || condition == CanCondition::Restarted;
  if (!is_back) {
    std::string detail = options_.interface + ": " + to_string(condition);
    if (condition == CanCondition::LinkDown) detail += "; `ip link set " + options_.interface + " up`";
    if (condition == CanCondition::BusOff) detail += "; it comes back by itself only with a restart-ms";
    report(MotorTrouble::Bus, std::move(detail), at_ns);
  }
  if (condition == CanCondition::LinkDown) is_muted_ = true;
  if (condition == CanCondition::LinkUp) is_muted_ = false;
  const bool is_lost = condition == CanCondition::LinkDown || condition == CanCondition::BusOff;
  if (is_lost && step_ == Step::Stop) return end_stop();
  if ((is_lost || is_back) && !is_at_rest() && step_ != Step::Stop) begin_search(at_ns);
}

void MotorSession::on_heartbeat(const CanFrame& frame, HostStamp at_ns) {
  const auto nmt_state = decode_heartbeat(frame);
  if (!nmt_state) return report(MotorTrouble::Unexpected, to_string(frame) + ": not a heartbeat", at_ns);
  heartbeat_ns_ = at_ns;
  if (*nmt_state == NmtState::BootUp) return on_boot_up(at_ns);
  if (step_ == Step::Search) {
    if (at_ns >= probe_ns_) begin_setup(at_ns);
  } else if (step_ == Step::StartNode) {
    if (*nmt_state == NmtState::Operational) {
      acted_on_.reset();
      command(controlword::kDisableVoltage, 0);
      is_command_new_ = false;
      command_due_ns_ = kNever;  // nothing is commanded before the first statusword
      sync_due_ns_ = at_ns;
      status_ns_ = at_ns;
      enter(Step::Enable, at_ns + to_ns(options_.state_timeout_s));
    }
  } else if (is_operational() && *nmt_state != NmtState::Operational) {
    fail(MotorTrouble::Unexpected,
         std::string("the drive is ") + to_string(*nmt_state) + " though it was started: did it miss this host?",
         at_ns);
  }
}

void MotorSession::on_boot_up(HostStamp at_ns) {
  if (step_ == Step::Backoff || step_ == Step::Stop) return;
  if (step_ != Step::Search) {
    report(MotorTrouble::Rebooted, "the drive has restarted and is set up again", at_ns);
    assembler_.forget_position();
  }
  begin_setup(at_ns);
}

void MotorSession::on_emergency(const CanFrame& frame, HostStamp at_ns) {
  const auto emergency = decode_emergency(frame);
  if (!emergency) return report(MotorTrouble::Unexpected, to_string(frame) + ": not an EMCY", at_ns);
  emergency_ = emergency->code == 0 ? std::nullopt : emergency;
  if (emergency_) report(MotorTrouble::Emergency, "EMCY " + describe(*emergency), at_ns);
}

void MotorSession::on_status_pdo(const CanFrame& frame, HostStamp at_ns) {
  if (!is_operational()) return;
  const auto told = decode_status(frame);
  if (!told) return report(MotorTrouble::Unexpected, to_string(frame) + ": shorter than it was mapped", at_ns);
  status_ = told->status;
  status_ns_ = at_ns;
  drive_state_ = decode_statusword(status_);
  assembler_.on_status(status_, told->velocity, at_ns);
  give_feedback();
  if (is_fault(drive_state_) && (step_ == Step::Enable || step_ == Step::Run)) return begin_fault(at_ns);
  if (step_ == Step::Enable) return step_enable(at_ns);
  if (step_ == Step::Run) return step_run(at_ns);
  step_fault(at_ns);
}

void MotorSession::on_position_pdo(const CanFrame& frame, HostStamp at_ns) {
  if (!is_operational()) return;
  const auto position = decode_position(frame);
  if (!position) return report(MotorTrouble::Unexpected, to_string(frame) + ": shorter than it was mapped", at_ns);
  assembler_.on_position(*position, at_ns);
  give_feedback();
}

void MotorSession::give_feedback() {
  const auto feedback = assembler_.take();
  if (!feedback) return;
  ++counters_.feedbacks;
  speed_rad_s_ = feedback->speed_rad_s;
  if (step_ == Step::Run) {
    if (++good_feedbacks_ >= kProvenFeedbacks) failures_ = 0;
    watch_target(*feedback);
  }
  events_.emplace_back(*feedback);
}

void MotorSession::watch_target(const DriveFeedback& feedback) {
  if (feedback.stamp_ns <= target_ns_) return;
  const double tolerance_rad_s = kReachedShare * std::abs(wanted_rad_s_) + options_.standstill_speed_rad_s;
  const bool is_near = std::abs(feedback.speed_rad_s - wanted_rad_s_) <= tolerance_rad_s;
  if (is_near || (status_ & statusword::kTargetReached) != 0) reach_deadline_ns_ = kNever;
}

void MotorSession::step_enable(HostStamp at_ns) {
  if (drive_state_ == DriveState::Enabled && acted_on_ == DriveState::Enabled) {
    good_feedbacks_ = 0;
    target_ns_ = at_ns;
    reach_deadline_ns_ = kNever;
    return enter(Step::Run, kNever);
  }
  const auto control = command_to_enable(drive_state_);
  if (!control || acted_on_ == drive_state_) return;
  acted_on_ = drive_state_;
  command(*control, 0);
  step_deadline_ns_ = at_ns + to_ns(options_.state_timeout_s);
}

void MotorSession::step_run(HostStamp at_ns) {
  if (drive_state_ == DriveState::Enabled) return;
  std::string detail =
      "the drive left operation by itself (statusword " + hex_text(status_, 4) + ", " + to_string(drive_state_) + ")";
  const bool is_unpowered = (status_ & statusword::kVoltage) == 0;
  detail += is_unpowered ? ": safe torque off, or no motor voltage" : ": a quick stop input, or another master";
  if (good_feedbacks_ < kProvenFeedbacks) return fail(MotorTrouble::SwitchedOff, std::move(detail), at_ns);
  report(MotorTrouble::SwitchedOff, std::move(detail), at_ns);
  acted_on_.reset();
  enter(Step::Enable, at_ns + to_ns(options_.state_timeout_s));
}

void MotorSession::begin_fault(HostStamp at_ns) {
  command(controlword::kDisableVoltage, 0);
  recovery_.begin();
  sdo_.cancel(at_ns);
  sdo_.read(objects::kErrorCode, at_ns);
  enter(Step::ReadFault, kNever);
}

void MotorSession::tell_fault(const SdoResult& result, HostStamp at_ns) {
  std::string detail = "statusword " + hex_text(status_, 4);
  if (result.outcome == SdoResult::Outcome::Done) {
    const auto code = static_cast<std::uint16_t>(result.number());
    detail += ", error " + hex_text(code, 4) + " (" + describe_error_code(code) + ")";
  }
  if (emergency_) detail += ", last EMCY " + describe(*emergency_);
  report(MotorTrouble::Fault, std::move(detail), at_ns);
  wait_to_reset(at_ns);
}

void MotorSession::step_fault(HostStamp at_ns) {
  if (!is_fault(drive_state_) && step_ != Step::ReadFault) {
    command(controlword::kDisableVoltage, 0);
    acted_on_.reset();
    return enter(Step::Enable, at_ns + to_ns(options_.state_timeout_s));
  }
  // The reset is an edge: a statusword that came after the command without the bit proves that the drive has seen it.
  if (step_ == Step::ResetFault && command_.control == controlword::kDisableVoltage) {
    command(controlword::kFaultReset, 0);
  }
}

void MotorSession::wait_to_reset(HostStamp now_ns) { enter(Step::WaitReset, now_ns + kResetPause_ns); }

void MotorSession::try_reset(HostStamp now_ns) {
  step_deadline_ns_ = now_ns + kResetPause_ns;
  auto decision = recovery_.decide(status_, now_ns);
  if (decision.hurdle) report(MotorTrouble::StateTimeout, std::move(*decision.hurdle), now_ns);
  if (!decision.is_reset_due) return;
  command(controlword::kDisableVoltage, 0);
  enter(Step::ResetFault, now_ns + to_ns(options_.state_timeout_s));
}

void MotorSession::on_sdo_result(const SdoResult& result, HostStamp at_ns) {
  if (step_ == Step::Search) {
    if (result.outcome != SdoResult::Outcome::NoAnswer) begin_setup(at_ns);
  } else if (step_ == Step::Setup) {
    auto advance = setup_.on_result(sdo_, result, at_ns);
    if (advance.trouble) report(advance.trouble->trouble, std::move(advance.trouble->detail), at_ns);
    if (advance.progress == SetupSequence::Progress::Failed) back_off(at_ns);
    if (advance.progress != SetupSequence::Progress::Done) return;
    events_.emplace_back(setup_.drive());
    send(encode_nmt(NmtCommand::Start, node_));
    heartbeat_ns_ = at_ns;
    enter(Step::StartNode, at_ns + to_ns(options_.state_timeout_s));
  } else if (step_ == Step::ReadFault) {
    tell_fault(result, at_ns);
  } else if (step_ == Step::Stop) {
    if (stopping_.on_result(sdo_, result, at_ns)) end_stop();
  }
}

}  // namespace stairway::drivers
