// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/device_queue.hpp"

#include <algorithm>
#include <utility>

namespace stairway::daemon {
namespace {

template <class Measurement, class Event>
bool holds(const DeviceNews& news) {
  const auto* event = std::get_if<Event>(&news.what);
  return event != nullptr && std::holds_alternative<Measurement>(*event);
}

bool is_measurement(const DeviceNews& news) {
  return holds<drivers::LaserScan, drivers::ScipEvent>(news) ||
         holds<drivers::DriveFeedback, drivers::MotorEvent>(news) ||
         holds<std::vector<drivers::AngleSample>, drivers::EncoderEvent>(news) ||
         std::holds_alternative<RawBytes>(news.what);
}

}  // namespace

void DeviceQueue::push(DeviceNews news) {
  {
    const std::lock_guard lock(mutex_);
    if (news_.size() >= capacity_) drop_one();
    news_.push_back(std::move(news));
  }
  arrived_.notify_one();
}

std::deque<DeviceNews> DeviceQueue::take(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, timeout, [this] { return !news_.empty(); });
  return std::exchange(news_, {});
}

std::uint64_t DeviceQueue::take_dropped() {
  const std::lock_guard lock(mutex_);
  return std::exchange(dropped_, 0);
}

void DeviceQueue::drop_one() {
  const auto oldest = std::ranges::find_if(news_, is_measurement);
  news_.erase(oldest == news_.end() ? news_.begin() : oldest);
  ++dropped_;
}

}  // namespace stairway::daemon
