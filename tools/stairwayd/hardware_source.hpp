// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "config/settings.hpp"
#include "drivers/ports/byte_port.hpp"
#include "drivers/ports/can_port.hpp"
#include "drivers/ports/edge_port.hpp"
#include "drivers/ports/port_opener.hpp"
#include "tools/stairwayd/dead_man.hpp"
#include "tools/stairwayd/device_queue.hpp"
#include "tools/stairwayd/device_watch.hpp"
#include "tools/stairwayd/measurement_source.hpp"

namespace stairway::daemon {

/// Where the devices are found, and the clock of their stamps; each opener and the clock are used by one thread at a
/// time, the clock by several.
struct DevicePorts {
  drivers::PortOpener<drivers::BytePort> scanner;
  drivers::PortOpener<drivers::CanPort> motor;
  drivers::PortOpener<drivers::EdgePort> encoder;
  std::optional<drivers::PortOpener<drivers::EdgePort>> sync;  ///< the scanner's sync pulses, as line A
  std::function<drivers::HostStamp()> now_ns;
};

/// The devices of this machine as the settings name them, on CLOCK_MONOTONIC. Nothing is opened yet.
DevicePorts hardware_ports(const config::Settings& settings);

/// Scanner, motor and encoder, each with a thread of its own (named scanner, motor, encoder) that waits for its device
/// and for nothing else. The disk brakes while read() does not return for DeadMan::kPatience_ns, and turns again when
/// it does.
class HardwareSource final : public MeasurementSource {
 public:
  using Utime = std::function<std::int64_t(drivers::HostStamp)>;

  /// Starts the threads. The disk turns when read() has learnt that the devices are ready.
  /// @param utime_us  as MeasurementSource::utime_us.
  /// @pre  settings.problem() is empty.
  HardwareSource(const config::Settings& settings, DevicePorts ports, Utime utime_us);
  ~HardwareSource() override;

  std::vector<SourceEvent> read(std::chrono::milliseconds timeout) override;
  std::string order(const DiskOrder& order) override;
  void stop() override;
  std::int64_t utime_us(drivers::HostStamp stamp_ns) const override { return utime_us_(stamp_ns); }

 private:
  void run_scanner(std::stop_token stop, drivers::PortOpener<drivers::BytePort> opener,
                   std::optional<drivers::PortOpener<drivers::EdgePort>> sync);
  void run_motor(std::stop_token stop, drivers::PortOpener<drivers::CanPort> opener);
  void run_encoder(std::stop_token stop, drivers::PortOpener<drivers::EdgePort> opener);
  double allowed_speed_rad_s(bool& is_braking);
  template <class Event>
  void push(std::vector<Event> events);

  const config::Settings settings_;
  const std::function<drivers::HostStamp()> now_ns_;
  const Utime utime_us_;
  DeviceQueue queue_;
  DeviceWatch watch_;
  DeadMan dead_man_;
  std::atomic<double> wanted_speed_rad_s_ = 0.0;
  std::atomic<MotorWish> motor_wish_;

  // The motor's ends first.
  std::jthread encoder_;
  std::jthread scanner_;
  std::jthread motor_;
};

/// Converts stamps of CLOCK_MONOTONIC by the clocks' difference at the call.
std::int64_t utime_of_monotonic_us(drivers::HostStamp stamp_ns);

}  // namespace stairway::daemon
