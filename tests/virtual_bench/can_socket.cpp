// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace stairway::bench {

std::optional<CanSocket> CanSocket::open(const std::string& interface) {
  drivers::FileDescriptor file(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  if (!file.is_open() || address.can_ifindex == 0) return std::nullopt;
  if (::bind(file.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return std::nullopt;
  return CanSocket(std::move(file));
}

CanSocket::Reading CanSocket::read(drivers::CanFrame& frame) const {
  can_frame raw{};
  if (::read(file_.get(), &raw, sizeof(raw)) != sizeof(raw))
    return errno == ENODEV || errno == ENXIO ? Reading::Gone : Reading::Nothing;
  frame.id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
  std::copy_n(raw.data, 8, frame.data.begin());
  return Reading::Frame;
}

void CanSocket::write(const drivers::CanFrame& frame) const {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::copy_n(frame.data.begin(), 8, raw.data);
  [[maybe_unused]] const ssize_t written = ::write(file_.get(), &raw, sizeof(raw));
}

}  // namespace stairway::bench
