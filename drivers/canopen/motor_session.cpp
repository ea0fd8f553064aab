// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/canopen/motor_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/backoff.hpp"
#include "drivers/canopen/little_endian.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kNever = std::numeric_limits<HostStamp>::max();
constexpr HostStamp kLongAgo = std::numeric_limits<HostStamp>::min() / 2;
constexpr HostStamp kCommandRepeat_ns = 100'000'000;
constexpr HostStamp kTellPause_ns = 1'000'000'000;  // between two tellings of one kind that others cause at will
constexpr HostStamp kLeastSilence_ns = 250'000'000;
constexpr double kHeartbeatsLost = 2.5;
constexpr HostStamp kSyncsLost = 5;
constexpr std::size_t kMaxOutput = 32;

HostStamp to_ns(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

MotorSession::MotorSession(const MotorOptions& options)
    : options_(options),
      units_(options),
      node_(static_cast<std::uint8_t>(options.node_id)),
      sdo_(node_, to_ns(options.sdo_timeout_s)),
      setup_(options),
      stopping_(options),
      recovery_(options),
      assembler_(options) {}

std::vector<MotorEvent> MotorSession::on_arrivals(std::span<const CanArrival> arrivals, HostStamp now_ns) {
  if (step_ == Step::Start && request_ == Request::None) begin_search(now_ns);
  for (const CanArrival& arrival : arrivals) {
    now_ns_ = std::clamp(arrival.arrival_ns, std::min(now_ns_, now_ns), now_ns);
    if (const auto* frame = std::get_if<CanFrame>(&arrival.what)) on_frame(*frame, now_ns_);
    if (const auto* condition = std::get_if<CanCondition>(&arrival.what)) on_condition(*condition, now_ns_);
    advance_transfers(now_ns_);
  }
  now_ns_ = now_ns;
  obey_request(now_ns);
  sdo_.on_time(now_ns);
  advance_transfers(now_ns);
  watch_drive(now_ns);
  watch_step(now_ns);
  send_cyclic(now_ns);
  for (const CanFrame& frame : sdo_.take_output()) send(frame);
  return take_events();
}

std::vector<MotorEvent> MotorSession::on_disconnect(HostStamp now_ns, std::string_view detail) {
  report(MotorTrouble::Disconnected, std::string(detail), now_ns);
  const bool is_stop_wanted = request_ == Request::Stop || request_ == Request::QuickStop;
  if (is_stop_wanted && step_ != Step::Stopped) begin_stop(false, now_ns);
  if (request_ != Request::Start) request_ = Request::None;
  if (step_ == Step::Stop) {
    end_stop();
  } else if (step_ != Step::Stopped) {
    back_off(now_ns);
  }
  is_muted_ = false;
  host_heartbeat_due_ns_ = kNever;
  sdo_.cancel(now_ns);
  static_cast<void>(sdo_.take_output());
  output_.clear();
  return take_events();
}

std::vector<MotorEvent> MotorSession::on_unsent(HostStamp now_ns) {
  output_.clear();
  if (!is_unsent_told_) {
    report(
        MotorTrouble::Bus,
        "frames cannot be sent on " + options_.interface + ": is the bus wired, terminated and at the right bit rate?",
        now_ns);
  }
  is_unsent_told_ = true;
  if (step_ == Step::Stop) end_stop();
  return take_events();
}

void MotorSession::retry_now(HostStamp now_ns) {
  if (step_ == Step::Backoff) step_deadline_ns_ = std::min(step_deadline_ns_, now_ns);
}

std::vector<CanFrame> MotorSession::take_output() {
  if (is_muted_) output_.clear();
  return std::exchange(output_, {});
}

HostStamp MotorSession::deadline() const {
  const bool is_waiting_to_start = request_ == Request::Start && step_ == Step::Stop;
  if ((request_ != Request::None && !is_waiting_to_start) || step_ == Step::Start) return now_ns_;
  if (step_ == Step::Stopped) return kNever;
  HostStamp due_ns = std::min({step_deadline_ns_, host_heartbeat_due_ns_, sdo_.deadline()});
  if (step_ == Step::Search) due_ns = std::min(due_ns, std::max(probe_ns_, now_ns_ + 1));
  if (step_ == Step::Setup) due_ns = std::min(due_ns, setup_.deadline());
  if (step_ == Step::Stop) due_ns = std::min(due_ns, stopping_.deadline());
  if (step_ == Step::Run) due_ns = std::min(due_ns, reach_deadline_ns_);
  if (is_watched()) due_ns = std::min(due_ns, heartbeat_ns_ + to_ns(kHeartbeatsLost * options_.heartbeat_s));
  if (is_operational()) due_ns = std::min({due_ns, sync_due_ns_, is_command_new_ ? now_ns_ : command_due_ns_});
  return due_ns;
}

void MotorSession::set_speed(double speed_rad_s) { wanted_rad_s_ = std::isnan(speed_rad_s) ? 0.0 : speed_rad_s; }

void MotorSession::stop() { request_ = Request::Stop; }

void MotorSession::quick_stop() { request_ = Request::QuickStop; }

void MotorSession::start() { request_ = Request::Start; }

MotorState MotorSession::state() const {
  switch (step_) {
    case Step::Start:
    case Step::Search:
      return MotorState::Searching;
    case Step::Setup:
    case Step::StartNode:
      return MotorState::Configuring;
    case Step::Enable:
      return MotorState::Enabling;
    case Step::Run:
      return MotorState::Running;
    case Step::ReadFault:
    case Step::WaitReset:
    case Step::ResetFault:
      return MotorState::Faulted;
    case Step::Backoff:
      return MotorState::Backoff;
    case Step::Stop:
      return MotorState::Stopping;
    case Step::Stopped:
      return MotorState::Stopped;
  }
  return MotorState::Searching;
}

void MotorSession::enter(Step step, HostStamp deadline_ns) {
  const MotorState old_state = state();
  const bool is_first = step_ == Step::Start;
  step_ = step;
  step_deadline_ns_ = deadline_ns;
  if (is_first || state() != old_state) events_.emplace_back(MotorStateEvent{state()});
}

void MotorSession::begin_search(HostStamp now_ns) {
  const HostStamp timeout_ns = to_ns(options_.boot_timeout_s);
  sdo_.cancel(now_ns);
  assembler_.pause();
  host_heartbeat_due_ns_ = std::min(host_heartbeat_due_ns_, now_ns);
  probe_ns_ = now_ns;
  if (options_.reset_on_start) {
    send(encode_nmt(NmtCommand::ResetCommunication, node_));
    probe_ns_ += timeout_ns / 2;
  }
  enter(Step::Search, now_ns + timeout_ns);
}

void MotorSession::begin_setup(HostStamp now_ns) {
  sdo_.cancel(now_ns);
  emergency_.reset();
  send(encode_nmt(NmtCommand::EnterPreOperational, node_));
  setup_.begin(sdo_, now_ns);
  enter(Step::Setup, kNever);
}

void MotorSession::begin_stop(bool is_quick, HostStamp now_ns) {
  // At once; the objects follow.
  if (is_operational()) {
    command(is_quick ? controlword::kQuickStop : command_.control, 0);
    send_command(now_ns);
  }
  sdo_.cancel(now_ns);
  stopping_.begin(sdo_, is_quick, now_ns);
  enter(Step::Stop, kNever);
  if (is_muted_) end_stop();
}

void MotorSession::end_stop() {
  host_heartbeat_due_ns_ = kNever;
  sdo_.cancel(now_ns_);
  if (!stopping_.is_off()) {
    report(MotorTrouble::StateTimeout,
           "the drive did not say that it is off; without this host's heartbeat it brakes by itself", now_ns_);
  } else if (!stopping_.is_standing()) {
    report(MotorTrouble::StateTimeout, "the drive is off, but did not say that the disk stands: it may still run out",
           now_ns_);
  }
  send(encode_nmt(NmtCommand::EnterPreOperational, node_));
  enter(Step::Stopped, kNever);
}

void MotorSession::back_off(HostStamp now_ns) {
  if (is_operational()) {
    command(controlword::kDisableVoltage, 0);
    send_command(now_ns);
    send(encode_nmt(NmtCommand::EnterPreOperational, node_));
  }
  sdo_.cancel(now_ns);
  ++failures_;
  enter(Step::Backoff, now_ns + backoff_ns(failures_, options_.min_backoff_s, options_.max_backoff_s));
}

void MotorSession::fail(MotorTrouble trouble, std::string detail, HostStamp now_ns) {
  report(trouble, std::move(detail), now_ns);
  back_off(now_ns);
}

void MotorSession::advance_transfers(HostStamp now_ns) {
  while (const auto result = sdo_.take_result()) on_sdo_result(*result, now_ns);
}

void MotorSession::obey_request(HostStamp now_ns) {
  if (request_ == Request::Start && step_ == Step::Stop) return;  // when the stop has ended
  const Request request = std::exchange(request_, Request::None);
  if (request == Request::Start) {
    if (step_ == Step::Stopped) begin_search(now_ns);
  } else if (request != Request::None && step_ != Step::Stopped) {
    const bool is_quick = request == Request::QuickStop;
    if (step_ != Step::Stop || is_quick) begin_stop(is_quick, now_ns);
  }
}

void MotorSession::watch_drive(HostStamp now_ns) {
  if (is_watched() && now_ns >= heartbeat_ns_ + to_ns(kHeartbeatsLost * options_.heartbeat_s)) {
    report(MotorTrouble::HeartbeatLost,
           "no heartbeat from node " + std::to_string(options_.node_id) + " for 2.5 periods", now_ns);
    return begin_search(now_ns);
  }
  const HostStamp silence_ns = std::max(kLeastSilence_ns, kSyncsLost * to_ns(1.0 / options_.sync_rate_hz));
  if (is_operational() && now_ns >= status_ns_ + silence_ns) {
    fail(MotorTrouble::HeartbeatLost,
         "the drive sends its heartbeat, but no whole statusword (TPDO 1) after a SYNC: is its mapping as it was set?",
         now_ns);
  }
}

void MotorSession::watch_step(HostStamp now_ns) {
  if (step_ == Step::Setup) setup_.on_time(sdo_, now_ns);
  if (step_ == Step::Stop) stopping_.on_time(sdo_, now_ns);
  if (step_ == Step::Search && now_ns >= probe_ns_) {
    probe_ns_ = kNever;
    send(encode_nmt(NmtCommand::EnterPreOperational, node_));
    if (!sdo_.is_busy()) sdo_.read(objects::kDeviceType, now_ns);
  }
  if (step_ == Step::Run && now_ns >= reach_deadline_ns_) {
    reach_deadline_ns_ = kNever;
    report(MotorTrouble::NotReached,
           "wanted " + std::to_string(wanted_rad_s_) + " rad/s, the drive tells " + std::to_string(speed_rad_s_) +
               ": is the disk blocked, or are the ramps too slow?",
           now_ns);
  }
  if (now_ns < step_deadline_ns_) return;
  switch (step_) {
    case Step::Search:
      if (!is_muted_) tell_missing_drive(now_ns);
      return begin_search(now_ns);
    case Step::StartNode:
      return fail(MotorTrouble::StateTimeout, "the drive does not become operational", now_ns);
    case Step::Enable: {
      std::string detail = "the drive stays in \"" + std::string(to_string(drive_state_)) + "\" (statusword " +
                           hex_text(status_, 4) + ")";
      if ((status_ & statusword::kVoltage) == 0) detail += ": safe torque off, or no motor voltage";
      if ((status_ & statusword::kRemote) == 0) detail += ": not under remote control";
      return fail(MotorTrouble::StateTimeout, std::move(detail), now_ns);
    }
    case Step::WaitReset:
      return try_reset(now_ns);
    case Step::ResetFault:
      report(MotorTrouble::StateTimeout, "the fault does not clear: its cause is still there", now_ns);
      return wait_to_reset(now_ns);
    case Step::Backoff:
      return begin_search(now_ns);
    default:
      return;
  }
}

void MotorSession::tell_missing_drive(HostStamp now_ns) {
  const std::string place = std::to_string(options_.node_id) + " on " + options_.interface;
  if (heartbeat_ns_ >= step_deadline_ns_ - to_ns(options_.boot_timeout_s)) {
    report(MotorTrouble::SdoTimeout,
           "node " + place +
               " sends its heartbeat, but answers no request (SDO): is it another kind of device, or in its loader?",
           now_ns);
  } else {
    report(MotorTrouble::HeartbeatLost,
           "no drive answers as node " + place + ": is it powered and wired, are its node number and bit rate right?",
           now_ns);
  }
}

void MotorSession::send_cyclic(HostStamp now_ns) {
  if (now_ns >= host_heartbeat_due_ns_) {
    send(encode_heartbeat(static_cast<std::uint8_t>(options_.host_node_id), NmtState::Operational));
    host_heartbeat_due_ns_ = now_ns + to_ns(options_.host_heartbeat_s / 3.0);
  }
  if (!is_operational()) return;
  follow_wanted(now_ns);
  if (is_command_new_ || now_ns >= command_due_ns_) send_command(now_ns);
  if (now_ns < sync_due_ns_) return;
  send(encode_sync());
  assembler_.on_sync(now_ns);
  const HostStamp period_ns = to_ns(1.0 / options_.sync_rate_hz);
  sync_due_ns_ += period_ns;
  if (sync_due_ns_ <= now_ns) sync_due_ns_ = now_ns + period_ns;
}

void MotorSession::follow_wanted(HostStamp now_ns) {
  if (step_ != Step::Run) return;
  const std::int32_t target = units_.velocity_units(wanted_rad_s_);
  if (target == command_.target) return;
  const double change_rad_s = std::abs(units_.speed_rad_s(target) - speed_rad_s_);
  const double ramp_s = change_rad_s / std::min(options_.acceleration_rad_s2, options_.deceleration_rad_s2);
  target_ns_ = now_ns;
  reach_deadline_ns_ = now_ns + to_ns(ramp_s + options_.reach_timeout_s);
  command(controlword::kEnable, target);
}

void MotorSession::command(std::uint16_t control, std::int32_t target) {
  command_ = {control, target};
  is_command_new_ = true;
}

void MotorSession::send_command(HostStamp now_ns) {
  send(encode_command(node_, command_));
  is_command_new_ = false;
  command_due_ns_ = now_ns + kCommandRepeat_ns;
}

void MotorSession::send(const CanFrame& frame) {
  if (output_.size() < kMaxOutput) {
    output_.push_back(frame);
  } else {
    ++counters_.dropped_frames;
  }
}

void MotorSession::report(MotorTrouble trouble, std::string detail, HostStamp at_ns) {
  ++counters_.troubles[static_cast<std::size_t>(trouble)];
  const bool is_anybodys = trouble == MotorTrouble::Unexpected || trouble == MotorTrouble::Bus;
  if (is_anybodys) {
    // What is unexpected has any number of texts, what happens to the bus has a few.
    auto& told_ns = told_ns_.try_emplace(trouble == MotorTrouble::Bus ? detail : std::string(), kLongAgo).first->second;
    if (at_ns < told_ns + kTellPause_ns) return;
    told_ns = at_ns;
  }
  events_.emplace_back(MotorTroubleEvent{trouble, std::move(detail)});
}

std::vector<MotorEvent> MotorSession::take_events() { return std::exchange(events_, {}); }

}  // namespace stairway::drivers
