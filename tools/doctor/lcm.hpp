// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ipc/bus.hpp"
#include "ipc/channels.hpp"
#include "ipc/messages.hpp"
#include "tools/doctor/check.hpp"
#include "tools/doctor/machine.hpp"

namespace stairway::doctor {

/// The parts of `udpm://ADDRESS:PORT?ttl=N&recv_buf_size=N`; what is left out has LCM's defaults.
struct UdpmUrl {
  std::string address = "239.255.76.67";
  int port = 7667;
  int ttl = 0;
  std::int64_t receive_buffer_bytes = 0;  ///< 0 = the kernel's default

  bool is_multicast() const;
};
/// Empty when it is no URL of this provider, or a part of it is not a number or out of range.
std::optional<UdpmUrl> parse_udpm_url(std::string_view url);

struct LcmFacts {
  std::string url;
  std::optional<std::string> route;  ///< interface by which the address is reached
  std::optional<std::int64_t> default_buffer_bytes;
  std::optional<std::int64_t> max_buffer_bytes;
};
LcmFacts look_at_lcm(const Machine& machine, const std::string& url);

/// lcm-url, lcm-route, lcm-buffers.
std::vector<Check> judge(const LcmFacts& facts);

/// What was heard on the bus.
struct BusFacts {
  std::string error;  ///< why the bus cannot be used; empty when it can
  bool is_own_message_heard = false;
  std::optional<ipc::HealthMessage> health;  ///< of a running daemon
  int undecodable = 0;                       ///< messages on its channel that are none
};
/// Opens the bus, sends one small message to itself on the channel PREFIX + "DOCTOR", and listens for the daemon.
BusFacts listen_on_bus(const ipc::BusOptions& options, std::chrono::milliseconds patience);

/// lcm-self-test, daemon, and daemon-DEVICE for every device that the daemon finds unwell.
std::vector<Check> judge(const BusFacts& facts, const std::vector<ProcessFacts>& daemons);

}  // namespace stairway::doctor
