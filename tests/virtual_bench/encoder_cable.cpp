// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/virtual_bench/encoder_cable.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include "drivers/gpio/file_descriptor.hpp"
#include "tests/virtual_bench/prompt_thread.hpp"

namespace stairway::bench {
namespace {

using namespace std::chrono_literals;
using drivers::FileDescriptor;
using Levels = std::array<bool, 3>;

constexpr auto kReopenPause = 20ms;
constexpr auto kCatchUpPause = 500us;
constexpr double kLongestWait_s = 0.005;
constexpr double kRadiansPerCount = 2.0 * std::numbers::pi / kEncoderCountsPerTurn;

class Lines {
 public:
  static std::optional<Lines> open(const std::filesystem::path& chip) {
    std::string device, name;
    std::ifstream(chip / "dev_name") >> device;
    std::ifstream(chip / "bank/chip_name") >> name;
    const auto folder = std::filesystem::path("/sys/devices/platform") / device / name;
    Lines lines;
    for (std::size_t line = 0; line < lines.pulls_.size(); ++line) {
      const auto file = folder / ("sim_gpio" + std::to_string(line)) / "pull";
      lines.pulls_[line] = FileDescriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
      if (!lines.pulls_[line].is_open()) return std::nullopt;
    }
    return lines;
  }

  // False when the chip is gone.
  bool show(const Levels& levels) {
    for (std::size_t line = 0; line < levels.size(); ++line) {
      if (shown_ && (*shown_)[line] == levels[line]) continue;
      const std::string_view pull = levels[line] ? "pull-up" : "pull-down";
      if (::pwrite(pulls_[line].get(), pull.data(), pull.size(), 0) < 0) return false;
    }
    shown_ = levels;
    return true;
  }

 private:
  std::array<FileDescriptor, 3> pulls_;
  std::optional<Levels> shown_;
};

Levels levels_at(std::int64_t count) {
  const auto phase = count & 3;
  return {phase >= 2, phase == 1 || phase == 2, count % kEncoderCountsPerTurn == 0};
}

struct Place {
  std::int64_t count;
  std::chrono::duration<double> to_next_edge;
};

Place place_now(Robot& robot) {
  const std::lock_guard lock(robot.mutex);
  const drivers::HostStamp now = now_ns();
  robot.drive.advance(now);
  const double counts = robot.motion.angle_at(now) / kRadiansPerCount;
  const double speed = robot.motion.speed_at(now) / kRadiansPerCount;
  const double count = std::floor(counts);
  const double way = speed > 0.0 ? count + 1.0 - counts : counts - count;
  const double wait_s = speed == 0.0 ? kLongestWait_s : way / std::abs(speed);
  return {static_cast<std::int64_t>(count), std::chrono::duration<double>(std::min(wait_s, kLongestWait_s))};
}

// Until the chip is removed.
void turn(Robot& robot, Lines& lines, std::int64_t& count, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const Place place = place_now(robot);
    count += std::clamp<std::int64_t>(place.count - count, -1, 1);
    if (!robot.is_encoder_dead && !lines.show(levels_at(count))) return;
    if (count == place.count) {
      std::this_thread::sleep_for(place.to_next_edge + 20us);
    } else {
      std::this_thread::sleep_for(kCatchUpPause);
    }
  }
}

}  // namespace

void serve_encoder(Robot& robot, const std::filesystem::path& chip, std::stop_token stop) {
  be_prompt();
  while (!stop.stop_requested()) {
    if (auto lines = Lines::open(chip)) {
      std::int64_t count = place_now(robot).count;
      turn(robot, *lines, count, stop);
    }
    std::this_thread::sleep_for(kReopenPause);
  }
}

}  // namespace stairway::bench
