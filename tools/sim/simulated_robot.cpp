// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/simulated_robot.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tools/sim/disk_motion.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;
using RealClock = std::chrono::steady_clock;

constexpr HostStamp kLead_ns = 100'000'000;        // of the scanner before the encoder
constexpr HostStamp kMaxCatchUp_ns = 500'000'000;  // of the encoder in one read

ScannerModel make_model(const Scene& scene, const SimulatedRobotOptions& options) {
  if (const std::string problem = options.problem(); !problem.empty()) throw std::invalid_argument{"robot: " + problem};
  return ScannerModel{scene.mesh, scan::make_calibration(options.mount), options.scanner, options.seed};
}

}  // namespace

std::string SimulatedRobotOptions::problem() const {
  if (auto text = mount.problem(); !text.empty()) return "mount: " + text;
  if (auto text = scanner.problem(); !text.empty()) return "scanner: " + text;
  if (auto text = sensor.problem(); !text.empty()) return "sensor: " + text;
  if (!(std::abs(disk_speed_rad_s) <= 100)) return "disk speed must lie within 100 rad/s";
  if (!(std::abs(start_angle_rad) <= 1000)) return "start angle must lie within 1000 rad";
  if (encoder_counts_per_turn < 4 || encoder_counts_per_turn > 1000000)
    return "encoder counts must lie within 4 .. 1000000";
  if (!(speed_factor >= 0 && speed_factor <= 1000)) return "speed factor must lie within 0 .. 1000";
  return {};
}

// Everything behind one lock: the sensor, the disk, the encoder and the clock.
class SimulatedRobot::World {
 public:
  World(const Scene& scene, const SimulatedRobotOptions& options)
      : speed_factor_{options.speed_factor},
        turn_period_ns_{std::llround(1e9 * options.sensor.turn_period_s)},
        model_{make_model(scene, options)},
        disk_{options.sensor.start_ns, options.start_angle_rad, options.disk_speed_rad_s},
        encoder_{disk_, options.sensor.start_ns, options.encoder_counts_per_turn},
        sensor_{options.sensor,
                [this](std::uint64_t turn, HostStamp start_ns, std::span<std::uint32_t> values) {
                  model_.measure_turn(turn, disk_.angle_at(start_ns), disk_.angle_at(start_ns + turn_period_ns_),
                                      values);
                }},
        start_ns_{options.sensor.start_ns},
        now_ns_{start_ns_},
        encoder_read_ns_{start_ns_} {}

  HostStamp now_ns() const {
    const std::lock_guard lock{mutex_};
    return time_ns();
  }
  void set_disk_speed(double speed_rad_s) {
    const std::lock_guard lock{mutex_};
    disk_.set_speed(time_ns(), speed_rad_s);
  }
  double disk_speed_rad_s() const {
    const std::lock_guard lock{mutex_};
    return disk_.speed_at(time_ns());
  }
  double disk_angle_rad() const {
    const std::lock_guard lock{mutex_};
    return disk_.angle_at(time_ns());
  }

  void count_scanners(int change) {
    const std::lock_guard lock{mutex_};
    open_scanners_ += change;
    moved_.notify_all();
  }
  void count_encoders(int change) {
    const std::lock_guard lock{mutex_};
    if (open_encoders_ == 0) encoder_read_ns_ = time_ns();
    open_encoders_ += change;
    moved_.notify_all();
  }

  void write(std::string_view bytes) {
    const std::lock_guard lock{mutex_};
    sensor_.receive(bytes, time_ns());
  }

  drivers::ByteChunk read_scanner(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    const auto give_up = RealClock::now() + timeout;
    const HostStamp end_ns = time_ns() + timeout.count();
    for (;;) {
      const HostStamp target_ns = std::min(sensor_.next_due_ns(), end_ns);
      move_time(target_ns);
      if (auto chunk = sensor_.take(time_ns())) return std::move(*chunk);
      if (time_ns() >= end_ns) return {time_ns(), {}};
      if (time_ns() < target_ns && !wait(lock, target_ns, give_up)) return {time_ns(), {}};
    }
  }

