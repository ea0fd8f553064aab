// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>

#include "drivers/ports/can_port.hpp"

namespace stairway::drivers {

/// What has become of the interface that a socket is bound to.
enum class CanLink : std::uint8_t { Up, Down, Gone };

/// A raw CAN socket. Frames are stamped by the kernel when the driver hands them over, which is the wall clock, and
/// moved to CLOCK_MONOTONIC with the difference of the two clocks at the read; never before the last one and never
/// after now. Where the socket has no stamps, the time of the read counts.
///
/// A full transmit queue (ENOBUFS) is tried again every millisecond for 0.1 s, and then once per frame until one can be
/// placed. While the link is down it is looked at every 0.1 s. Frames that the kernel dropped are an `Overrun`.
class SocketCanPort : public CanPort {
 public:
  using LinkWatch = std::function<CanLink()>;

  /// Takes the socket over.
  SocketCanPort(int socket, LinkWatch look_at_link);
  ~SocketCanPort() override;
  SocketCanPort(const SocketCanPort&) = delete;
  SocketCanPort& operator=(const SocketCanPort&) = delete;

  tl::expected<std::vector<CanArrival>, PortError> read(std::chrono::nanoseconds timeout) override;
  tl::expected<void, PortError> write(const CanFrame& frame) override;

 private:
  enum class Taken : std::uint8_t { Something, Nothing, Failed };

  std::vector<CanArrival> wait_for_link(std::chrono::nanoseconds timeout);
  void wait(std::chrono::nanoseconds timeout) const;
  Taken take_frame(std::vector<CanArrival>& arrivals, HostStamp wall_offset_ns);
  PortError note_error(int error);
  void add_condition(std::vector<CanArrival>& arrivals, CanCondition condition);

  int socket_;
  LinkWatch look_at_link_;
  bool is_down_ = false;
  bool is_down_told_ = false;
  bool is_closed_ = false;
  bool is_queue_full_ = false;
  std::uint32_t kernel_drops_ = 0;
  HostStamp last_arrival_ns_ = 0;
};

struct SocketCanOptions {
  std::string interface = "can0";
  int node_id = 1;  ///< only what concerns this node is received
  int host_node_id = 127;
  bool hears_everybody = false;  ///< other nodes' frames as well
};

/// A port on that interface, or why there is none and what to do.
tl::expected<std::unique_ptr<CanPort>, std::string> open_socket_can(const SocketCanOptions& options);

}  // namespace stairway::drivers
