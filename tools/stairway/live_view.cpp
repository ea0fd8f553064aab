// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/live_view.hpp"

#include <fmt/format.h>

#include <utility>

#include "ipc/message_codec.hpp"
#include "tools/stairway/daemon_news.hpp"

namespace stairway::tools {
namespace {

using namespace std::chrono_literals;

constexpr auto kRedraw = 1s;  // the ages go on without messages

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

std::string time_of_day() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return local_time(std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count());
}

}  // namespace

LiveView::LiveView(ipc::Channels channels, std::string place) : channels_(std::move(channels)) {
  view_.place = std::move(place);
}

void LiveView::take(const ipc::BusMessage& message) {
  const auto note_damage = [&](ipc::MessageFault fault) {
    tell(fmt::format("a message on {} cannot be decoded: {}", message.channel, to_string(fault)));
  };
  if (message.channel == channels_.health) {
    auto decoded = ipc::decode<ipc::HealthMessage>(message.bytes);
    if (!decoded) return note_damage(decoded.error());
    view_.health = std::move(*decoded);
    view_.note.clear();
    health_came_ = Clock::now();
  } else if (message.channel == channels_.stairways) {
    auto decoded = ipc::decode<ipc::StairwaysMessage>(message.bytes);
    if (!decoded) return note_damage(decoded.error());
    view_.answer = std::move(*decoded);
    answer_came_ = Clock::now();
  }
  is_news_ = true;
}

void LiveView::tell(const std::string& trouble) {
  view_.note = trouble;
  is_news_ = true;
}

void LiveView::refresh() {
  const bool is_resized = screen_.has_resized();
  if (!is_news_ && !is_resized && Clock::now() < next_drawing_) return;
  view_.time = time_of_day();
  view_.health_age_s = seconds_since(health_came_);
  view_.answer_age_s = seconds_since(answer_came_);
  screen_.show(monitor_lines(view_, screen_.columns(), screen_.rows()));
  next_drawing_ = Clock::now() + kRedraw;
  is_news_ = false;
}

}  // namespace stairway::tools
