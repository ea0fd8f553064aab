// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "ipc/lcm_bus.hpp"

#include <fmt/format.h>
#include <lcm/lcm.h>

#include <algorithm>
#include <cerrno>
#include <limits>

namespace stairway::ipc {
namespace {

// Of a subscription; LCM drops what comes beyond. Some seconds of scans and angles.
constexpr int kWaitingMessages = 500;

void hand_on(const lcm_recv_buf_t* message, const char* channel, void* handler) {
  const std::span bytes(static_cast<const std::uint8_t*>(message->data), message->data_size);
  (*static_cast<MessageHandler*>(handler))({channel, bytes, message->recv_utime});
}

std::string_view opening_hint(std::string_view url) {
  if (url.starts_with("udpm://")) {
    return "is there a route for multicast? Without a network: "
           "ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo";
  }
  if (url.starts_with("file://")) return "does the log file exist, and may this user open it?";
  if (url.starts_with("tcpq://")) return "is the LCM TCP service running there?";
  return "expected udpm://ADDRESS:PORT?ttl=N, file:///PATH?mode=r|w|a, tcpq://HOST:PORT or memq://";
}

tl::unexpected<BusError> error(BusFault fault, std::string text) {
  return tl::unexpected(BusError{fault, std::move(text)});
}

}  // namespace

std::string_view to_string(BusFault fault) {
  switch (fault) {
    case BusFault::CannotOpen:
      return "cannot-open";
    case BusFault::BadChannel:
      return "bad-channel";
    case BusFault::Io:
      return "io";
    case BusFault::Ended:
      break;
  }
  return "ended";
}

tl::expected<std::unique_ptr<LcmBus>, BusError> LcmBus::open(const std::string& url) {
  _lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) {
    return error(BusFault::CannotOpen, fmt::format("cannot open LCM at '{}': {}", url, opening_hint(url)));
  }
  return std::unique_ptr<LcmBus>(new LcmBus(lcm, url));
}

LcmBus::LcmBus(_lcm_t* lcm, std::string url) : lcm_(lcm), url_(std::move(url)) {}

LcmBus::~LcmBus() { lcm_destroy(lcm_); }

tl::expected<void, BusError> LcmBus::publish(const std::string& channel, std::span<const std::uint8_t> bytes) {
  if (channel.empty() || channel.size() > LCM_MAX_CHANNEL_NAME_LENGTH) {
    return error(BusFault::BadChannel,
                 fmt::format("channel '{}' must have 1 to {} characters", channel, LCM_MAX_CHANNEL_NAME_LENGTH));
  }
  if (lcm_publish(lcm_, channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size())) != 0) {
    return error(BusFault::Io, fmt::format("cannot send {} bytes on {} to {}", bytes.size(), channel, url_));
  }
  return {};
}

tl::expected<void, BusError> LcmBus::subscribe(const std::string& pattern, MessageHandler handler) {
  auto kept = std::make_unique<MessageHandler>(std::move(handler));
  lcm_subscription_t* subscription = lcm_subscribe(lcm_, pattern.c_str(), hand_on, kept.get());
  if (subscription == nullptr) {
    return error(BusFault::BadChannel, fmt::format("cannot subscribe to '{}' on {}", pattern, url_));
  }
  lcm_subscription_set_queue_capacity(subscription, kWaitingMessages);
  handlers_.push_back(std::move(kept));
  return {};
}

tl::expected<bool, BusError> LcmBus::handle(std::chrono::milliseconds timeout) {
  using Milliseconds = std::chrono::milliseconds;
  const Milliseconds bounded = std::clamp(timeout, Milliseconds(0), Milliseconds(std::numeric_limits<int>::max()));
  errno = 0;
  const int handled = lcm_handle_timeout(lcm_, static_cast<int>(bounded.count()));
  if (handled >= 0) return handled > 0;
  if (errno == EINTR) return false;
  if (url_.starts_with("file://")) return error(BusFault::Ended, fmt::format("{} has ended", url_));
  return error(BusFault::Io, fmt::format("cannot receive from {}", url_));
}

}  // namespace stairway::ipc
