// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/listener.hpp"

#include <gtest/gtest.h>

#include <string>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"

namespace stairway::test {

using namespace std::chrono_literals;

Listener::Listener() {
  auto bus = ipc::LcmBus::open(ipc::BusOptions{}.url);
  if (!bus) {
    ADD_FAILURE() << bus.error().text;
    return;
  }
  bus_ = std::move(*bus);
  const ipc::Channels channels;
  keep(channels.scan, scans);
  keep(channels.disk, disks);
  keep(channels.stairways, answers);
  keep(channels.health, healths);
  keep(channels.settings, settings);
}

template <class Message>
void Listener::keep(const std::string& channel, std::vector<Message>& messages) {
  const auto subscribed = bus_->subscribe(channel, [&messages, channel](const ipc::BusMessage& message) {
    auto decoded = ipc::decode<Message>(message.bytes);
    if (decoded) {
      messages.push_back(std::move(*decoded));
    } else {
      ADD_FAILURE() << channel << ": " << ipc::to_string(decoded.error());
    }
  });
  if (!subscribed) ADD_FAILURE() << subscribed.error().text;
}

bool Listener::listen(std::chrono::seconds timeout, const std::function<bool(const Listener&)>& is_enough) {
  if (!bus_) return false;
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!is_enough(*this)) {
    if (std::chrono::steady_clock::now() >= end) return false;
    if (const auto handled = bus_->handle(100ms); !handled) {
      ADD_FAILURE() << handled.error().text;
      return false;
    }
  }
  return true;
}

}  // namespace stairway::test
