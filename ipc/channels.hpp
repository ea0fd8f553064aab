// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace stairway::ipc {

/// Where messages go and what their channels are called.
struct BusOptions {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";  ///< LCM provider; ttl=0 keeps messages on this host
  std::string channel_prefix = "STAIRWAY_";             ///< in front of every channel name; tells several robots apart
  bool scans = true;                                    ///< send scans and disk angles; recordings hold them anyway
  bool raw = false;                                     ///< send the scanner's bytes

  /// First problem found, worded for the person who set it; empty when usable.
  std::string problem() const;
};

/// What the names of the channels that a recording is played from end in.
inline constexpr std::string_view kScanChannelName = "SCAN", kAnglesChannelName = "ANGLES",
                                  kSettingsChannelName = "SETTINGS";

/// The names of the channels; the type of each is in ipc/types.
struct Channels {
  explicit Channels(const std::string& prefix = BusOptions{}.channel_prefix)
      : scan(prefix + std::string(kScanChannelName)),
        disk(prefix + "DISK"),
        angles(prefix + std::string(kAnglesChannelName)),
        stairways(prefix + "STAIRWAYS"),
        health(prefix + "HEALTH"),
        settings(prefix + std::string(kSettingsChannelName)),
        raw(prefix + "RAW"),
        cloud(prefix + "CLOUD"),
        command(prefix + "COMMAND"),
        command_ack(prefix + "COMMAND_ACK") {}

  std::string scan;         ///< scan_t
  std::string disk;         ///< disk_t
  std::string angles;       ///< angles_t
  std::string stairways;    ///< stairways_t
  std::string health;       ///< health_t
  std::string settings;     ///< settings_t
  std::string raw;          ///< raw_t
  std::string cloud;        ///< cloud_slice_t
  std::string command;      ///< command_t, to the daemon
  std::string command_ack;  ///< command_ack_t
};

}  // namespace stairway::ipc
