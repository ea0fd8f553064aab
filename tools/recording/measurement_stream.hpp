// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/types.hpp"
#include "ipc/channels.hpp"
#include "ipc/messages.hpp"
#include "tools/recording/measurement_order.hpp"

namespace stairway::tools {

/// Turns the messages of STAIRWAY_SCAN and STAIRWAY_ANGLES back into the measurements of the daemon that sent them, in
/// the order in which it took them.
///
/// Stamps go on when the sender begins anew, be it a restarted computer or a recording that is played again: they are
/// shifted behind the newest. A sender of scans alone is served with the disk angles at the two ends of every scan.
class MeasurementStream {
 public:
  /// @param has_angles  whether STAIRWAY_ANGLES is sent; empty when that is to be found out, which costs the scans that
  ///   come before the first angles, at most ten.
  MeasurementStream(ipc::Channels channels, std::optional<bool> has_angles)
      : channels_(std::move(channels)), has_angles_(has_angles) {}

  /// A message as it was sent; those of other channels are left out, and damaged ones counted.
  void take(std::string_view channel, std::span<const std::uint8_t> bytes);
  /// No more messages come.
  void end() { order_.end(); }

  /// The next measurement; empty when another message must come first.
  std::optional<Measurement> next() { return order_.next(); }

  /// The instant of a stamp by the clocks of the newest scan that was taken; by those of the first angles before one.
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const { return offset_us_.value_or(0) + stamp_ns / 1000; }

  std::uint64_t undecodable_messages() const { return undecodable_; }
  std::uint64_t restarts() const { return restarts_; }  ///< times that the sender began anew

 private:
  void take(ipc::ScanMessage message);
  void take(ipc::AnglesMessage message);
  void follow(drivers::HostStamp stamp_ns, std::optional<drivers::HostStamp>& newest_ns);

  ipc::Channels channels_;
  std::optional<bool> has_angles_;
  int scans_without_angles_ = 0;
  MeasurementOrder order_;
  drivers::HostStamp shift_ns_ = 0;  // from the sender's stamps to ours
  std::optional<drivers::HostStamp> newest_scan_ns_, newest_angle_ns_;
  std::optional<std::int64_t> offset_us_;
  std::uint64_t undecodable_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace stairway::tools
