// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/news.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "ipc/channels.hpp"
#include "ipc/message_codec.hpp"

namespace stairway::bench {

using namespace std::chrono_literals;

News::News() {
  auto bus = ipc::LcmBus::open(ipc::BusOptions{}.url + "&recv_buf_size=4194304");
  if (!bus) throw std::runtime_error(bus.error().text);
  bus_ = std::move(*bus);
  const ipc::Channels channels;
  subscribe(channels.health, &News::take_health);
  subscribe(channels.stairways, &News::take_answer);
  subscribe(channels.disk, &News::take_disk);
  subscribe(channels.scan, &News::take_scan);
  thread_ = std::jthread([this](std::stop_token stop) {
    while (!stop.stop_requested() && bus_->handle(100ms)) {
    }
  });
}

template <class Message>
void News::subscribe(const std::string& channel, void (News::*take)(const Message&)) {
  const auto subscribed = bus_->subscribe(channel, [this, channel, take](const ipc::BusMessage& message) {
    const auto decoded = ipc::decode<Message>(message.bytes);
    {
      const std::lock_guard lock(mutex_);
      if (decoded) {
        (this->*take)(*decoded);
      } else {
        heard_.damage += channel + ": " + std::string(ipc::to_string(decoded.error())) + "; ";
      }
    }
    changed_.notify_all();
  });
  if (!subscribed) throw std::runtime_error(subscribed.error().text);
}

void News::take_health(const ipc::HealthMessage& message) {
  heard_.health = message;
  ++heard_.healths;
}

void News::take_answer(const ipc::StairwaysMessage& message) {
  if (!message.is_final) return;
  heard_.answer = message;
  ++heard_.answers;
}

void News::take_disk(const ipc::DiskMessage& message) { heard_.disk = message; }

void News::take_scan(const ipc::ScanMessage& message) {
  const auto sequence = static_cast<std::int64_t>(message.scan.sequence);
  if (heard_.scans > 0 && sequence > heard_.last_sequence) heard_.missing_scans += sequence - heard_.last_sequence - 1;
  heard_.last_sequence = sequence;
  ++heard_.scans;
}

Heard News::heard() const {
  const std::lock_guard lock(mutex_);
  return heard_;
}

void News::clear() {
  const std::lock_guard lock(mutex_);
  heard_ = {};
}

bool News::wait(std::chrono::seconds timeout, const std::function<bool(const Heard&)>& is_enough) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return is_enough(heard_); });
}

}  // namespace stairway::bench
