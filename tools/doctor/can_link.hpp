// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace stairway::doctor {

enum class CanBusState : std::uint8_t { Active, Warning, Passive, BusOff, Stopped, Sleeping };
const char* to_string(CanBusState state);

/// A network interface as the kernel describes it to `ip -details link`.
struct LinkInfo {
  std::string name;
  std::string kind;  ///< driver family: "can", "vcan"; empty for hardware without one
  bool is_can = false;
  bool is_up = false;
  std::uint32_t tx_queue_frames = 0;
  std::optional<std::uint32_t> bit_rate;    ///< [bit/s]
  std::optional<CanBusState> bus_state;     ///< none on a virtual bus
  std::optional<std::uint32_t> restart_ms;  ///< after bus-off; 0 = never [ms]
};

/// Reads one RTM_NEWLINK message. Empty when it is another one, or cut short; unknown attributes are left out.
std::optional<LinkInfo> parse_link_message(std::span<const std::byte> message);

/// Asks the kernel. Empty when there is no interface of that name, or no answer.
std::optional<LinkInfo> read_link(const std::string& name);

}  // namespace stairway::doctor
