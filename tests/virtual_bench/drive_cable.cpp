// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/drive_cable.hpp"

#include <poll.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "tests/virtual_bench/can_socket.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;

constexpr auto kReopenPause = 20ms;
constexpr drivers::HostStamp kLongestWait_ns = 20'000'000;

std::vector<drivers::CanFrame> words(Robot& robot, drivers::HostStamp& due_ns) {
  const std::lock_guard lock(robot.mutex);
  std::vector<drivers::CanFrame> frames;
  while (auto sent = robot.drive.take(now_ns())) frames.push_back(sent->second);
  due_ns = robot.drive.next_due_ns();
  return frames;
}

// Until the interface is removed.
void talk(Robot& robot, const CanSocket& socket, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    drivers::HostStamp due_ns = 0;
    for (const drivers::CanFrame& frame : words(robot, due_ns)) socket.write(frame);
    const timespec wait{0, std::clamp<drivers::HostStamp>(due_ns - now_ns(), 0, kLongestWait_ns)};
    pollfd ready{socket.descriptor(), POLLIN, 0};
    if (::ppoll(&ready, 1, &wait, nullptr) <= 0) continue;
    drivers::CanFrame frame;
    switch (socket.read(frame)) {
      case CanSocket::Reading::Gone:
        return;
      case CanSocket::Reading::Nothing:
        // An interface that is down is always ready to say so.
        std::this_thread::sleep_for(1ms);
        break;
      case CanSocket::Reading::Frame: {
        const std::lock_guard lock(robot.mutex);
        robot.drive.receive(frame, now_ns());
        break;
      }
    }
  }
}

}  // namespace

void serve_drive(Robot& robot, const std::string& interface, std::stop_token stop) {
  while (!stop.stop_requested()) {
    if (const auto socket = CanSocket::open(interface)) talk(robot, *socket, stop);
    drivers::HostStamp due_ns = 0;
    words(robot, due_ns);
    std::this_thread::sleep_for(kReopenPause);
  }
}

}  // namespace stairway::bench
