// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/bus_listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "ipc/lcm_bus.hpp"
#include "tools/stairwayd/log.hpp"
#include "tools/stairwayd/pause.hpp"
#include "tools/stairwayd/this_thread.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

constexpr milliseconds kFirstPause = 500ms;
constexpr milliseconds kLongestPause = 5000ms;
constexpr milliseconds kWait = 100ms;  // how late a stop is noticed

}  // namespace

BusListener::BusListener(std::string url, std::vector<std::string> channels, ipc::MessageHandler handler)
    : url_(std::move(url)),
      channels_(std::move(channels)),
      handler_(std::move(handler)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void BusListener::run(const std::stop_token& stop) {
  name_this_thread("listener");
  for (milliseconds wait = kFirstPause; !stop.stop_requested(); wait = std::min(2 * wait, kLongestPause)) {
    listen(stop);
    pause_until(std::chrono::steady_clock::now() + wait, stop);
  }
}

void BusListener::listen(const std::stop_token& stop) {
  const auto complain = [](const ipc::BusError& error) {
    log::repeated_warning("listen", fmt::format("{}; trying again", error.text));
  };
  const auto bus = ipc::LcmBus::open(url_);
  if (!bus) return complain(bus.error());
  for (const std::string& channel : channels_) {
    if (const auto subscribed = (*bus)->subscribe(channel, handler_); !subscribed) return complain(subscribed.error());
  }
  log::debug(fmt::format("listening to {} at {}", fmt::join(channels_, ", "), url_));
  while (!stop.stop_requested()) {
    if (const auto handled = (*bus)->handle(kWait); !handled) return complain(handled.error());
  }
}

}  // namespace stairway::daemon
