// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/order_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "drivers/gpio/file_descriptor.hpp"

namespace stairway::bench {
namespace {

using drivers::FileDescriptor;

constexpr int kStopCheck_ms = 100;
constexpr int kPatience_ms = 10'000;

[[noreturn]] void fail(const std::string& path) { throw std::system_error(errno, std::generic_category(), path); }

FileDescriptor make_socket() { return FileDescriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0)); }

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  return address;
}

// Whoever takes orders may still be about to listen.
FileDescriptor connect_to(const std::string& path) {
  const sockaddr_un address = address_of(path);
  for (int waited_ms = 0;; waited_ms += kStopCheck_ms) {
    FileDescriptor socket = make_socket();
    if (!socket.is_open()) fail(path);
    if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return socket;
    if ((errno != ENOENT && errno != ECONNREFUSED) || waited_ms >= kPatience_ms) fail(path);
    std::this_thread::sleep_for(std::chrono::milliseconds(kStopCheck_ms));
  }
}

bool is_readable(int file, int timeout_ms) {
  pollfd ready{file, POLLIN, 0};
  return ::poll(&ready, 1, timeout_ms) == 1;
}

std::string receive(int file) {
  std::array<char, 4096> bytes;
  const ssize_t count = ::recv(file, bytes.data(), bytes.size(), 0);
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

void send(int file, const std::string& text) { ::send(file, text.data(), text.size(), MSG_NOSIGNAL); }

}  // namespace

void serve_orders(const std::string& path, const OrderHandler& handle, std::stop_token stop) {
  const FileDescriptor listener = make_socket();
  const sockaddr_un address = address_of(path);
  ::unlink(path.c_str());
  if (!listener.is_open() ||
      ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::listen(listener.get(), 4) != 0) {
    fail(path);
  }
  while (!stop.stop_requested()) {
    if (!is_readable(listener.get(), kStopCheck_ms)) continue;
    const FileDescriptor caller(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (caller.is_open() && is_readable(caller.get(), kPatience_ms)) send(caller.get(), handle(receive(caller.get())));
  }
  ::unlink(path.c_str());
}

std::string send_order(const std::string& path, const std::string& order) {
  const FileDescriptor socket = connect_to(path);
  send(socket.get(), order);
  errno = ETIMEDOUT;
  if (!is_readable(socket.get(), kPatience_ms)) fail(path);
  return receive(socket.get());
}

}  // namespace stairway::bench
