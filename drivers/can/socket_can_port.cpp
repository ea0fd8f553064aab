// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/can/socket_can_port.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <system_error>
#include <thread>
#include <utility>

#include "drivers/can/raw_can_frame.hpp"
#include "drivers/host_clock.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::size_t kMostFrames = 1024;  // in one read: more than the kernel holds
constexpr nanoseconds kLinkPoll = milliseconds(100);
constexpr nanoseconds kQueuePause = milliseconds(1);
constexpr int kQueueAttempts = 100;
constexpr int kReceiveBuffer = 1 << 18;

timespec to_timespec(nanoseconds time) {
  return {static_cast<time_t>(time.count() / 1'000'000'000), static_cast<long>(time.count() % 1'000'000'000)};
}

HostStamp to_ns(const timespec& time) { return static_cast<HostStamp>(time.tv_sec) * 1'000'000'000 + time.tv_nsec; }

// CLOCK_MONOTONIC minus CLOCK_REALTIME.
HostStamp wall_offset() {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  return monotonic_now_ns() - to_ns(wall);
}

template <class Value>
void set_option(int socket, int level, int name, const Value& value) {
  static_cast<void>(setsockopt(socket, level, name, &value, sizeof value));
}

std::string error_text(int error) { return std::generic_category().message(error); }

CanLink look_at(int socket, const std::string& interface, unsigned index) {
  if (if_nametoindex(interface.c_str()) != index) return CanLink::Gone;
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  if (ioctl(socket, SIOCGIFFLAGS, &request) < 0) return CanLink::Gone;
  return (request.ifr_flags & IFF_UP) != 0 ? CanLink::Up : CanLink::Down;
}

void set_options(int socket, const SocketCanOptions& options) {
  std::vector<can_filter> filters{{0, CAN_EFF_FLAG | CAN_RTR_FLAG}};
  if (!options.hears_everybody) filters = raw_filters(options.node_id, options.host_node_id);
  static_cast<void>(setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                               static_cast<socklen_t>(filters.size() * sizeof(can_filter))));
  set_option(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, raw_error_classes());
  set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, 1);
  set_option(socket, SOL_SOCKET, SO_RXQ_OVFL, 1);
  set_option(socket, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
}

}  // namespace

SocketCanPort::SocketCanPort(int socket, LinkWatch look_at_link)
    : socket_(socket), look_at_link_(std::move(look_at_link)) {}

SocketCanPort::~SocketCanPort() { close(socket_); }

tl::expected<std::vector<CanArrival>, PortError> SocketCanPort::read(nanoseconds timeout) {
  if (is_closed_) return tl::unexpected(PortError::Closed);
  if (is_down_) {
    auto arrivals = wait_for_link(timeout);
    if (is_closed_) return tl::unexpected(PortError::Closed);
    return arrivals;
  }
  wait(timeout);
  const HostStamp offset_ns = wall_offset();
  std::vector<CanArrival> arrivals;
  for (std::size_t i = 0; i < kMostFrames; ++i) {
    const Taken taken = take_frame(arrivals, offset_ns);
    if (taken == Taken::Nothing) break;
    if (taken == Taken::Something) continue;
    const PortError error = note_error(errno);
    if (is_down_) {
      add_condition(arrivals, CanCondition::LinkDown);
      is_down_told_ = true;
      break;
    }
    if (arrivals.empty()) return tl::unexpected(error);
    break;
  }
  return arrivals;
}

void SocketCanPort::wait(nanoseconds timeout) const {
  pollfd waited{socket_, POLLIN, 0};
  const timespec limit = to_timespec(std::max(timeout, nanoseconds::zero()));
  ppoll(&waited, 1, &limit, nullptr);
}

std::vector<CanArrival> SocketCanPort::wait_for_link(nanoseconds timeout) {
  std::vector<CanArrival> arrivals;
  if (!std::exchange(is_down_told_, true)) {
    add_condition(arrivals, CanCondition::LinkDown);
    return arrivals;
  }
  CanLink link = look_at_link_();
  if (link == CanLink::Down) {
    std::this_thread::sleep_for(std::min(timeout, kLinkPoll));
    link = look_at_link_();
  }
  if (link == CanLink::Gone) is_closed_ = true;
  if (link == CanLink::Up) {
    is_down_ = false;
    is_down_told_ = false;
    add_condition(arrivals, CanCondition::LinkUp);
  }
  return arrivals;
}

