// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"
#include "tools/recording/measurement_stream.hpp"
#include "tools/stairwayd/bus_listener.hpp"
#include "tools/stairwayd/measurement_source.hpp"
#include "tools/stairwayd/newest_queue.hpp"

namespace stairway::daemon {

/// The scans and disk angles that another process sends: another stairwayd, `stairway replay`, lcm-logplayer, or any
/// program that sends scan_t with the disk angles at the ends of every scan.
///
/// Messages wait in a queue of some seconds; when it is full, the oldest is dropped and counted. A sender that is
/// silent for two seconds is a failed scanner or encoder until it is heard again.
class LcmSource final : public MeasurementSource {
 public:
  /// Begins to listen.
  explicit LcmSource(const ipc::BusOptions& bus);

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override;
  std::string order(const DiskOrder&) override {
    return "this daemon listens to another process, which has the disk: the command is for that one";
  }
  void stop() override { listener_.reset(); }
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override { return stream_.utime_us(stamp_ns); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Message {
    std::string channel;
    ipc::Bytes bytes;
  };
  // What is known of one of the two channels.
  struct Line {
    Device device;
    std::string channel;
    std::optional<Clock::time_point> last{};
    std::optional<Condition> told{};
  };

  void take(const Message& message, std::vector<SourceEvent>& events);
  void watch(Line& line, Clock::time_point now, std::vector<SourceEvent>& events);
  void tell(Line& line, Condition condition, std::string text, std::vector<SourceEvent>& events);
  void report_damage(std::vector<SourceEvent>& events);

  const std::string url_;
  tools::MeasurementStream stream_;
  std::array<Line, 2> lines_;
  std::uint64_t told_undecodable_ = 0;
  std::uint64_t told_restarts_ = 0;
  NewestQueue<Message> messages_;
  std::atomic<std::uint64_t> dropped_ = 0;
  std::optional<BusListener> listener_;
};

}  // namespace stairway::daemon
