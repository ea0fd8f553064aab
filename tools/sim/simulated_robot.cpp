// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/simulated_robot.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace stairway::sim {
namespace {

using drivers::HostStamp;
using drivers::PortError;
using std::chrono::nanoseconds;
using RealClock = std::chrono::steady_clock;

constexpr HostStamp kDriveUptime_ns = 1'000'000'000;  // it has booted before somebody looks
constexpr HostStamp kLead_ns = 100'000'000;           // of one thread before another

ScannerModel make_model(const Scene& scene, const SimulatedRobotOptions& options) {
  if (const std::string problem = options.problem(); !problem.empty()) throw std::invalid_argument{"robot: " + problem};
  return ScannerModel{scene.mesh, scan::make_calibration(options.mount), options.scanner, options.seed};
}

FakeDriveOptions drive_options(const SimulatedRobotOptions& options) {
  FakeDriveOptions drive = options.drive;
  drive.start_ns = options.sensor.start_ns - kDriveUptime_ns;
  return drive;
}

}  // namespace

std::string SimulatedRobotOptions::problem() const {
  if (auto text = mount.problem(); !text.empty()) return "mount: " + text;
  if (auto text = scanner.problem(); !text.empty()) return "scanner: " + text;
  if (auto text = sensor.problem(); !text.empty()) return "sensor: " + text;
  if (!(std::abs(start_angle_rad) <= 1000)) return "start angle must lie within 1000 rad";
  if (encoder_counts_per_turn < 4 || encoder_counts_per_turn > 1000000 || encoder_counts_per_turn % 4 != 0)
    return "encoder counts must lie within 4 .. 1000000 and come by fours";
  if (!(speed_factor >= 0 && speed_factor <= 1000)) return "speed factor must lie within 0 .. 1000";
  return {};
}

// Everything behind one lock: the devices, the disk and the clock.
class SimulatedRobot::World {
 public:
  World(const Scene& scene, const SimulatedRobotOptions& options)
      : speed_factor_{options.speed_factor},
        turn_period_ns_{std::llround(1e9 * options.sensor.turn_period_s)},
        model_{make_model(scene, options)},
        disk_{options.sensor.start_ns, options.start_angle_rad, 0.0},
        sensor_{options.sensor,
                [this](std::uint64_t turn, HostStamp start_ns, std::span<std::uint32_t> values) {
                  model_.measure_turn(turn, disk_.angle_at(start_ns), disk_.angle_at(start_ns + turn_period_ns_),
                                      values);
                }},
        drive_{drive_options(options)},
        lines_{disk_, options.sensor.start_ns, options.encoder_counts_per_turn, options.seed},
        start_ns_{options.sensor.start_ns},
        now_ns_{start_ns_} {
    drive_.listen([this](HostStamp stamp_ns, double speed_rad_s) { disk_.set_speed(stamp_ns, speed_rad_s); });
  }

  HostStamp now_ns() const {
    const std::lock_guard lock{mutex_};
    return time_ns();
  }
  double disk_speed_rad_s() {
    const std::lock_guard lock{mutex_};
    return disk_.speed_at(catch_up());
  }
  double disk_angle_rad() {
    const std::lock_guard lock{mutex_};
    return disk_.angle_at(catch_up());
  }
  void tamper(const std::function<void(const Parts&)>& change) {
    const std::lock_guard lock{mutex_};
    const HostStamp now = catch_up();
    change({sensor_, drive_, bus_, lines_, disk_, now});
    moved_.notify_all();
  }

  void plug(Cable cable, bool is_plugged) {
    const std::lock_guard lock{mutex_};
    socket(cable).is_plugged = is_plugged;
    if (is_plugged) ++plugged_in_;
    if (cable == Cable::Motor) bus_.set_removed(!is_plugged);
    moved_.notify_all();
  }
  /// False when the cable is pulled out.
  bool open(Cable cable) {
    const std::lock_guard lock{mutex_};
    Socket& place = socket(cable);
    if (!place.is_plugged) return false;
    // What came before is not for this port.
    if (cable == Cable::Encoder) lines_.take(disk_, catch_up());
    if (cable == Cable::Motor) static_cast<void>(bus_.take(catch_up()));
    ++place.ports;
    place.reader = std::this_thread::get_id();
    place.seen_ns = time_ns();
    return true;
  }
  void close(Cable cable) {
    const std::lock_guard lock{mutex_};
    Socket& place = socket(cable);
    if (--place.ports == 0) place.reader = {};
    moved_.notify_all();
  }
  /// True when something is plugged in meanwhile.
  bool sleep(nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    const auto give_up = RealClock::now() + timeout;
    const HostStamp end_ns = time_ns() + timeout.count();
    const int plugged_in = plugged_in_;
    for (;;) {
      move_time(end_ns);
      if (plugged_in_ != plugged_in) return true;
      if (catch_up() >= end_ns || !wait(lock, end_ns, give_up)) return false;
    }
  }