SocketCanPort::Taken SocketCanPort::take_frame(std::vector<CanArrival>& arrivals, HostStamp wall_offset_ns) {
  can_frame raw{};
  iovec part{&raw, sizeof raw};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  const ssize_t size = recvmsg(socket_, &message, MSG_DONTWAIT);
  if (size < 0) return errno == EAGAIN || errno == EINTR ? Taken::Nothing : Taken::Failed;
  if (size != sizeof raw) {
    errno = size == 0 ? ENODEV : EIO;
    return Taken::Failed;
  }
  const HostStamp now_ns = monotonic_now_ns();
  HostStamp arrival_ns = now_ns;
  for (cmsghdr* part_header = CMSG_FIRSTHDR(&message); part_header != nullptr;
       part_header = CMSG_NXTHDR(&message, part_header)) {
    if (part_header->cmsg_level != SOL_SOCKET) continue;
    if (part_header->cmsg_type == SO_TIMESTAMPNS) {
      timespec wall{};
      std::memcpy(&wall, CMSG_DATA(part_header), sizeof wall);
      arrival_ns = to_ns(wall) + wall_offset_ns;
    } else if (part_header->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(part_header), sizeof drops);
      if (std::exchange(kernel_drops_, drops) != drops) add_condition(arrivals, CanCondition::Overrun);
    }
  }
  // The wall clock may have been set between the driver's stamp and this read.
  last_arrival_ns_ = std::clamp(arrival_ns, std::min(last_arrival_ns_, now_ns), now_ns);
  for (const auto& what : from_raw_frame(raw)) arrivals.push_back({last_arrival_ns_, what});
  return Taken::Something;
}

tl::expected<void, PortError> SocketCanPort::write(const CanFrame& frame) {
  if (is_closed_) return tl::unexpected(PortError::Closed);
  if (is_down_) return tl::unexpected(PortError::Io);
  const can_frame raw = to_raw_frame(frame);
  for (int attempt = 0;; ++attempt) {
    const ssize_t size = send(socket_, &raw, sizeof raw, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (size == sizeof raw) {
      is_queue_full_ = false;
      return {};
    }
    const int error = size < 0 ? errno : EIO;
    if (error == EINTR) continue;
    if (error != ENOBUFS && error != EAGAIN) return tl::unexpected(note_error(error));
    if (is_queue_full_ || attempt >= kQueueAttempts) {
      is_queue_full_ = true;
      return tl::unexpected(PortError::Io);
    }
    std::this_thread::sleep_for(kQueuePause);
  }
}

PortError SocketCanPort::note_error(int error) {
  if (error == ENETDOWN) is_down_ = true;
  if (error == ENODEV || error == ENXIO || error == EPIPE || error == ECONNRESET) is_closed_ = true;
  return is_closed_ ? PortError::Closed : PortError::Io;
}

void SocketCanPort::add_condition(std::vector<CanArrival>& arrivals, CanCondition condition) {
  arrivals.push_back({monotonic_now_ns(), condition});
}

tl::expected<std::unique_ptr<CanPort>, std::string> open_socket_can(const SocketCanOptions& options) {
  const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (socket < 0) {
    const int error = errno;
    if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT) {
      return tl::unexpected(
          std::string("this kernel has no CAN: load it with `modprobe can_raw`, or use a kernel that has it"));
    }
    return tl::unexpected("no CAN socket: " + error_text(error));
  }
  const unsigned index = if_nametoindex(options.interface.c_str());
  auto port = std::make_unique<SocketCanPort>(
      socket, [socket, interface = options.interface, index] { return look_at(socket, interface, index); });
  if (index == 0) {
    return tl::unexpected(options.interface +
                          " does not exist: is the CAN adapter plugged in? `ip link` lists the interfaces there are");
  }
  set_options(socket, options);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
    const int error = errno;
    return tl::unexpected(options.interface +
                          (error == ENODEV ? " is no CAN interface" : " cannot be bound: " + error_text(error)));
  }
  return port;
}

}  // namespace stairway::drivers
