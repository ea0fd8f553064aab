// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/utm30lx.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "drivers/ports/open_when_due.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::nanoseconds;

const char* describe(PortError error) { return error == PortError::Closed ? "port closed" : "port failed"; }

}  // namespace

Utm30lx::Utm30lx(PortOpener<BytePort> opener, Clock now, const ScipOptions& options)
    : opener_(std::move(opener)), now_(std::move(now)), session_(options) {}

Utm30lx::~Utm30lx() {
  if (port_) static_cast<void>(port_->write(ScipSession::stop_command()));
}

std::vector<ScipEvent> Utm30lx::poll(nanoseconds timeout) {
  if (!port_) return open(timeout);
  const auto chunk = port_->read(time_until(session_.deadline(), now_(), timeout));
  if (!chunk) {
    port_.reset();
    return session_.on_disconnect(now_(), describe(chunk.error()));
  }
  std::vector<ScipEvent> events;
  if (chunk->lost_bytes > 0) append(events, session_.on_lost_bytes(chunk->lost_bytes));
  append(events, chunk->bytes.empty() ? session_.on_time(chunk->arrival_ns)
                                      : session_.on_bytes(chunk->bytes, chunk->arrival_ns));
  const auto is_reopen = [](const ScipEvent& event) { return std::holds_alternative<ScipReopenEvent>(event); };
  if (std::ranges::any_of(events, is_reopen)) {
    port_.reset();
    return events;
  }
  send_output(events);
  return events;
}

std::vector<ScipEvent> Utm30lx::open(nanoseconds timeout) {
  std::vector<ScipEvent> events = open_when_due(port_, opener_, session_, now_, timeout);
  if (!port_) return events;
  append(events, session_.on_time(now_()));
  send_output(events);
  return events;
}

void Utm30lx::send_output(std::vector<ScipEvent>& events) {
  const std::string output = session_.take_output();
  if (output.empty()) return;
  const auto sent = port_->write(output);
  if (sent) return;
  port_.reset();
  append(events, session_.on_disconnect(now_(), describe(sent.error())));
}

}  // namespace stairway::drivers
