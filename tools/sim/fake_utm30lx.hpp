// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/ports/byte_port.hpp"
#include "drivers/scip/scip_commands.hpp"
#include "drivers/types.hpp"
#include "tools/sim/sensor_faults.hpp"

namespace stairway::sim {

/// How the simulated sensor's clock and line behave.
struct FakeUtm30lxOptions {
  drivers::HostStamp start_ns = 0;       ///< host time at which it was switched on and mirror turn 0 began [ns]
  std::int64_t counter_at_start_ms = 0;  ///< its millisecond counter then; 24 bits
  double clock_rate = 1.00005;           ///< seconds of its clock per second of the host
  double turn_period_s = 0.025;          ///< of the mirror, in host time
  double latency_s = 0.0235;             ///< least time from the rear-pointing beam to the first byte at the host
  double jitter_s = 0.001;               ///< added to it, evenly distributed from 0; at most a turn period
  std::uint64_t seed = 1;                ///< of the jitter
  bool answers_time_at_once = false;     ///< TM1 after a millisecond instead of at the next mirror turn
  std::string firmware = "1.18.01(09/Jul./2010)";
  std::string serial = "SIMULATED";

  /// First problem found; empty when usable.
  std::string problem() const;
};

/// A Hokuyo UTM-30LX as its USB cable shows it: SCIP 2.0 commands in, replies and scans out, each at its time. It has
/// no thread or clock; results depend on what is received and when.
///
/// It knows VV PP II BM QT RS RT TM0 TM1 TM2 MD MS ME GD GS, refuses CR and HS as the real one does, and answers 0E to
/// the rest. One command is answered per mirror turn. In time adjustment it answers 0E to all but TM and RS. Stamps are
/// the counter at the rear-pointing beam, floored to milliseconds. Intensities come from the distances. Asked for more
/// than 95 degrees of them in every turn, it is overloaded: scans come late, every other one is lost, and some are
/// broken.
class FakeUtm30lx {
 public:
  /// Fills in the ranges of the mirror turn `turn`, which began at `start_ns` and lasts a turn period: 1081 values in
  /// millimetres or error codes.
  using RangeSource =
      std::function<void(std::uint64_t turn, drivers::HostStamp start_ns, std::span<std::uint32_t> values)>;

  FakeUtm30lx(const FakeUtm30lxOptions& options, RangeSource measure);

  /// Takes what the host sent at `now_ns`. Lines longer than 100 characters are cut; of more than 16 waiting commands
  /// the newest are lost.
  void receive(std::string_view bytes, drivers::HostStamp now_ns);
  /// When it will have something to say; the greatest stamp when nothing is asked of it.
  drivers::HostStamp next_due_ns() const;
  /// What it has said up to `now_ns`, oldest message first, one message per call; empty when there is none. A host that
  /// is more than a second late loses scans.
  std::optional<drivers::ByteChunk> take(drivers::HostStamp now_ns);

  /// Makes something go wrong, from now on and so often. What ends a stream's fault is said at each; RS ends none.
  void inject(SensorFault fault, int count = 1);

  bool is_streaming() const { return stream_.has_value(); }

 private:
  struct PendingCommand {
    drivers::HostStamp received_ns;
    std::string line;
  };

  drivers::HostStamp turn_start_ns(std::uint64_t turn) const;
  drivers::HostStamp turn_due_ns(std::uint64_t turn) const;
  std::uint64_t next_turn() const;
  std::uint32_t counter_at(drivers::HostStamp stamp_ns) const;
  void run_turn();
  void answer(const std::string& line);
  std::string answer_time_command(std::string_view parameters, std::string& body);
  void answer_time_at_once(drivers::HostStamp now_ns);
  std::string start_scan(const drivers::Command& command, std::string& body);
  void send_scan();
  std::string scan_body(const drivers::ScanRequest& request);
  std::string stream_echo() const;
  std::string describe(std::string_view symbol);
  bool is_checking_itself();
  bool is_overloaded() const;
  void say(std::string bytes, drivers::HostStamp delay_ns = 0);
  void say_slowly(std::string message);
  void end_stream();
  void reset(bool is_clock_reset);
  void set_counter_to_zero();

  FakeUtm30lxOptions options_;
  RangeSource measure_;
  std::string line_;
  std::deque<PendingCommand> commands_;
  std::deque<drivers::ByteChunk> output_;

  std::uint64_t turn_ = 0;  // the next one that has not been dealt with
  drivers::HostStamp counter_start_ns_;
  std::int64_t counter_start_ms_;
  bool is_laser_on_ = false;
  bool is_adjusting_time_ = false;
  std::optional<drivers::ScanRequest> stream_;  // `scans` counts down
  std::string stream_tag_;
  int turns_to_skip_ = 0;

  SensorFaults faults_;
  bool is_stuck_ = false;
  bool is_short_ = false;
  int check_turns_ = 0;
  std::uint32_t last_stamp_ms_ = 0;
};

}  // namespace stairway::sim
