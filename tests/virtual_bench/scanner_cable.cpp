// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/scanner_cable.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <thread>

#include "drivers/gpio/file_descriptor.hpp"

namespace stairway::bench {
namespace {

using drivers::FileDescriptor;
using namespace std::chrono_literals;

constexpr auto kReopenPause = 20ms;
constexpr drivers::HostStamp kLongestWait_ns = 50'000'000;
// A host that does not read makes the sensor lose scans; this is what a few of them take.
constexpr std::size_t kMostUnsent = 16'384;

FileDescriptor open_raw(const std::string& tty) {
  FileDescriptor file(::open(tty.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!file.is_open() || ::tcgetattr(file.get(), &settings) != 0) return FileDescriptor();
  ::cfmakeraw(&settings);
  if (::tcsetattr(file.get(), TCSANOW, &settings) != 0) return FileDescriptor();
  return file;
}

// What the scanner has said by now; `due_ns` becomes the time of its next word.
std::string words(Robot& robot, drivers::HostStamp& due_ns) {
  const std::lock_guard lock(robot.mutex);
  std::string text;
  while (auto chunk = robot.scanner.take(now_ns())) text += chunk->bytes;
  due_ns = robot.scanner.next_due_ns();
  return text;
}

bool hear(Robot& robot, int file) {
  std::array<char, 256> bytes;
  const ssize_t count = ::read(file, bytes.data(), bytes.size());
  if (count <= 0) return false;
  const std::lock_guard lock(robot.mutex);
  robot.scanner.receive({bytes.data(), static_cast<std::size_t>(count)}, now_ns());
  return true;
}

// Until the cable is pulled.
void talk(Robot& robot, int file, const std::stop_token& stop) {
  std::string unsent;
  while (!stop.stop_requested()) {
    drivers::HostStamp due_ns = 0;
    std::string text = words(robot, due_ns);
    if (unsent.size() + text.size() <= kMostUnsent) unsent += text;
    const auto wait_ns = std::clamp<drivers::HostStamp>(due_ns - now_ns(), 0, kLongestWait_ns);
    const timespec wait{0, wait_ns};
    pollfd ready{file, static_cast<short>(unsent.empty() ? POLLIN : POLLIN | POLLOUT), 0};
    if (::ppoll(&ready, 1, &wait, nullptr) < 0) return;
    if ((ready.revents & (POLLHUP | POLLERR)) != 0) return;
    if ((ready.revents & POLLIN) != 0 && !hear(robot, file)) return;
    if ((ready.revents & POLLOUT) == 0) continue;
    const ssize_t count = ::write(file, unsent.data(), unsent.size());
    if (count < 0) return;
    unsent.erase(0, static_cast<std::size_t>(count));
  }
}

}  // namespace

void serve_scanner(Robot& robot, const std::string& tty, std::stop_token stop) {
  while (!stop.stop_requested()) {
    if (const FileDescriptor file = open_raw(tty); file.is_open()) talk(robot, file.get(), stop);
    drivers::HostStamp due_ns = 0;
    words(robot, due_ns);
    std::this_thread::sleep_for(kReopenPause);
  }
}

}  // namespace stairway::bench
