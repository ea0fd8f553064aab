// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/service_notifier.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>

namespace stairway::daemon {
namespace {

TEST(ServiceNotifier, sends_to_an_abstract_socket) {
  const std::string name = "stairway_notify_" + std::to_string(::getpid());
  sockaddr_un address{AF_UNIX, {}};
  name.copy(address.sun_path + 1, name.size());
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), size), 0);

  ::setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  ServiceNotifier().send("READY=1");
  ::unsetenv("NOTIFY_SOCKET");
  ServiceNotifier().send("not for anybody");

  std::array<char, 100> datagram;
  const ssize_t received = ::recv(socket, datagram.data(), datagram.size(), MSG_DONTWAIT);
  ASSERT_GT(received, 0);
  EXPECT_EQ(std::string(datagram.data(), static_cast<std::size_t>(received)), "READY=1");
  EXPECT_LT(::recv(socket, datagram.data(), datagram.size(), MSG_DONTWAIT), 0);
  ::close(socket);
}

}  // namespace
}  // namespace stairway::daemon
