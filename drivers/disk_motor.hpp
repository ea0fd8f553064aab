// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/canopen/motor_session.hpp"
#include "drivers/ports/can_port.hpp"
#include "drivers/ports/port_opener.hpp"

namespace stairway::drivers {

/// The disk's CiA 402 drive on a port: opens the port, opens it again after it was lost (0.5 s doubling to 10 s,
/// without end), and moves frames between it and the session. It has no thread; one thread calls everything.
class DiskMotor {
 public:
  /// Time on the line of the port's arrival stamps.
  using Clock = std::function<HostStamp()>;

  /// @pre  options.problem() is empty.
  DiskMotor(PortOpener<CanPort> opener, Clock now, const MotorOptions& options);
  /// stop()
  ~DiskMotor();
  DiskMotor(const DiskMotor&) = delete;
  DiskMotor& operator=(const DiskMotor&) = delete;

  /// Waits at most `timeout` for something to happen and gives what happened, in order; often nothing.
  std::vector<MotorEvent> poll(std::chrono::nanoseconds timeout);

  /// From now on, as soon as the drive is ready; 0 brakes and leaves the drive enabled [rad/s of the disk].
  void set_speed(double speed_rad_s) { session_.set_speed(speed_rad_s); }

  /// Begins the stop sequence of `stop`, in the polls that follow; `start` begins again.
  void rest() { session_.stop(); }

  /// Brakes as fast as the drive can and goes on like `stop`, in the polls that follow; `start` begins again.
  void quick_stop() { session_.quick_stop(); }
  void start() { session_.start(); }

  /// Runs the stop sequence: speed 0, waits for standstill at most `stop_timeout_s`, switches the drive off, leaves it
  /// pre-operational. What happens meanwhile is only counted. Returns early when the bus takes no frames; the drive
  /// then stops by its own heartbeat watch.
  /// @return Whether the drive confirmed standstill.
  bool stop();

  const MotorSession& session() const { return session_; }
  bool is_port_open() const { return port_ != nullptr; }

 private:
  std::vector<MotorEvent> open(std::chrono::nanoseconds timeout);
  void send_output(std::vector<MotorEvent>& events);

  PortOpener<CanPort> opener_;
  Clock now_;
  MotorSession session_;
  std::unique_ptr<CanPort> port_;
};

}  // namespace stairway::drivers
