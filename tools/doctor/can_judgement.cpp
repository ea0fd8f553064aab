// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/doctor/can.hpp"

namespace stairway::doctor {
namespace {

using drivers::CanCondition;

constexpr std::uint32_t kMinQueueFrames = 50;
constexpr std::uint32_t kMotionProfile = 0x0192;  // CiA 402, in the low word of object 1000
constexpr std::uint8_t kBootUp = 0x00, kStopped = 0x04, kOperational = 0x05, kPreOperational = 0x7F;

Check judge_kernel(const CanFacts& facts) {
  if (facts.no_kernel_support.empty()) return ok("can", "the kernel has CAN");
  return failure("can", "this kernel has no CAN: " + facts.no_kernel_support,
                 "modprobe can-raw, or a kernel built with CONFIG_CAN and CONFIG_CAN_RAW");
}

Check judge_link(const CanFacts& facts) {
  constexpr const char* kName = "can-link";
  const std::string& interface = facts.interface;
  if (!facts.link) {
    const std::string others =
        facts.others.empty() ? "" : fmt::format(", but there is {}", fmt::join(facts.others, ", "));
    return failure(kName, fmt::format("no interface {}{}", interface, others),
                   "plug the CAN adapter in and look at dmesg, or change motor.interface");
  }
  if (!facts.link->is_can) return failure(kName, interface + " is no CAN interface", "change motor.interface");
  if (!facts.link->is_up) {
    return failure(
        kName, interface + " is down",
        fmt::format("ip link set {} up type can bitrate 500000 restart-ms 100; docs/hardware.md shows how to "
                    "have it at boot",
                    interface));
  }
  if (facts.link->tx_queue_frames < kMinQueueFrames) {
    return warning(kName, fmt::format("{} queues {} frames only", interface, facts.link->tx_queue_frames),
                   fmt::format("ip link set {} txqueuelen 100", interface));
  }
  const std::string rate = facts.link->bit_rate ? fmt::format(", {} kbit/s", *facts.link->bit_rate / 1000) : "";
  return ok(kName, fmt::format("{} is up{}", interface, rate));
}

Check judge_bus(const LinkInfo& link) {
  constexpr const char* kName = "can-bus";
  if (!link.bus_state) return skipped(kName, link.name + " tells no bus state (a virtual bus has none)");
  const std::string text = fmt::format("{} is {}", link.name, to_string(*link.bus_state));
  switch (*link.bus_state) {
    case CanBusState::Active:
      if (link.restart_ms.value_or(1) == 0) {
        return warning(kName, text + ", but would stay off after bus-off",
                       fmt::format("ip link set {} type can restart-ms 100, while it is down", link.name));
      }
      return ok(kName, text);
    case CanBusState::Warning:
    case CanBusState::Passive:
      return warning(kName, text + ": frames go wrong",
                     "check 120 ohm at both ends, the same bit rate everywhere, and that the drive has power");
    case CanBusState::BusOff:
      return failure(kName, text,
                     fmt::format("mend the wiring or the bit rate, then ip link set {} type can restart", link.name));
    case CanBusState::Stopped:
    case CanBusState::Sleeping:
      break;
  }
  return failure(kName, text, fmt::format("ip link set {} down, then up", link.name));
}

std::string state_name(std::uint8_t state) {
  switch (state) {
    case kBootUp:
      return "has just booted";
    case kStopped:
      return "is stopped";
    case kOperational:
      return "is operational";
    case kPreOperational:
      return "is pre-operational";
    default:
      return fmt::format("is in the unknown state {:02x}", state);
  }
}

Check judge_device_type(const DriveFacts& facts, std::uint32_t device_type) {
  if ((device_type & 0xFFFF) == kMotionProfile) {
    return ok("drive", fmt::format("node {} is a CiA 402 drive (device type {:08x})", facts.node, device_type));
  }
  return failure("drive", fmt::format("node {} is no CiA 402 drive (device type {:08x})", facts.node, device_type),
                 "change motor.node_id to that of the drive");
}

Check judge_silence(const DriveFacts& facts) {
  const std::string silent = fmt::format("node {} is silent", facts.node);
  if (facts.conditions.contains(CanCondition::Unheard)) {
    return failure("drive", silent + ", and nobody acknowledges",
                   "check the drive's power, the cable, 120 ohm at both ends, and the bit rate");
  }
  if (!facts.other_nodes.empty()) {
    return failure("drive", fmt::format("{}, but node {} is heard", silent, fmt::join(facts.other_nodes, ", ")),
                   "change motor.node_id, or the drive's switches");
  }
  if (facts.was_asked) {
    return failure("drive", fmt::format("{} even when asked, {} other frames", silent, facts.frames),
                   "check the drive's power, its node id and bit rate, and the cable");
  }
  return warning("drive", fmt::format("{}, {} other frames; it may have no heartbeat yet", silent, facts.frames),
                 "stairway doctor --probe asks it");
}

}  // namespace

std::vector<Check> judge(const CanFacts& facts) {
  std::vector<Check> checks{judge_kernel(facts)};
  if (checks.front().state == State::Failure) return checks;
  checks.push_back(judge_link(facts));
  if (facts.link && facts.link->is_can && facts.link->is_up) checks.push_back(judge_bus(*facts.link));
  return checks;
}

Check judge(const DriveFacts& facts) {
  if (facts.device_type) return judge_device_type(facts, *facts.device_type);
  if (facts.abort_code) {
    return failure("drive", fmt::format("node {} refuses object 1000 (abort {:08x})", facts.node, *facts.abort_code),
                   "is it a CANopen drive? Change motor.node_id otherwise");
  }
  if (facts.heartbeat) return ok("drive", fmt::format("node {} {}", facts.node, state_name(*facts.heartbeat)));
  return judge_silence(facts);
}

}  // namespace stairway::doctor
