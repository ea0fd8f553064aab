// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <linux/can.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "tools/doctor/can.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

constexpr std::uint16_t kSdoReply = 0x580, kSdoRequest = 0x600, kHeartbeat = 0x700;
constexpr int kMaxNode = 127;

std::string kernel_refusal() {
  const int fd = ::socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) return std::generic_category().message(errno);
  ::close(fd);
  return {};
}

std::vector<std::string> can_interfaces() {
  std::vector<std::string> found;
  auto* const all = ::if_nameindex();
  for (auto* one = all; one != nullptr && one->if_index != 0; ++one) {
    const auto link = read_link(one->if_name);
    if (link && link->is_can) found.emplace_back(one->if_name);
  }
  if (all != nullptr) ::if_freenameindex(all);
  return found;
}

std::uint32_t number_in(const CanFrame& frame) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i < frame.data.size(); ++i) value |= std::uint32_t{frame.data[i]} << (8 * (i - 4));
  return value;
}

CanFrame device_type_question(int node) {
  return {static_cast<std::uint16_t>(kSdoRequest + node), 8, {0x40, 0x00, 0x10, 0x00}};
}

void take(const CanFrame& frame, DriveFacts& facts) {
  ++facts.frames;
  const int node = frame.id & 0x7F;
  if ((frame.id & ~0x7F) == kHeartbeat && frame.length == 1 && node > 0) {
    if (node == facts.node) {
      facts.heartbeat = static_cast<std::uint8_t>(frame.data[0] & 0x7F);
    } else {
      facts.other_nodes.insert(node);
    }
  }
  const bool is_answer = frame.id == kSdoReply + facts.node && frame.length == 8 && frame.data[1] == 0x00 &&
                         frame.data[2] == 0x10 && frame.data[3] == 0x00;
  if (!is_answer || !facts.was_asked) return;
  if (frame.data[0] == 0x80) {
    facts.abort_code = number_in(frame);
  } else {
    facts.device_type = number_in(frame);
  }
}

bool is_complete(const DriveFacts& facts) {
  if (facts.was_asked) return facts.device_type || facts.abort_code;
  return facts.heartbeat.has_value();
}

}  // namespace

CanFacts look_at_can(const std::string& interface) {
  CanFacts facts{.interface = interface, .no_kernel_support = kernel_refusal(), .link = read_link(interface)};
  for (const std::string& name : can_interfaces()) {
    if (name != interface) facts.others.push_back(name);
  }
  return facts;
}

DriveFacts listen_for_drive(CanPort& port, int node, bool may_ask, std::chrono::nanoseconds patience,
                            const std::function<HostStamp()>& now) {
  DriveFacts facts{.node = node};
  if (node < 1 || node > kMaxNode) return facts;
  if (may_ask) facts.was_asked = port.write(device_type_question(node)).has_value();
  const HostStamp end_ns = now() + patience.count();
  for (HostStamp at_ns = now(); at_ns < end_ns && !is_complete(facts); at_ns = now()) {
    const auto arrivals = port.read(std::chrono::nanoseconds(end_ns - at_ns));
    if (!arrivals) break;
    for (const CanArrival& arrival : *arrivals) {
      if (const auto* frame = std::get_if<CanFrame>(&arrival.what)) take(*frame, facts);
      if (const auto* condition = std::get_if<CanCondition>(&arrival.what)) facts.conditions.insert(*condition);
    }
  }
  return facts;
}

}  // namespace stairway::doctor
