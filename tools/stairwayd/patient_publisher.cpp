// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/patient_publisher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/stairwayd/log.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstPause = 500ms;
constexpr auto kLongestPause = 5000ms;

}  // namespace

PatientPublisher::PatientPublisher(std::string url) : url_(std::move(url)), pause_(kFirstPause) { try_to_open(); }

bool PatientPublisher::publish(const std::string& channel, std::span<const std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  if (!bus_ && !is_closed_ && Clock::now() >= next_attempt_) try_to_open();
  if (!bus_) return false;
  const auto sent = bus_->publish(channel, bytes);
  trouble_ = sent ? "" : sent.error().text;
  if (!sent) log::repeated_warning("publish", sent.error().text);
  return sent.has_value();
}

std::string PatientPublisher::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void PatientPublisher::close() {
  const std::lock_guard lock(mutex_);
  bus_.reset();
  is_closed_ = true;
}

void PatientPublisher::try_to_open() {
  auto bus = ipc::LcmBus::open(url_);
  if (bus) {
    bus_ = std::move(*bus);
    trouble_.clear();
    log::info(fmt::format("sending to {}", url_));
    return;
  }
  trouble_ = bus.error().text;
  log::repeated_warning("open bus", fmt::format("{}; trying again", bus.error().text));
  next_attempt_ = Clock::now() + pause_;
  pause_ = std::min<Clock::duration>(2 * pause_, kLongestPause);
}

}  // namespace stairway::daemon
