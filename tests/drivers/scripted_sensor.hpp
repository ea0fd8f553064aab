// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/scip/scip_replies.hpp"
#include "drivers/types.hpp"
#include "tests/drivers/scip_samples.hpp"

namespace stairway::drivers {

/// A UTM-30LX reduced to what the session's tests need: answers on a 25 ms grid, streams constant scans, and misbehaves
/// as told. Time is the caller's.
class ScriptedSensor {
 public:
  static constexpr HostStamp kPeriod_ns = 25'000'000;
  static constexpr HostStamp kLatency_ns = 23'500'000;

  /// Overrides: gives the bytes to answer a command with (nullopt = the usual answer, "" = silence).
  std::function<std::optional<std::string>(const std::string& command)> override_reply;
  /// Changes or drops ("") the bytes of the scan with this number since the start of all streams.
  std::function<std::string(int number, std::string bytes)> override_scan;
  bool is_streaming = false;
  bool is_mute = false;
  std::uint32_t range_mm = 2000;
  std::vector<std::string> commands;
  int scans_sent = 0;

  void receive(const std::string& bytes, HostStamp now_ns) {
    for (const char c : bytes) {
      if (c != '\n') {
        line_.push_back(c);
      } else if (!line_.empty()) {
        on_command(line_, now_ns);
        line_.clear();
      }
    }
  }

  /// What has been sent by `now_ns`, one entry per message.
  std::vector<std::pair<HostStamp, std::string>> send(HostStamp now_ns) {
    std::vector<std::pair<HostStamp, std::string>> out;
    while (is_streaming && next_turn_ns_ + kLatency_ns <= now_ns) {
      const HostStamp at_ns = next_turn_ns_ + kLatency_ns;
      std::string bytes = scan_bytes();
      if (override_scan) bytes = override_scan(scans_sent, std::move(bytes));
      ++scans_sent;
      next_turn_ns_ += kPeriod_ns;
      if (!bytes.empty()) pending_.emplace(at_ns, bytes);
    }
    while (!pending_.empty() && pending_.begin()->first <= now_ns) {
      if (!is_mute) out.emplace_back(*pending_.begin());
      pending_.erase(pending_.begin());
    }
    return out;
  }

  void reset_clock(HostStamp now_ns) { clock_origin_ns_ = now_ns; }
  void add_message(HostStamp at_ns, const std::string& bytes) { pending_.emplace(at_ns, bytes); }
  std::string stream_command() const { return to_command(request_); }

 private:
  void on_command(const std::string& command, HostStamp now_ns) {
    commands.push_back(command);
    const HostStamp at_ns = (now_ns / kPeriod_ns + 1) * kPeriod_ns;
    if (override_reply) {
      if (const auto bytes = override_reply(command)) {
        if (!bytes->empty()) pending_.emplace(at_ns, *bytes);
        return;
      }
    }
    pending_.emplace(at_ns, answer(command, at_ns));
  }

  std::string answer(const std::string& command, HostStamp at_ns) {
    if (command == "VV") return samples::kVersion;
    if (command == "PP") return samples::kParameters;
    if (command == "II") return samples::kState;
    if (command == "RS") reset_clock(at_ns);
    if (command == "RS" || command == "QT") is_streaming = false;
    if (const auto request = parse_scan_request(*parse_command(command))) {
      request_ = *request;
      is_streaming = true;
      next_turn_ns_ = at_ns;
    }
    return encode_reply(command, "00");
  }

  std::string scan_bytes() const {
    RawScan scan;
    scan.stamp_ms = static_cast<std::uint32_t>((next_turn_ns_ - clock_origin_ns_) / 1'000'000) & 0xFFFFFF;
    scan.ranges_mm.assign(static_cast<std::size_t>(request_.max_values()), range_mm);
    if (request_.has_intensity()) scan.intensities.assign(scan.ranges_mm.size(), 1500);
    return encode_reply(to_command(request_), "99", encode_scan_data(scan, request_));
  }

  std::string line_;
  std::multimap<HostStamp, std::string> pending_;
  ScanRequest request_;
  HostStamp next_turn_ns_ = 0;
  HostStamp clock_origin_ns_ = 0;
};

}  // namespace stairway::drivers
