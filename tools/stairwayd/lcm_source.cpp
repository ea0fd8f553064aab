// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/lcm_source.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kWaitingMessages = 400;  // some seconds
constexpr auto kSilence = 2s;

}  // namespace

LcmSource::LcmSource(const ipc::BusOptions& bus)
    : url_(bus.url),
      stream_(ipc::Channels(bus.channel_prefix), std::nullopt),
      lines_{Line{Device::Scanner, ipc::Channels(bus.channel_prefix).scan},
             Line{Device::Encoder, ipc::Channels(bus.channel_prefix).angles}},
      messages_(kWaitingMessages) {
  const auto keep = [this](const ipc::BusMessage& message) {
    if (!messages_.push({std::string(message.channel), {message.bytes.begin(), message.bytes.end()}})) ++dropped_;
  };
  listener_.emplace(url_, std::vector{lines_[0].channel, lines_[1].channel}, keep);
}

std::vector<SourceEvent> LcmSource::read(std::chrono::milliseconds timeout) {
  std::vector<SourceEvent> events;
  // One at a time: utime_us() is that of the message taken last.
  auto measurement = stream_.next();
  if (!measurement) {
    if (const auto message = messages_.pop_within(timeout)) take(*message, events);
    measurement = stream_.next();
  }
  for (Line& line : lines_) watch(line, Clock::now(), events);
  report_damage(events);
  if (measurement) std::visit([&](auto& what) { events.emplace_back(std::move(what)); }, *measurement);
  return events;
}

void LcmSource::take(const Message& message, std::vector<SourceEvent>& events) {
  stream_.take(message.channel, message.bytes);
  for (Line& line : lines_) {
    if (line.channel != message.channel) continue;
    line.last = Clock::now();
    events.emplace_back(SourceSign{line.device, 1});
  }
}

void LcmSource::watch(Line& line, Clock::time_point now, std::vector<SourceEvent>& events) {
  const std::string where = fmt::format("{} at {}", line.channel, url_);
  if (!line.last) return tell(line, Condition::Starting, "waiting for " + where, events);
  if (now - *line.last < kSilence) return tell(line, Condition::Good, "heard on " + where, events);
  tell(line, Condition::Failed, fmt::format("nothing more comes on {}: does its sender still run?", where), events);
}

void LcmSource::tell(Line& line, Condition condition, std::string text, std::vector<SourceEvent>& events) {
  if (std::exchange(line.told, condition) == condition) return;
  if (condition == Condition::Failed)
    events.emplace_back(SourceTrouble{line.device, fmt::format("{}: silence", to_string(line.device)), text});
  const char* reason = condition == Condition::Good ? "" : condition == Condition::Failed ? "silence" : "starting";
  events.emplace_back(SourceState{line.device, condition, std::move(text), 0, reason});
}

void LcmSource::report_damage(std::vector<SourceEvent>& events) {
  if (const std::uint64_t dropped = dropped_.exchange(0); dropped > 0)
    events.emplace_back(SourceTrouble{std::nullopt, "measurements dropped",
                                      fmt::format("{}: this computer is too slow or was held up", dropped)});
  const std::uint64_t undecodable = stream_.undecodable_messages(), restarts = stream_.restarts();
  if (std::exchange(told_undecodable_, undecodable) != undecodable)
    events.emplace_back(SourceTrouble{std::nullopt, "damaged measurements",
                                      "a message cannot be decoded: is its sender of another version?"});
  if (std::exchange(told_restarts_, restarts) != restarts)
    events.emplace_back(SourceTrouble{std::nullopt, "sender began anew",
                                      "times went back: it was restarted, or there are two of them"});
}

}  // namespace stairway::daemon