  std::vector<drivers::AngleSample> read_encoder(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    const auto give_up = RealClock::now() + timeout;
    const HostStamp end_ns = time_ns() + timeout.count();
    for (;;) {
      const HostStamp target_ns = std::min(encoder_.next_sample_ns(disk_), end_ns);
      if (open_scanners_ == 0) move_time(target_ns);
      const HostStamp until_ns = std::min(time_ns(), encoder_read_ns_ + kMaxCatchUp_ns);
      auto samples = encoder_.samples_until(disk_, until_ns);
      encoder_read_ns_ = until_ns;
      moved_.notify_all();
      if (!samples.empty() || time_ns() >= end_ns || !wait(lock, target_ns, give_up)) return samples;
    }
  }

 private:
  HostStamp time_ns() const {
    if (speed_factor_ == 0) return now_ns_;
    const std::chrono::duration<double, std::nano> real = RealClock::now() - real_start_;
    return start_ns_ + std::llround(speed_factor_ * real.count());
  }

  // Without a speed factor, time goes where its reader wants, as far as the other reader is.
  void move_time(HostStamp target_ns) {
    if (speed_factor_ != 0) return;
    if (open_encoders_ > 0 && open_scanners_ > 0) target_ns = std::min(target_ns, encoder_read_ns_ + kLead_ns);
    if (target_ns <= now_ns_) return;
    now_ns_ = target_ns;
    moved_.notify_all();
  }

  // False when the wait is over for good.
  bool wait(std::unique_lock<std::mutex>& lock, HostStamp target_ns, RealClock::time_point give_up) {
    if (speed_factor_ == 0) return moved_.wait_until(lock, give_up) == std::cv_status::no_timeout;
    const std::chrono::duration<double, std::nano> ahead{static_cast<double>(target_ns - start_ns_) / speed_factor_};
    // Rounded up, so that the target is reached when the wait is over.
    moved_.wait_until(lock, real_start_ + std::chrono::ceil<std::chrono::nanoseconds>(ahead));
    return true;
  }

  const double speed_factor_;
  const HostStamp turn_period_ns_;
  const ScannerModel model_;
  DiskMotion disk_;
  FakeEncoder encoder_;
  FakeUtm30lx sensor_;
  const HostStamp start_ns_;
  const RealClock::time_point real_start_ = RealClock::now();
  HostStamp now_ns_;
  HostStamp encoder_read_ns_;
  int open_scanners_ = 0;
  int open_encoders_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable moved_;
};

class SimulatedRobot::ScannerPort : public drivers::BytePort {
 public:
  explicit ScannerPort(std::shared_ptr<World> world) : world_{std::move(world)} { world_->count_scanners(1); }
  ~ScannerPort() override { world_->count_scanners(-1); }
  ScannerPort(const ScannerPort&) = delete;
  ScannerPort& operator=(const ScannerPort&) = delete;

  tl::expected<drivers::ByteChunk, drivers::PortError> read(std::chrono::nanoseconds timeout) override {
    return world_->read_scanner(timeout);
  }
  tl::expected<void, drivers::PortError> write(std::string_view bytes) override {
    world_->write(bytes);
    return {};
  }

 private:
  std::shared_ptr<World> world_;
};

class SimulatedRobot::EncoderPort : public drivers::AnglePort {
 public:
  explicit EncoderPort(std::shared_ptr<World> world) : world_{std::move(world)} { world_->count_encoders(1); }
  ~EncoderPort() override { world_->count_encoders(-1); }
  EncoderPort(const EncoderPort&) = delete;
  EncoderPort& operator=(const EncoderPort&) = delete;

  tl::expected<std::vector<drivers::AngleSample>, drivers::PortError> read(std::chrono::nanoseconds timeout) override {
    return world_->read_encoder(timeout);
  }

 private:
  std::shared_ptr<World> world_;
};

SimulatedRobot::SimulatedRobot(const Scene& scene, const SimulatedRobotOptions& options)
    : world_{std::make_shared<World>(scene, options)} {}

std::unique_ptr<drivers::BytePort> SimulatedRobot::open_scanner() { return std::make_unique<ScannerPort>(world_); }

std::unique_ptr<drivers::AnglePort> SimulatedRobot::open_encoder() { return std::make_unique<EncoderPort>(world_); }

HostStamp SimulatedRobot::now_ns() const { return world_->now_ns(); }

void SimulatedRobot::set_disk_speed(double speed_rad_s) { world_->set_disk_speed(speed_rad_s); }

double SimulatedRobot::disk_speed_rad_s() const { return world_->disk_speed_rad_s(); }

double SimulatedRobot::disk_angle_rad() const { return world_->disk_angle_rad(); }

}  // namespace stairway::sim
