// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/hardware_source.hpp"

#include <fmt/format.h>

#include <type_traits>
#include <utility>
#include <variant>

#include "drivers/disk_encoder.hpp"
#include "drivers/disk_motor.hpp"
#include "drivers/host_clock.hpp"
#include "drivers/utm30lx.hpp"
#include "tools/stairwayd/log.hpp"
#include "tools/stairwayd/motor_rest.hpp"
#include "tools/stairwayd/raw_tap.hpp"
#include "tools/stairwayd/sync_pulse_reader.hpp"
#include "tools/stairwayd/this_thread.hpp"

namespace stairway::daemon {
namespace {

using namespace std::chrono_literals;
using drivers::HostStamp;

// Some seconds of all devices together.
constexpr std::size_t kWaitingNews = 2000;
// How late a stop or a new speed is noticed.
constexpr auto kScannerPoll = 100ms;
constexpr auto kMotorPoll = 20ms;
constexpr auto kEncoderPoll = 50ms;
constexpr HostStamp kClockReport_ns = 1'000'000'000;

}  // namespace

std::int64_t utime_of_monotonic_us(HostStamp stamp_ns) {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t now_us = std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count();
  return now_us - (drivers::monotonic_now_ns() - stamp_ns) / 1000;
}

HardwareSource::HardwareSource(const config::Settings& settings, DevicePorts ports, Utime utime_us)
    : settings_(settings),
      now_ns_(std::move(ports.now_ns)),
      utime_us_(std::move(utime_us)),
      queue_(kWaitingNews),
      watch_(settings),
      dead_man_(now_ns_()),
      motor_wish_(watch_.motor_wish()) {
  if (settings_.disk.angle_source == drivers::AngleSource::Encoder) {
    encoder_ = std::jthread([this, opener = std::move(ports.encoder)](std::stop_token stop) mutable {
      run_encoder(std::move(stop), std::move(opener));
    });
  }
  scanner_ = std::jthread(
      [this, opener = std::move(ports.scanner), sync = std::move(ports.sync)](std::stop_token stop) mutable {
        run_scanner(std::move(stop), std::move(opener), std::move(sync));
      });
  motor_ = std::jthread([this, opener = std::move(ports.motor)](std::stop_token stop) mutable {
    run_motor(std::move(stop), std::move(opener));
  });
}

HardwareSource::~HardwareSource() { stop(); }

std::vector<SourceEvent> HardwareSource::read(std::chrono::milliseconds timeout) {
  for (DeviceNews& news : queue_.take(timeout)) {
    std::visit(
        [&](auto& event) {
          if constexpr (std::is_same_v<decltype(event), drivers::ClockQuality&> ||
                        std::is_same_v<decltype(event), RawBytes&>) {
            watch_.take(std::move(event));
          } else {
            watch_.take(std::move(event), news.stamp_ns);
          }
        },
        news.what);
  }
  const HostStamp now_ns = now_ns_();
  const bool was_braked = dead_man_.was_missed();
  if (was_braked) watch_.expect_ramp(now_ns);
  watch_.pass_time(now_ns);
  motor_wish_ = watch_.motor_wish();
  wanted_speed_rad_s_ = watch_.wanted_speed_rad_s();
  dead_man_.note(now_ns);
  std::vector<SourceEvent> events = watch_.take_events();
  if (was_braked)
    events.emplace_back(SourceTrouble{std::nullopt, "acquisition held up", "the disk was braked meanwhile"});
  if (const std::uint64_t dropped = queue_.take_dropped(); dropped > 0)
    events.emplace_back(SourceTrouble{std::nullopt, "measurements dropped",
                                      fmt::format("{}: this computer is too slow or was held up", dropped)});
  return events;
}

std::string HardwareSource::order(const DiskOrder& order) {
  watch_.order(order, now_ns_());
  motor_wish_ = watch_.motor_wish();
  wanted_speed_rad_s_ = watch_.wanted_speed_rad_s();
  return {};
}

void HardwareSource::stop() {
  for (std::jthread* thread : {&motor_, &scanner_, &encoder_}) {
    if (!thread->joinable()) continue;
    thread->request_stop();
    thread->join();
  }
}

void HardwareSource::run_scanner(std::stop_token stop, drivers::PortOpener<drivers::BytePort> opener,
                                 std::optional<drivers::PortOpener<drivers::EdgePort>> sync) {
  name_this_thread("scanner");
  if (is_raw_wanted(settings_)) {
    opener = with_raw_tap(std::move(opener), now_ns_, [this](RawBytes bytes) {
      queue_.push({bytes.stamp_ns, std::move(bytes)});
    });
  }
  drivers::Utm30lx* told = nullptr;
  if (sync) {
    const auto tell = [&told](HostStamp pulse_ns) { told->on_sync_pulse(pulse_ns); };
    const auto complain = [](const std::string& problem) { log::repeated_warning("sync pulses", problem); };
    opener = with_sync_pulses(std::move(opener),
                              std::make_shared<SyncPulseReader>(std::move(*sync), now_ns_, tell, complain));
  }
  drivers::Utm30lx scanner(std::move(opener), now_ns_, settings_.lidar);
  told = &scanner;
  HostStamp next_report_ns = 0;
  while (!stop.stop_requested()) {
    push(scanner.poll(kScannerPoll));
    if (now_ns_() < next_report_ns || scanner.session().state() != drivers::ScipState::Streaming) continue;
    next_report_ns = now_ns_() + kClockReport_ns;
    queue_.push({now_ns_(), scanner.session().clock_quality()});
  }
}

void HardwareSource::run_motor(std::stop_token stop, drivers::PortOpener<drivers::CanPort> opener) {
  name_this_thread("motor");
  drivers::DiskMotor motor(std::move(opener), now_ns_, settings_.motor);
  MotorRest rest;
  bool is_braking = false;
  while (!stop.stop_requested()) {
    rest.follow(motor_wish_, motor);
    motor.set_speed(allowed_speed_rad_s(is_braking));
    push(motor.poll(kMotorPoll));
  }
  motor.stop();
}

double HardwareSource::allowed_speed_rad_s(bool& is_braking) {
  const double wanted_rad_s = wanted_speed_rad_s_;
  const bool was_braking = std::exchange(is_braking, wanted_rad_s != 0.0 && dead_man_.is_missed(now_ns_()));
  // Who should report it is the one that hangs.
  if (is_braking && !was_braking) log::warning("measurements have not been read for 2 s: the disk brakes");
  return is_braking ? 0.0 : wanted_rad_s;
}

void HardwareSource::run_encoder(std::stop_token stop, drivers::PortOpener<drivers::EdgePort> opener) {
  name_this_thread("encoder");
  drivers::DiskEncoder encoder(std::move(opener), now_ns_, settings_.encoder);
  while (!stop.stop_requested()) push(encoder.poll(kEncoderPoll));
}

template <class Event>
void HardwareSource::push(std::vector<Event> events) {
  for (Event& event : events) queue_.push({now_ns_(), std::move(event)});
}

}  // namespace stairway::daemon
