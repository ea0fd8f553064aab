// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "drivers/canopen/motor_session.hpp"
#include "tools/sim/fake_can_bus.hpp"
#include "tools/sim/fake_drive.hpp"

namespace stairway::drivers {

inline constexpr HostStamp kMs = 1'000'000;
inline constexpr double kSpeed_rad_s = 0.18;

/// A session and the simulated drive on one time.
struct MotorBench {
  explicit MotorBench(const MotorOptions& options = {}, const sim::FakeDriveOptions& drive_options = {})
      : drive(drive_options), session(options) {}

  /// In polls of `poll_ms`, like a thread that has nothing else to do (1) or a slow one (50).
  void run(double seconds) {
    for (const HostStamp end_ns = now_ns + std::llround(seconds * 1e9); now_ns < end_ns; now_ns += poll_ms * kMs)
      poll();
  }

  void poll() {
    auto arrivals = bus.take(now_ns);
    if (!arrivals) {
      take(session.on_disconnect(now_ns, "removed"));
      return;
    }
    take(session.on_arrivals(*arrivals, now_ns));
    for (const CanFrame& frame : session.take_output()) {
      sent.push_back(frame);
      if (!bus.write(frame, now_ns)) {
        take(session.on_unsent(now_ns));
        break;
      }
    }
  }

  /// @return Whether it came to this state within that time.
  bool run_until(MotorState state, double most_s) {
    const HostStamp end_ns = now_ns + std::llround(most_s * 1e9);
    while (session.state() != state && now_ns < end_ns) run(1e-3 * static_cast<double>(poll_ms));
    return session.state() == state;
  }
  bool run_until_speed(double speed_rad_s, double most_s) {
    const HostStamp end_ns = now_ns + std::llround(most_s * 1e9);
    const auto is_there = [&] { return std::abs(drive.disk_speed_rad_s() - speed_rad_s) < 1e-3; };
    while (!is_there() && now_ns < end_ns) run(1e-3 * static_cast<double>(poll_ms));
    return is_there();
  }

  void take(std::vector<MotorEvent> more) { std::ranges::move(more, std::back_inserter(events)); }

  template <typename Event>
  std::vector<Event> all() const {
    std::vector<Event> found;
    for (const MotorEvent& event : events) {
      if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
    }
    return found;
  }
  std::vector<MotorState> states() const {
    std::vector<MotorState> found;
    for (const MotorStateEvent& event : all<MotorStateEvent>()) found.push_back(event.state);
    return found;
  }
  std::uint64_t count(MotorTrouble trouble) const { return session.counters().count(trouble); }
  std::uint64_t all_troubles() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t one : session.counters().troubles) sum += one;
    return sum;
  }
  /// The last detail told of this trouble; empty when none.
  std::string detail(MotorTrouble trouble) const {
    std::string last;
    for (const MotorTroubleEvent& event : all<MotorTroubleEvent>()) {
      if (event.trouble == trouble) last = event.detail;
    }
    return last;
  }

  sim::FakeDrive drive;
  sim::FakeCanBus bus{drive};
  MotorSession session;
  HostStamp now_ns = 0;
  HostStamp poll_ms = 1;
  std::vector<MotorEvent> events;
  std::vector<CanFrame> sent;
};

/// A bench whose disk turns at the wanted speed.
struct RunningBench : MotorBench {
  explicit RunningBench(const MotorOptions& options = {}, const sim::FakeDriveOptions& drive_options = {})
      : MotorBench(options, drive_options) {
    session.set_speed(kSpeed_rad_s);
    run(8.0);
    EXPECT_EQ(session.state(), MotorState::Running);
    EXPECT_EQ(all_troubles(), 0U);
    events.clear();
    sent.clear();
  }
  bool recovers(double most_s) { return run_until(MotorState::Running, most_s) && run_until_speed(kSpeed_rad_s, 2.0); }
};

}  // namespace stairway::drivers
