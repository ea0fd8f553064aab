// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairwayd/simulated_source.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "tools/sim/scene.hpp"
#include "tools/sim/scene_file.hpp"
#include "tools/stairwayd/scanner_events.hpp"

namespace stairway::daemon {
namespace {

// Less than the lead of 0.1 s that the simulation allows its scanner before its encoder.
constexpr std::chrono::duration<double> kLongestStep{0.05};

sim::SimulatedRobotOptions robot_options(const config::Settings& settings) {
  sim::SimulatedRobotOptions options;
  options.mount = settings.mount;
  options.disk_speed_rad_s = 0.0;
  options.speed_factor = settings.simulate.speed;
  options.seed = static_cast<std::uint64_t>(settings.simulate.seed);
  options.sensor.seed = options.seed;
  return options;
}

bool is_streaming(const drivers::ScipEvent& event) {
  const auto* change = std::get_if<drivers::ScipStateEvent>(&event);
  return change != nullptr && change->state == drivers::ScipState::Streaming;
}

}  // namespace

SimulatedSource::SimulatedSource(const config::Settings& settings, std::int64_t start_utime_us)
    : start_utime_us_(start_utime_us),
      speed_(settings.simulate.speed),
      disk_speed_rad_s_(2.0 * std::numbers::pi / settings.disk.period_s),
      robot_(sim::build_scene(sim::load_scene(settings.simulate.scene)), robot_options(settings)),
      encoder_(robot_.open_encoder()) {
  scanner_.emplace(
      drivers::PortOpener<drivers::BytePort>{[this] { return robot_.open_scanner(); }},
      [this] { return robot_.now_ns(); }, settings.lidar);
}

std::vector<SourceEvent> SimulatedSource::read(std::chrono::milliseconds timeout) {
  // The simulation's waits are in its own time.
  const std::chrono::duration<double> limit = timeout * speed_;
  const auto step =
      std::chrono::ceil<std::chrono::nanoseconds>(speed_ > 0.0 ? std::min(limit, kLongestStep) : kLongestStep);
  std::vector<drivers::ScipEvent> scanner_events = scanner_->poll(step);

  std::vector<SourceEvent> events;
  auto samples = encoder_->read(std::chrono::nanoseconds::zero());
  if (samples && !samples->empty()) events.emplace_back(std::move(*samples));
  for (drivers::ScipEvent& event : scanner_events) {
    if (is_streaming(event)) robot_.set_disk_speed(disk_speed_rad_s_);
    if (auto translated = to_source_event(std::move(event))) events.push_back(std::move(*translated));
  }
  return events;
}

void SimulatedSource::stop() {
  robot_.set_disk_speed(0.0);
  scanner_.reset();
  encoder_.reset();
}

std::int64_t SimulatedSource::utime_us(drivers::HostStamp stamp_ns) const { return start_utime_us_ + stamp_ns / 1000; }

}  // namespace stairway::daemon
