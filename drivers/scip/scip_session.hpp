// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/scip/scan_clock.hpp"
#include "drivers/scip/scip_events.hpp"
#include "drivers/scip/scip_framer.hpp"
#include "drivers/scip/scip_options.hpp"
#include "drivers/scip/time_reading.hpp"

namespace stairway::drivers {

/// Opens a UTM-30LX that may be in any state, keeps it streaming, and turns its bytes into scans. Bytes and times in,
/// events and commands out; it has no port, thread or clock.
///
/// Opening: drain, QT, TM2, RS, drain, RS, VV, PP, II, if wanted TM0, TM1 several times, TM2, then BM, MD. A silent
/// stream is first restarted with QT and MD; after `restarts_before_reopen` failures in a row the session asks for
/// another port and opens from the start, with a pause that doubles up to `max_backoff_s`, without end. A corrupt scan
/// costs that scan only; when scans of a wrong length do not end, MD is sent again. Status queries are never sent into
/// a stream. Commands that a sensor does not know (0D, 0E) are reported and done without; without PP a UTM-30LX's
/// figures are used, and where ME is not known, ranges are asked for without intensities until the next opening.
///
/// Call `on_bytes` or `on_time` at least once per `deadline()`, with times that do not go back, and send what
/// `take_output` gives. The first call begins.
class ScipSession {
 public:
  /// @pre  options.problem() is empty.
  explicit ScipSession(const ScipOptions& options);

  /// Takes bytes that arrived together. Events come in the order in which they happened.
  std::vector<ScipEvent> on_bytes(std::string_view bytes, HostStamp arrival_ns);
  /// Lets time pass: silence limits, repetitions, pauses.
  std::vector<ScipEvent> on_time(HostStamp now_ns);
  /// The port failed, or could not be opened: waits, then opens from the start.
  std::vector<ScipEvent> on_disconnect(HostStamp now_ns, std::string_view detail);
  /// So many bytes were dropped on their way before the next ones; a scan with a hole is refused by its sums.
  std::vector<ScipEvent> on_lost_bytes(std::size_t bytes);
  /// A pulse of the sensor's synchronous output began [ns]; to be told before the scan of the same turn.
  void on_sync_pulse(HostStamp stamp_ns) { clock_.add_pulse(stamp_ns); }
  /// Cuts the pause short that precedes the next attempt to open, e.g. because the sensor was plugged in.
  void retry_now(HostStamp now_ns);

  /// Commands to send; empty when none.
  std::string take_output();
  /// When something is due if no bytes come [ns].
  HostStamp deadline() const { return deadline_ns_; }
  /// Stops the stream and the laser, from any state; closing a port does not.
  static std::string stop_command() { return "\nQT\n"; }

  ScipState state() const;
  const ScipCounters& counters() const { return counters_; }
  ClockQuality clock_quality() const { return clock_.quality(); }
  const ScipDeviceInfo& device() const { return device_; }

 private:
  // In the order of opening.
  enum class Step {
    Start,
    Drain,
    Quit,
    LeaveTimeMode,
    Reset,
    DrainReset,
    ResetAgain,
    AskVersion,
    AskParameters,
    AskState,
    EnterTimeMode,
    ReadTime,
    EndTimeMode,
    LaserOn,
    StartStream,
    Stream,
    Backoff,
  };

  void enter(Step step, HostStamp now_ns);
  void advance(HostStamp now_ns);
  void send(HostStamp now_ns);
  void send_again(HostStamp now_ns);
  void on_deadline(HostStamp now_ns);

  void on_block(const ScipBlock& block, HostStamp now_ns);
  void on_reply(const ScipReply& reply, HostStamp now_ns);
  void on_setup_reply(const ScipReply& reply, HostStamp now_ns);
  bool is_wanted_unit(HostStamp now_ns);
  void check_model();
  void on_time_mode_reply(std::string_view status, HostStamp now_ns);
  void on_time_reply(const ScipReply& reply, HostStamp now_ns);
  void give_up_time(HostStamp now_ns);
  void on_laser_reply(std::string_view status, HostStamp now_ns);
  void wait_for_laser(std::string_view status, HostStamp now_ns);
  void on_stream_block(const ScipBlock& block, HostStamp now_ns);
  void on_stream_status(std::string_view status, HostStamp now_ns);
  void on_wrong_length(HostStamp now_ns);
  void accept_scan(HostStamp arrival_ns, bool is_arrival_exact, HostStamp now_ns);

  void prepare_stream();
  void begin_stream(HostStamp now_ns);
  void restart_stream(HostStamp now_ns);
  void back_off(HostStamp now_ns, bool wants_other_port = false);
  void report(ScipTrouble trouble, std::string detail);
  void report_refusal(std::string_view status);
  std::string command_for(Step step) const;
  HostStamp watchdog_ns() const;
  std::vector<ScipEvent> take_events();

  ScipOptions options_;
  ScipFramer framer_;
  ScanClock clock_;
  TimeReadings readings_;
  ScipDeviceInfo device_;
  ScanRequest request_;
  RawScan raw_;

  Step step_ = Step::Start;
  HostStamp deadline_ns_ = std::numeric_limits<HostStamp>::min();
  HostStamp drain_end_ns_ = 0;
  std::string command_;
  int attempts_ = 0;
  bool is_pausing_ = false;            // before BM is sent again
  bool is_warming_up_ = false;         // the command of this step was denied, as after power-up
  bool is_reattaching_ = false;        // the sensor was set up before: only its stream is started again
  bool is_intensity_refused_ = false;  // by this sensor, until it is opened again
  bool is_self_checking_ = false;      // inside the stream, since a scan came last
  int failures_ = 0;                   // in a row
  int wrong_lengths_ = 0;              // in a row
  int good_scans_ = 0;                 // of this stream

  ScipCounters counters_;
  std::size_t overflows_ = 0;
  std::string output_;
  std::vector<ScipEvent> events_;
};

}  // namespace stairway::drivers
