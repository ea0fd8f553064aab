// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/backoff.hpp"
#include "drivers/scip/scip_status.hpp"
#include "drivers/scip/unit_checks.hpp"

namespace stairway::drivers {
namespace {

constexpr int kProvenStream = 40;  // scans after which earlier failures are forgiven
constexpr std::size_t kMaxQuote = 32;
// One alone is a lost line. Time for the sensor to follow the command passes before the next attempt.
constexpr int kWrongLengthsToAskAgain = 4;
constexpr int kWrongLengthsToRestart = 12;

HostStamp to_ns(double seconds) { return std::llround(seconds * 1e9); }

bool is_unknown_command(std::string_view status) { return status_kind({}, status) == StatusKind::Unknown; }

}  // namespace

ScipSession::ScipSession(const ScipOptions& options) : options_(options), clock_(options) {}

std::vector<ScipEvent> ScipSession::on_bytes(std::string_view bytes, HostStamp arrival_ns) {
  if (step_ == Step::Start) enter(Step::Drain, arrival_ns);
  const bool is_deaf = step_ == Step::Drain || step_ == Step::DrainReset || step_ == Step::Backoff;
  if (!is_deaf) {
    framer_.add(bytes, arrival_ns, [&](const ScipBlock& block) { on_block(block, arrival_ns); });
    if (framer_.overflows() != overflows_) report(ScipTrouble::Overflow, "bytes without an end of message dropped");
    overflows_ = framer_.overflows();
  } else if (step_ != Step::Backoff && !bytes.empty()) {
    deadline_ns_ = std::min(arrival_ns + to_ns(options_.drain_silence_s), drain_end_ns_);
  }
  return on_time(arrival_ns);
}

std::vector<ScipEvent> ScipSession::on_time(HostStamp now_ns) {
  if (step_ == Step::Start) {
    enter(Step::Drain, now_ns);
  } else if (now_ns >= deadline_ns_) {
    on_deadline(now_ns);
  }
  return take_events();
}

std::vector<ScipEvent> ScipSession::on_disconnect(HostStamp now_ns, std::string_view detail) {
  report(ScipTrouble::Disconnected, std::string(detail));
  output_.clear();
  ++failures_;
  back_off(now_ns);
  return take_events();
}

std::vector<ScipEvent> ScipSession::on_lost_bytes(std::size_t bytes) {
  report(ScipTrouble::LostBytes, std::to_string(bytes) + " bytes were not read in time; is the machine overloaded?");
  return take_events();
}

void ScipSession::retry_now(HostStamp now_ns) {
  if (step_ == Step::Backoff) deadline_ns_ = std::min(deadline_ns_, now_ns);
}

std::string ScipSession::take_output() { return std::exchange(output_, {}); }

ScipState ScipSession::state() const {
  if (step_ == Step::Backoff) return ScipState::Backoff;
  if (step_ == Step::Stream) return ScipState::Streaming;
  return is_warming_up_ ? ScipState::WarmingUp : ScipState::Opening;
}

void ScipSession::enter(Step step, HostStamp now_ns) {
  const ScipState old_state = state();
  const bool is_first = step_ == Step::Start;
  step_ = step;
  is_warming_up_ = false;
  if (is_first || state() != old_state) events_.emplace_back(ScipStateEvent{state()});
  is_pausing_ = false;
  attempts_ = 0;
  if (step == Step::Drain) {
    is_intensity_refused_ = false;
    readings_.clear();
  }
  if (step == Step::Drain || step == Step::DrainReset) {
    framer_.clear();
    drain_end_ns_ = now_ns + to_ns(options_.max_drain_s);
    deadline_ns_ = now_ns + to_ns(options_.drain_silence_s);
  } else if (step != Step::Stream && step != Step::Backoff) {
    if (step == Step::StartStream) prepare_stream();
    command_ = command_for(step);
    send(now_ns);
  }
}

void ScipSession::advance(HostStamp now_ns) {
  const bool has_time_mode = options_.clock_source == TimeSource::TimeAdjustment;
  if (is_reattaching_ && step_ == Step::Quit) return enter(Step::StartStream, now_ns);
  if (step_ == Step::AskState && !has_time_mode) return enter(Step::LaserOn, now_ns);
  enter(static_cast<Step>(static_cast<int>(step_) + 1), now_ns);
}

std::string ScipSession::command_for(Step step) const {
  switch (step) {
    case Step::Quit:
      return "QT";
    case Step::LeaveTimeMode:
      return "TM2";
    case Step::Reset:
    case Step::ResetAgain:
      return "RS";
    case Step::AskVersion:
      return "VV";
    case Step::AskParameters:
      return "PP";
    case Step::AskState:
      return "II";
    case Step::EnterTimeMode:
      return "TM0";
    case Step::ReadTime:
      return "TM1";
    case Step::EndTimeMode:
      return "TM2";
    case Step::LaserOn:
      return "BM";
    case Step::StartStream:
      return to_command(request_);
    default:
      return {};
  }
}

void ScipSession::send(HostStamp now_ns) {
  ++attempts_;
  is_pausing_ = false;
  // An empty command ends whatever stands half-read at the sensor.
  if (step_ == Step::Quit) output_.push_back('\n');
  if (step_ == Step::ReadTime) readings_.ask(now_ns);
  output_.append(command_).push_back('\n');
  deadline_ns_ = now_ns + to_ns(options_.command_timeout_s);
}

void ScipSession::send_again(HostStamp now_ns) {
  const bool is_slow_to_come = step_ == Step::LaserOn || step_ == Step::EnterTimeMode;
  if (attempts_ < (is_slow_to_come ? options_.laser_attempts : options_.command_attempts)) {
    send(now_ns);
  } else if (step_ == Step::EnterTimeMode || step_ == Step::ReadTime) {
    give_up_time(now_ns);
  } else if (step_ == Step::LeaveTimeMode || step_ == Step::Reset || step_ == Step::EndTimeMode) {
    advance(now_ns);
  } else {
    ++failures_;
    back_off(now_ns);
  }
}

void ScipSession::on_deadline(HostStamp now_ns) {
  switch (step_) {
    case Step::Drain:
    case Step::DrainReset:
      return advance(now_ns);
    case Step::Backoff:
      return enter(Step::Drain, now_ns);
    case Step::Stream:
      report(ScipTrouble::Silence, "no scan for too long, restarting the stream");
      return restart_stream(now_ns);
    default:
      if (!is_pausing_) report(ScipTrouble::NoReply, command_ + " was not answered");
      // A late answer would pass for a quick one to the next question.
      if (step_ == Step::ReadTime) return give_up_time(now_ns);
      return send_again(now_ns);
  }
}

void ScipSession::on_block(const ScipBlock& block, HostStamp now_ns) {
  if (step_ == Step::Stream) return on_stream_block(block, now_ns);
  const bool is_deaf = step_ == Step::Drain || step_ == Step::DrainReset || step_ == Step::Backoff;
  // Scans of the stream that QT is to end, and late answers, are nobody's business here.
  if (is_deaf || is_pausing_) return;
  if (const auto reply = find_reply(block.text, command_)) on_reply(*reply, now_ns);
}

void ScipSession::on_reply(const ScipReply& reply, HostStamp now_ns) {
  switch (step_) {
    case Step::Quit:
    case Step::LeaveTimeMode:
    case Step::Reset:
      return advance(now_ns);
    case Step::EndTimeMode:
      return advance(now_ns);
    case Step::EnterTimeMode:
      return on_time_mode_reply(reply.status, now_ns);
    case Step::ReadTime:
      return on_time_reply(reply, now_ns);
    case Step::LaserOn:
      return on_laser_reply(reply.status, now_ns);
    case Step::StartStream:
      if (reply.status == "00" || reply.status == "99") return begin_stream(now_ns);
      if (!request_.has_intensity() || !is_unknown_command(reply.status)) break;
      report_refusal(reply.status);
      is_intensity_refused_ = true;
      return enter(Step::StartStream, now_ns);
    default:
      if (reply.status == "00") return on_setup_reply(reply, now_ns);
      if (!is_unknown_command(reply.status)) break;
      report_refusal(reply.status);
      if (step_ == Step::AskParameters) device_.parameters = {};
      if (step_ == Step::AskVersion) {
        device_.version = {};
        if (!is_wanted_unit(now_ns)) return;
      }
      return advance(now_ns);
  }
  report_refusal(reply.status);
  ++failures_;
  back_off(now_ns);
}

void ScipSession::on_setup_reply(const ScipReply& reply, HostStamp now_ns) {
  const auto take = [&](auto parsed, auto& field) {
    if (parsed) field = std::move(*parsed);
    if (!parsed) report(ScipTrouble::Corrupt, "reply to " + command_ + ": " + to_string(parsed.error()));
    return parsed.has_value();
  };
  bool is_taken = true;
  if (step_ == Step::AskVersion) is_taken = take(parse_version(reply.data), device_.version);
  if (step_ == Step::AskParameters) is_taken = take(parse_parameters(reply.data), device_.parameters);
  if (step_ == Step::AskState) is_taken = take(parse_state(reply.data), device_.state);
  if (!is_taken) return send_again(now_ns);
  if (step_ == Step::AskVersion && !is_wanted_unit(now_ns)) return;
  if (step_ == Step::AskParameters) check_model();

  if (step_ == Step::ResetAgain) {
    clock_.expect_reset();
  }
  const bool is_faulty = step_ == Step::AskState && !device_.state.is_healthy();
  if (step_ == Step::AskState) events_.emplace_back(device_);
  if (!is_faulty) return advance(now_ns);
  report(ScipTrouble::SensorFault, "the sensor says \"" + device_.state.status + "\"; switch its power off and on");
  ++failures_;
  back_off(now_ns);
}

bool ScipSession::is_wanted_unit(HostStamp now_ns) {
  const VersionInfo& unit = device_.version;
  if (!options_.serial.empty() && !is_same_serial(unit.serial, options_.serial)) {
    const std::string told = unit.serial.empty() ? "not told" : unit.serial.substr(0, kMaxQuote);
    report(ScipTrouble::WrongUnit,
           "its serial number is " + told + ", wanted is " + options_.serial.substr(0, kMaxQuote));
    ++failures_;
    back_off(now_ns, true);
    return false;
  }
  if (const std::string warning = firmware_warning(unit.firmware); !warning.empty()) {
    report(ScipTrouble::OldFirmware, warning);
  }
  return true;
}

void ScipSession::check_model() {
  const std::string& model = device_.parameters.model;
  if (model.find("UTM-30LX") != std::string::npos) return;
  report(ScipTrouble::WrongUnit, "it is a " + model.substr(0, kMaxQuote) +
                                     ", no UTM-30LX; if there are several scanners, name one in lidar.usb_serial or "
                                     "lidar.usb_port");
}

void ScipSession::on_time_mode_reply(std::string_view status, HostStamp now_ns) {
  if (status == "00" || status == "02") return enter(Step::ReadTime, now_ns);
  if (!is_unknown_command(status)) return wait_for_laser(status, now_ns);
  report_refusal(status);
  give_up_time(now_ns);
}

void ScipSession::on_time_reply(const ScipReply& reply, HostStamp now_ns) {
  const auto device_ms = parse_time(reply.data);
  if (reply.status != "00" || !device_ms) {
    report(ScipTrouble::Corrupt, "reply to TM1: status " + describe_status(command_, reply.status));
    return send_again(now_ns);
  }
  readings_.answer(clock_.unwrap(*device_ms), now_ns);
  if (readings_.count() < options_.time_readings) return enter(Step::ReadTime, now_ns);
  if (readings_.best()->round_trip_ns > to_ns(options_.max_round_trip_s)) return give_up_time(now_ns);
  clock_.use(*readings_.best());
  enter(Step::EndTimeMode, now_ns);
}

void ScipSession::give_up_time(HostStamp now_ns) {
  std::string detail = "the sensor does not tell its time";
  if (const auto& best = readings_.best()) {
    detail = "TM1 took " + std::to_string(best->round_trip_ns / 1'000'000) + " ms at the least";
  }
  report(ScipTrouble::TimeUnknown, detail + "; its clock is mapped by arrivals and min_latency");
  enter(Step::EndTimeMode, now_ns);
}

void ScipSession::on_laser_reply(std::string_view status, HostStamp now_ns) {
  if (status == "00" || status == "02") return advance(now_ns);
  if (status == "01") {
    report(ScipTrouble::SensorFault, "the laser does not work; switch the sensor's power off and on");
    ++failures_;
    return back_off(now_ns);
  }
  if (!is_unknown_command(status)) return wait_for_laser(status, now_ns);
  report_refusal(status);
  // MD switches the laser on by itself.
  advance(now_ns);
}

void ScipSession::wait_for_laser(std::string_view status, HostStamp now_ns) {
  // For some seconds after power-up that is no fault.
  if (attempts_ >= options_.laser_attempts) report_refusal(status);
  if (!std::exchange(is_warming_up_, true)) events_.emplace_back(ScipStateEvent{state()});
  is_pausing_ = true;
  deadline_ns_ = now_ns + to_ns(options_.laser_retry_s);
}

void ScipSession::prepare_stream() {
  request_ = make_request(options_, device_.parameters);
  if (is_intensity_refused_) request_.symbol = "MD";
}

void ScipSession::begin_stream(HostStamp now_ns) {
  good_scans_ = 0;
  wrong_lengths_ = 0;
  is_self_checking_ = false;
  clock_.begin_stream(device_.parameters);
  enter(Step::Stream, now_ns);
  // The mirror may still be getting up to speed.
  deadline_ns_ = now_ns + std::max(watchdog_ns(), to_ns(options_.command_timeout_s));
}

void ScipSession::on_stream_block(const ScipBlock& block, HostStamp now_ns) {
  auto reply = parse_reply(block.text);
  bool is_first_in_block = true;
  if (!reply || reply->echo != command_) {
    if (reply) report(ScipTrouble::Unexpected, "reply to " + std::string(reply->echo.substr(0, kMaxQuote)));
    if (!reply) report(ScipTrouble::Corrupt, std::string("message: ") + to_string(reply.error()));
    reply = find_reply(block.text, command_);
    is_first_in_block = false;
  }
  if (!reply) return;
  if (reply->status != "99") return on_stream_status(reply->status, now_ns);

  auto decoded = decode_scan(reply->data, request_, raw_);
  if (!decoded) {
    report(ScipTrouble::Corrupt, std::string("scan: ") + to_string(decoded.error()));
    if (decoded.error() == ScipError::WrongCount) on_wrong_length(now_ns);
    if (step_ != Step::Stream) return;
    const auto later_reply = find_reply(reply->data, command_);
    if (!later_reply || later_reply->status != "99") return;
    decoded = decode_scan(later_reply->data, request_, raw_);
    is_first_in_block = false;
  }
  if (decoded) accept_scan(block.arrival_ns, block.is_arrival_exact && is_first_in_block, now_ns);
}

void ScipSession::on_stream_status(std::string_view status, HostStamp now_ns) {
  const std::string detail = "status " + describe_status(command_, status) + " in the stream";
  switch (status_kind(command_, status)) {
    case StatusKind::Ok:
      return;
    case StatusKind::SelfCheck:
      report(ScipTrouble::SelfCheck, detail + ", waiting");
      if (!std::exchange(is_self_checking_, true)) deadline_ns_ = now_ns + to_ns(options_.self_check_s);
      return;
    case StatusKind::Resumed:
      is_self_checking_ = false;
      deadline_ns_ = now_ns + watchdog_ns();
      return;
    case StatusKind::Fault:
      report(ScipTrouble::SensorFault, detail + ", restarting it");
      return restart_stream(now_ns);
    default:
      report(ScipTrouble::Refused, detail + ", restarting it");
      return restart_stream(now_ns);
  }
}

void ScipSession::on_wrong_length(HostStamp now_ns) {
  if (++wrong_lengths_ % kWrongLengthsToAskAgain != 0) return;
  if (wrong_lengths_ >= kWrongLengthsToRestart) return restart_stream(now_ns);
  // The same command once more replaces the stream without a pause.
  output_.append(command_).push_back('\n');
}

void ScipSession::accept_scan(HostStamp arrival_ns, bool is_arrival_exact, HostStamp now_ns) {
  LaserScan scan = clock_.to_scan(raw_, request_, device_.parameters, arrival_ns, is_arrival_exact);
  for (ScipTroubleEvent& trouble : clock_.take_troubles()) report(trouble.trouble, std::move(trouble.detail));
  events_.emplace_back(std::move(scan));
  ++counters_.scans;
  is_self_checking_ = false;
  wrong_lengths_ = 0;
  if (++good_scans_ >= kProvenStream) failures_ = 0;
  deadline_ns_ = now_ns + watchdog_ns();
}

void ScipSession::restart_stream(HostStamp now_ns) {
  if (++failures_ >= options_.restarts_before_reopen) return back_off(now_ns);
  is_reattaching_ = true;
  enter(Step::Quit, now_ns);
}

void ScipSession::back_off(HostStamp now_ns, bool wants_other_port) {
  is_reattaching_ = false;
  if (wants_other_port || failures_ >= options_.restarts_before_reopen) events_.emplace_back(ScipReopenEvent{});
  enter(Step::Backoff, now_ns);
  deadline_ns_ = now_ns + backoff_ns(failures_, options_.min_backoff_s, options_.max_backoff_s);
}

void ScipSession::report(ScipTrouble trouble, std::string detail) {
  ++counters_.troubles[static_cast<std::size_t>(trouble)];
  events_.emplace_back(ScipTroubleEvent{trouble, std::move(detail)});
}

void ScipSession::report_refusal(std::string_view status) {
  report(ScipTrouble::Refused, command_ + " was answered with status " + describe_status(command_, status));
}

HostStamp ScipSession::watchdog_ns() const {
  return std::llround(3.0 * device_.parameters.scan_period_ns(options_.skip_scan)) + to_ns(options_.watchdog_margin_s);
}

std::vector<ScipEvent> ScipSession::take_events() { return std::exchange(events_, {}); }

}  // namespace stairway::drivers
