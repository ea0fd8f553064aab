// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/doctor/can_link.hpp"

#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace stairway::doctor {
namespace {

using Bytes = std::span<const std::byte>;

template <typename Value>
std::optional<Value> value_at(Bytes bytes) {
  if (bytes.size() < sizeof(Value)) return std::nullopt;
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::string text_of(Bytes bytes) {
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  return {text, ::strnlen(text, bytes.size())};
}

/// Calls `take(type, payload)` for every attribute up to the first that is cut short.
template <typename Take>
void for_each_attribute(Bytes bytes, const Take& take) {
  while (const auto header = value_at<rtattr>(bytes)) {
    if (header->rta_len < sizeof(rtattr) || header->rta_len > bytes.size()) return;
    take(header->rta_type & NLA_TYPE_MASK, bytes.subspan(RTA_LENGTH(0), header->rta_len - RTA_LENGTH(0)));
    bytes = bytes.subspan(std::min<std::size_t>(RTA_ALIGN(header->rta_len), bytes.size()));
  }
}

std::optional<CanBusState> bus_state(std::uint32_t state) {
  if (state > CAN_STATE_SLEEPING) return std::nullopt;
  return static_cast<CanBusState>(state);
}

void take_can_data(Bytes data, LinkInfo& link) {
  for_each_attribute(data, [&](int type, Bytes payload) {
    if (type == IFLA_CAN_BITTIMING) {
      if (const auto timing = value_at<can_bittiming>(payload)) link.bit_rate = timing->bitrate;
    } else if (type == IFLA_CAN_STATE) {
      if (const auto state = value_at<std::uint32_t>(payload)) link.bus_state = bus_state(*state);
    } else if (type == IFLA_CAN_RESTART_MS) {
      link.restart_ms = value_at<std::uint32_t>(payload);
    }
  });
}

void take_link_info(Bytes info, LinkInfo& link) {
  for_each_attribute(info, [&](int type, Bytes payload) {
    if (type == IFLA_INFO_KIND) link.kind = text_of(payload);
    if (type == IFLA_INFO_DATA && link.kind == "can") take_can_data(payload, link);
  });
}

struct Socket {
  int fd = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  ~Socket() {
    if (fd >= 0) ::close(fd);
  }
};

struct Request {
  nlmsghdr header{};
  ifinfomsg body{};
  rtattr name_header{};
  std::array<char, IFNAMSIZ> name{};
};

}  // namespace

const char* to_string(CanBusState state) {
  switch (state) {
    case CanBusState::Active:
      return "error-active";
    case CanBusState::Warning:
      return "error-warning";
    case CanBusState::Passive:
      return "error-passive";
    case CanBusState::BusOff:
      return "bus-off";
    case CanBusState::Stopped:
      return "stopped";
    case CanBusState::Sleeping:
      return "sleeping";
  }
  return "?";
}

std::optional<LinkInfo> parse_link_message(Bytes message) {
  const auto header = value_at<nlmsghdr>(message);
  if (!header || header->nlmsg_type != RTM_NEWLINK || header->nlmsg_len > message.size()) return std::nullopt;
  if (header->nlmsg_len < NLMSG_LENGTH(sizeof(ifinfomsg))) return std::nullopt;
  message = message.first(header->nlmsg_len);
  const auto body = value_at<ifinfomsg>(message.subspan(NLMSG_HDRLEN));
  LinkInfo link;
  link.is_can = body->ifi_type == ARPHRD_CAN;
  link.is_up = (body->ifi_flags & IFF_UP) != 0;
  for_each_attribute(message.subspan(NLMSG_LENGTH(sizeof(ifinfomsg))), [&](int type, Bytes payload) {
    if (type == IFLA_IFNAME) link.name = text_of(payload);
    if (type == IFLA_TXQLEN) link.tx_queue_frames = value_at<std::uint32_t>(payload).value_or(0);
    if (type == IFLA_LINKINFO) take_link_info(payload, link);
  });
  return link;
}

std::optional<LinkInfo> read_link(const std::string& name) {
  if (name.empty() || name.size() >= IFNAMSIZ) return std::nullopt;
  const Socket socket;
  Request request;
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.body.ifi_family = AF_UNSPEC;
  request.name_header.rta_len = static_cast<unsigned short>(RTA_LENGTH(IFNAMSIZ));
  request.name_header.rta_type = IFLA_IFNAME;
  std::memcpy(request.name.data(), name.data(), name.size());
  alignas(nlmsghdr) std::array<std::byte, 16384> reply;
  if (socket.fd < 0 || ::send(socket.fd, &request, sizeof request, 0) < 0) return std::nullopt;
  const ssize_t got = ::recv(socket.fd, reply.data(), reply.size(), 0);
  if (got < 0) return std::nullopt;
  auto link = parse_link_message(Bytes(reply).first(static_cast<std::size_t>(got)));
  return link && link->name == name ? link : std::nullopt;
}

}  // namespace stairway::doctor
