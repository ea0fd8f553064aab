// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/disk_motor.hpp"

#include <algorithm>
#include <utility>

#include "drivers/ports/open_when_due.hpp"

namespace stairway::drivers {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kStopPoll = std::chrono::milliseconds(20);
constexpr HostStamp kStopMargin_ns = 5'000'000'000;

const char* describe(PortError error) {
  return error == PortError::Closed ? "the CAN interface was removed" : "the CAN interface failed";
}

}  // namespace

DiskMotor::DiskMotor(PortOpener<CanPort> opener, Clock now, const MotorOptions& options)
    : opener_(std::move(opener)), now_(std::move(now)), session_(options) {}

DiskMotor::~DiskMotor() { stop(); }

std::vector<MotorEvent> DiskMotor::poll(nanoseconds timeout) {
  if (!port_) return open(timeout);
  const auto arrivals = port_->read(time_until(session_.deadline(), now_(), timeout));
  if (!arrivals) {
    port_.reset();
    return session_.on_disconnect(now_(), describe(arrivals.error()));
  }
  std::vector<MotorEvent> events = session_.on_arrivals(*arrivals, now_());
  send_output(events);
  return events;
}

std::vector<MotorEvent> DiskMotor::open(nanoseconds timeout) {
  // What the port has to tell about its bus comes before the first frame is sent.
  return open_when_due(port_, opener_, session_, now_, timeout);
}

void DiskMotor::send_output(std::vector<MotorEvent>& events) {
  for (const CanFrame& frame : session_.take_output()) {
    const auto sent = port_->write(frame);
    if (sent) continue;
    if (sent.error() == PortError::Io) return append(events, session_.on_unsent(now_()));
    port_.reset();
    return append(events, session_.on_disconnect(now_(), describe(sent.error())));
  }
}

bool DiskMotor::stop() {
  if (session_.state() != MotorState::Stopped) {
    session_.stop();
    const HostStamp give_up_ns =
        now_() + kStopMargin_ns + static_cast<HostStamp>(1e9 * session_.options().stop_timeout_s);
    while (port_ && session_.state() != MotorState::Stopped && now_() < give_up_ns) poll(kStopPoll);
    if (!port_) session_.on_disconnect(now_(), "there is no bus to stop the drive over");
  }
  return session_.has_seen_standstill();
}

}  // namespace stairway::drivers