  tl::expected<void, PortError> write_scanner(std::string_view bytes) {
    const std::lock_guard lock{mutex_};
    if (!socket(Cable::Scanner).is_plugged) return tl::unexpected(PortError::Closed);
    sensor_.receive(bytes, catch_up());
    return {};
  }
  tl::expected<void, PortError> write_motor(const drivers::CanFrame& frame) {
    const std::lock_guard lock{mutex_};
    return bus_.write(frame, catch_up());
  }
  drivers::LineLevels levels() {
    const std::lock_guard lock{mutex_};
    return lines_.levels();
  }

  tl::expected<drivers::ByteChunk, PortError> read_scanner(nanoseconds timeout) {
    std::optional<drivers::ByteChunk> chunk;
    const auto end_ns = read(
        Cable::Scanner, timeout, [this] { return sensor_.next_due_ns(); },
        [&](HostStamp now) { return (chunk = sensor_.take(now)).has_value(); });
    if (!end_ns) return tl::unexpected(end_ns.error());
    return chunk ? std::move(*chunk) : drivers::ByteChunk{.arrival_ns = *end_ns, .bytes = {}};
  }
  tl::expected<std::vector<drivers::CanArrival>, PortError> read_motor(nanoseconds timeout) {
    tl::expected<std::vector<drivers::CanArrival>, PortError> arrivals;
    const auto end_ns = read(
        Cable::Motor, timeout, [this] { return bus_.next_due_ns(); },
        [&](HostStamp now) { return !(arrivals = bus_.take(now)) || !arrivals->empty(); });
    if (!end_ns) return tl::unexpected(end_ns.error());
    return arrivals;
  }
  tl::expected<drivers::EdgeBatch, PortError> read_encoder(nanoseconds timeout) {
    drivers::EdgeBatch batch;
    const auto end_ns = read(
        Cable::Encoder, timeout, [this] { return lines_.next_due_ns(disk_); },
        [&](HostStamp now) { return !(batch = lines_.take(disk_, now)).edges.empty() || batch.lost_edges > 0; });
    if (!end_ns) return tl::unexpected(end_ns.error());
    return batch;
  }

 private:
  struct Socket {
    bool is_plugged = true;
    int ports = 0;
    std::thread::id reader;
    HostStamp seen_ns = 0;  // by the reader
  };

  Socket& socket(Cable cable) { return sockets_[static_cast<std::size_t>(cable)]; }

  /// Waits until `take` finds something at the time it is given; the instant of the end.
  template <class NextDue, class Take>
  tl::expected<HostStamp, PortError> read(Cable cable, nanoseconds timeout, NextDue next_due, Take take) {
    std::unique_lock lock{mutex_};
    const auto give_up = RealClock::now() + timeout;
    const HostStamp end_ns = time_ns() + timeout.count();
    Socket& place = socket(cable);
    place.reader = std::this_thread::get_id();
    for (;;) {
      if (!place.is_plugged) return tl::unexpected(PortError::Closed);
      const HostStamp target_ns = std::min(next_due(), end_ns);
      move_time(target_ns);
      const HostStamp now = catch_up();
      const bool has_taken = take(now);
      place.seen_ns = std::min(now, next_due());  // what still waits has not been seen
      moved_.notify_all();
      if (has_taken || now >= end_ns) return now;
      if (now < target_ns && !wait(lock, target_ns, give_up)) return now;
    }
  }

  HostStamp time_ns() const {
    if (speed_factor_ == 0) return now_ns_;
    const std::chrono::duration<double, std::nano> real = RealClock::now() - real_start_;
    return start_ns_ + std::llround(speed_factor_ * real.count());
  }

  // The drive has turned the disk up to now.
  HostStamp catch_up() {
    const HostStamp now = time_ns();
    drive_.advance(now);
    return now;
  }

  // Without a speed factor, time goes where its reader wants, as far as the other threads' readers are.
  void move_time(HostStamp target_ns) {
    if (speed_factor_ != 0) return;
    for (const Socket& other : sockets_) {
      const bool is_elsewhere = other.reader != std::thread::id{} && other.reader != std::this_thread::get_id();
      if (other.ports > 0 && is_elsewhere) target_ns = std::min(target_ns, other.seen_ns + kLead_ns);
    }
    if (target_ns <= now_ns_) return;
    now_ns_ = target_ns;
    moved_.notify_all();
  }

  // False when the wait is over for good.
  bool wait(std::unique_lock<std::mutex>& lock, HostStamp target_ns, RealClock::time_point give_up) {
    if (speed_factor_ == 0) return moved_.wait_until(lock, give_up) == std::cv_status::no_timeout;
    const std::chrono::duration<double, std::nano> ahead{static_cast<double>(target_ns - start_ns_) / speed_factor_};
    // Rounded up, so that the target is reached when the wait is over.
    moved_.wait_until(lock, real_start_ + std::chrono::ceil<nanoseconds>(ahead));
    return true;
  }

