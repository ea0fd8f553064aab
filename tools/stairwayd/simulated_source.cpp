// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/simulated_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tools/sim/scene.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/stairwayd/raw_tap.hpp"

namespace stairway::daemon {
namespace {

using std::chrono::nanoseconds;

// Of simulated time; the drive and the encoder are read after it.
constexpr std::chrono::duration<double> kLongestStep{0.05};
// While the drive is set up: a step is a question and its answer.
constexpr std::chrono::duration<double> kSetUpStep{0.002};
constexpr drivers::HostStamp kClockReport_ns = 1'000'000'000;
// Between the index and the disk's place when it has reached its speed.
constexpr double kIndexMargin_rad = 0.1;

// Before the index by what the disk turns until it has its speed.
double start_angle_rad(const config::Settings& settings) {
  const drivers::DiskOptions& disk = settings.disk;
  const double speed_rad_s = disk.speed_rad_s();
  const double check_rad_s = std::min(disk.check_speed_rad_s, std::abs(speed_rad_s));
  const double ramp_rad = speed_rad_s * speed_rad_s / (2.0 * settings.motor.acceleration_rad_s2);
  const double check_rad =
      check_rad_s * (disk.settle_s + disk.check_window_s + 2.0 * check_rad_s / settings.motor.acceleration_rad_s2);
  return -std::copysign(std::min(ramp_rad + check_rad + kIndexMargin_rad, std::numbers::pi), speed_rad_s);
}

template <class Device>
void take_all(Device& device, nanoseconds timeout, const sim::SimulatedRobot& robot, DeviceWatch& watch) {
  for (auto& event : device.poll(timeout)) watch.take(std::move(event), robot.now_ns());
}

}  // namespace

sim::SimulatedRobotOptions simulated_robot_options(const config::Settings& settings) {
  sim::SimulatedRobotOptions options;
  options.mount = settings.mount;
  options.drive.node_id = settings.motor.node_id;
  options.drive.counts_per_turn = settings.motor.counts_per_turn;
  options.drive.velocity_units_per_turn_per_s = settings.motor.velocity_units_per_turn_per_s;
  options.drive.acceleration_units_per_turn_per_s2 = settings.motor.acceleration_units_per_turn_per_s2;
  options.drive.reverse = settings.motor.reverse;
  options.encoder_counts_per_turn = settings.encoder.counts_per_turn;
  options.start_angle_rad = start_angle_rad(settings);
  options.speed_factor = settings.simulate.speed;
  options.seed = static_cast<std::uint64_t>(settings.simulate.seed);
  options.sensor.seed = options.seed;
  return options;
}

SimulatedSource::SimulatedSource(const config::Settings& settings, std::int64_t start_utime_us)
    : start_utime_us_(start_utime_us),
      speed_(settings.simulate.speed),
      has_encoder_(settings.disk.angle_source == drivers::AngleSource::Encoder),
      robot_(sim::build_scene(sim::load_scene(settings.simulate.scene)), simulated_robot_options(settings)),
      watch_(settings) {
  const auto now_ns = [this] { return robot_.now_ns(); };
  if (has_encoder_) encoder_.emplace(robot_.encoder(), now_ns, settings.encoder);
  auto scanner = robot_.scanner();
  if (is_raw_wanted(settings))
    scanner = with_raw_tap(std::move(scanner), now_ns, [this](RawBytes bytes) { watch_.take(std::move(bytes)); });
  scanner_.emplace(std::move(scanner), now_ns, settings.lidar);
  motor_.emplace(robot_.motor(), now_ns, settings.motor);
}

std::vector<SourceEvent> SimulatedSource::read(std::chrono::milliseconds timeout) {
  // The simulation's waits are in its own time.
  const std::chrono::duration<double> limit = timeout * speed_;
  const drivers::MotorState motor = motor_->session().state();
  const bool is_settled = motor == drivers::MotorState::Running || motor == drivers::MotorState::Stopped;
  const auto longest = is_settled ? kLongestStep : kSetUpStep;
  const auto step = std::chrono::ceil<nanoseconds>(speed_ > 0.0 ? std::min(limit, longest) : longest);
  auto scanner_events = scanner_->poll(step);

  motor_rest_.follow(watch_.motor_wish(), *motor_);
  motor_->set_speed(watch_.wanted_speed_rad_s());
  take_all(*motor_, nanoseconds::zero(), robot_, watch_);
  if (encoder_) take_all(*encoder_, nanoseconds::zero(), robot_, watch_);
  // After the angles, which a scan waits for.
  for (auto& event : scanner_events) watch_.take(std::move(event), robot_.now_ns());
  const drivers::HostStamp now_ns = robot_.now_ns();
  if (now_ns >= next_clock_report_ns_ && scanner_->session().state() == drivers::ScipState::Streaming) {
    next_clock_report_ns_ = now_ns + kClockReport_ns;
    watch_.take(scanner_->session().clock_quality());
  }
  watch_.pass_time(now_ns);
  return watch_.take_events();
}

std::string SimulatedSource::order(const DiskOrder& order) {
  watch_.order(order, robot_.now_ns());
  return {};
}

void SimulatedSource::stop() {
  motor_.reset();
  scanner_.reset();
  encoder_.reset();
}

std::int64_t SimulatedSource::utime_us(drivers::HostStamp stamp_ns) const { return start_utime_us_ + stamp_ns / 1000; }

}  // namespace stairway::daemon
