// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string_view>

#include "ipc/channels.hpp"
#include "ipc/lcm_bus.hpp"
#include "ipc/message_codec.hpp"
#include "tests/ipc/message_fixtures.hpp"

// Run by lcm_bus_test.cpp inside a private network namespace; exit code 0 if all is as it should be.
namespace {

using namespace stairway::ipc;

bool scan_is_delivered() {
  const auto receiver = LcmBus::open(BusOptions{}.url);
  const auto sender = LcmBus::open(BusOptions{}.url);
  if (!receiver || !sender) return false;
  bool is_as_sent = false;
  const Bytes sent = encode(test::sample_scan());
  const auto compare = [&](const BusMessage& message) {
    is_as_sent = std::equal(sent.begin(), sent.end(), message.bytes.begin(), message.bytes.end());
  };
  if (!(*receiver)->subscribe(Channels().scan, compare)) return false;
  if (!(*sender)->publish(Channels().scan, sent)) return false;
  const auto handled = (*receiver)->handle(std::chrono::seconds(5));
  return handled && *handled && is_as_sent;
}

bool missing_route_is_reported() {
  const auto bus = LcmBus::open(BusOptions{}.url);
  return !bus && bus.error().text.find("ip route add 224.0.0.0/4 dev lo") != std::string::npos;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view task = argc == 2 ? argv[1] : "";
  if (task == "deliver") return scan_is_delivered() ? 0 : 1;
  if (task == "refuse") return missing_route_is_reported() ? 0 : 1;
  std::fputs("usage: multicast_probe deliver|refuse\n", stderr);
  return 2;
}