  const double speed_factor_;
  const HostStamp turn_period_ns_;
  const ScannerModel model_;
  DiskMotion disk_;
  FakeUtm30lx sensor_;
  FakeDrive drive_;
  FakeCanBus bus_{drive_};
  FakeEncoderLines lines_;
  const HostStamp start_ns_;
  const RealClock::time_point real_start_ = RealClock::now();
  HostStamp now_ns_;
  std::array<Socket, 3> sockets_;
  int plugged_in_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable moved_;
};

class SimulatedRobot::ScannerPort : public drivers::BytePort {
 public:
  explicit ScannerPort(std::shared_ptr<World> world) : world_{std::move(world)} {}
  ~ScannerPort() override { world_->close(Cable::Scanner); }
  ScannerPort(const ScannerPort&) = delete;
  ScannerPort& operator=(const ScannerPort&) = delete;

  tl::expected<drivers::ByteChunk, PortError> read(nanoseconds timeout) override {
    return world_->read_scanner(timeout);
  }
  tl::expected<void, PortError> write(std::string_view bytes) override { return world_->write_scanner(bytes); }

 private:
  std::shared_ptr<World> world_;
};

class SimulatedRobot::MotorPort : public drivers::CanPort {
 public:
  explicit MotorPort(std::shared_ptr<World> world) : world_{std::move(world)} {}
  ~MotorPort() override { world_->close(Cable::Motor); }
  MotorPort(const MotorPort&) = delete;
  MotorPort& operator=(const MotorPort&) = delete;

  tl::expected<std::vector<drivers::CanArrival>, PortError> read(nanoseconds timeout) override {
    return world_->read_motor(timeout);
  }
  tl::expected<void, PortError> write(const drivers::CanFrame& frame) override { return world_->write_motor(frame); }

 private:
  std::shared_ptr<World> world_;
};

class SimulatedRobot::EncoderPort : public drivers::EdgePort {
 public:
  explicit EncoderPort(std::shared_ptr<World> world) : world_{std::move(world)} {}
  ~EncoderPort() override { world_->close(Cable::Encoder); }
  EncoderPort(const EncoderPort&) = delete;
  EncoderPort& operator=(const EncoderPort&) = delete;

  tl::expected<drivers::EdgeBatch, PortError> read(nanoseconds timeout) override {
    return world_->read_encoder(timeout);
  }
  tl::expected<drivers::LineLevels, PortError> levels() override { return world_->levels(); }
  int queued_edges() const override { return 1024; }

 private:
  std::shared_ptr<World> world_;
};

SimulatedRobot::SimulatedRobot(const Scene& scene, const SimulatedRobotOptions& options)
    : world_{std::make_shared<World>(scene, options)} {}

drivers::PortOpener<drivers::BytePort> SimulatedRobot::scanner() {
  return {[world = world_]() -> tl::expected<std::unique_ptr<drivers::BytePort>, std::string> {
            if (!world->open(Cable::Scanner)) return tl::unexpected(std::string("the simulated scanner is unplugged"));
            return std::make_unique<ScannerPort>(world);
          },
          [world = world_](nanoseconds timeout) { return world->sleep(timeout); }};
}

drivers::PortOpener<drivers::CanPort> SimulatedRobot::motor() {
  return {[world = world_]() -> tl::expected<std::unique_ptr<drivers::CanPort>, std::string> {
            if (!world->open(Cable::Motor))
              return tl::unexpected(std::string("the simulated CAN interface is removed"));
            return std::make_unique<MotorPort>(world);
          },
          [world = world_](nanoseconds timeout) { return world->sleep(timeout); }};
}

drivers::PortOpener<drivers::EdgePort> SimulatedRobot::encoder() {
  return {[world = world_]() -> tl::expected<std::unique_ptr<drivers::EdgePort>, std::string> {
            if (!world->open(Cable::Encoder)) return tl::unexpected(std::string("the simulated GPIO chip is removed"));
            return std::make_unique<EncoderPort>(world);
          },
          [world = world_](nanoseconds timeout) { return world->sleep(timeout); }};
}

void SimulatedRobot::plug(Cable cable, bool is_plugged) { world_->plug(cable, is_plugged); }

void SimulatedRobot::tamper(const std::function<void(const Parts&)>& change) { world_->tamper(change); }

HostStamp SimulatedRobot::now_ns() const { return world_->now_ns(); }

double SimulatedRobot::disk_speed_rad_s() const { return world_->disk_speed_rad_s(); }

double SimulatedRobot::disk_angle_rad() const { return world_->disk_angle_rad(); }

}  // namespace stairway::sim
