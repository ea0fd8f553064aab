// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/fake_can_bus.hpp"

#include <algorithm>
#include <utility>

namespace stairway::sim {
namespace {

using drivers::CanArrival;
using drivers::CanCondition;
using drivers::CanFrame;
using drivers::HostStamp;
using drivers::PortError;

constexpr std::size_t kMostArrivals = 1000;

}  // namespace

tl::expected<void, PortError> FakeCanBus::write(const CanFrame& frame, HostStamp now_ns) {
  advance(now_ns);
  if (is_removed_) return tl::unexpected(PortError::Closed);
  if (!is_connected()) return tl::unexpected(PortError::Io);
  drive_.receive(frame, now_ns);
  return {};
}

void FakeCanBus::advance(HostStamp now_ns) {
  drive_.advance(now_ns);
  while (auto sent = drive_.take(now_ns)) {
    if (!is_connected()) continue;
    if (arrivals_.size() < kMostArrivals) {
      arrivals_.push_back({sent->first, sent->second});
    } else {
      has_overrun_ = true;
    }
  }
}

tl::expected<std::vector<CanArrival>, PortError> FakeCanBus::take(HostStamp now_ns) {
  advance(now_ns);
  if (is_removed_) {
    arrivals_.clear();
    return tl::unexpected(PortError::Closed);
  }
  auto arrivals = std::exchange(arrivals_, {});
  if (std::exchange(has_overrun_, false)) arrivals.push_back({now_ns, CanCondition::Overrun});
  return arrivals;
}

HostStamp FakeCanBus::next_due_ns() const {
  return arrivals_.empty() ? drive_.next_due_ns() : std::min(drive_.next_due_ns(), arrivals_.front().arrival_ns);
}

void FakeCanBus::set_link(bool is_up, HostStamp now_ns) {
  advance(now_ns);
  is_up_ = is_up;
  add_condition(is_up ? CanCondition::LinkUp : CanCondition::LinkDown, now_ns);
}

void FakeCanBus::set_bus_off(bool is_off, HostStamp now_ns) {
  advance(now_ns);
  is_bus_off_ = is_off;
  add_condition(is_off ? CanCondition::BusOff : CanCondition::Restarted, now_ns);
}

void FakeCanBus::set_unheard(bool is_unheard, HostStamp now_ns) {
  advance(now_ns);
  is_unheard_ = is_unheard;
  add_condition(is_unheard ? CanCondition::Unheard : CanCondition::Active, now_ns);
}

void FakeCanBus::add_frame(const CanFrame& frame, HostStamp now_ns) {
  advance(now_ns);
  if (is_connected()) arrivals_.push_back({now_ns, frame});
  drive_.receive(frame, now_ns);
}

void FakeCanBus::add_condition(CanCondition condition, HostStamp now_ns) { arrivals_.push_back({now_ns, condition}); }

}  // namespace stairway::sim
