// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drivers/scip/scip_session.hpp"
#include "tests/drivers/scripted_sensor.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kMs = 1'000'000;
constexpr double kDegree = 0.017453292519943295;

// A session and a sensor that answers as soon as it is heard.
struct Line {
  explicit Line(const ScipOptions& options = {}) : session(options) {}

  void pass(HostStamp time_ns) {
    now_ns += time_ns;
    for (const auto& [at_ns, bytes] : sensor.send(now_ns)) take(session.on_bytes(bytes, now_ns));
    take(session.on_time(now_ns));
    sensor.receive(session.take_output(), now_ns);
  }
  bool reaches_streaming(double limit_s) {
    const HostStamp end_ns = now_ns + std::llround(1e9 * limit_s);
    while (session.state() != ScipState::Streaming && now_ns < end_ns) pass(5 * kMs);
    return session.state() == ScipState::Streaming;
  }
  void hear(const std::string& bytes) {
    now_ns += 25 * kMs;
    take(session.on_bytes(bytes, now_ns));
  }

  ScriptedSensor sensor;
  ScipSession session;
  HostStamp now_ns = 5'000 * kMs;
  std::vector<LaserScan> scans;

 private:
  void take(std::vector<ScipEvent> events) {
    for (ScipEvent& event : events) {
      if (auto* scan = std::get_if<LaserScan>(&event)) scans.push_back(std::move(*scan));
    }
  }
};

bool is_same(const LaserScan& a, const LaserScan& b) {
  const auto is_same_range = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::ranges::equal(a.ranges_m, b.ranges_m, is_same_range) && a.statuses == b.statuses &&
         a.intensities == b.intensities && a.device_stamp_ms == b.device_stamp_ms;
}

struct Stream {
  ScipOptions options;
  std::string message;
};

std::vector<Stream> streams() {
  Stream ranges;
  ranges.options.min_angle_rad = -3.0 * kDegree;
  ranges.options.max_angle_rad = 2.75 * kDegree;
  ranges.message = samples::kMd;
  Stream intensities;
  intensities.options.min_angle_rad = -2.0 * kDegree;
  intensities.options.max_angle_rad = 1.75 * kDegree;
  intensities.options.intensities = true;
  intensities.options.skip_scan = 1;
  intensities.message = samples::kMe;
  return {ranges, intensities};
}

TEST(ScipDamage, any_flipped_bit_of_a_scan_loses_it_at_the_most_and_the_next_one_decodes) {
  for (const Stream& stream : streams()) {
    Line line(stream.options);
    ASSERT_TRUE(line.reaches_streaming(5.0));
    ASSERT_EQ(line.sensor.stream_command(), stream.message.substr(0, 15));
    line.scans.clear();
    line.hear(stream.message);
    ASSERT_EQ(line.scans.size(), 1U);
    const LaserScan good = line.scans.front();
    for (std::size_t at = 0; at < stream.message.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string damaged = stream.message;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
        line.scans.clear();
        line.hear(damaged);
        line.hear(stream.message);
        ASSERT_FALSE(line.scans.empty()) << "byte " << at << " bit " << bit;
        for (const LaserScan& scan : line.scans) ASSERT_TRUE(is_same(scan, good)) << "byte " << at << " bit " << bit;
      }
    }
    EXPECT_EQ(line.session.state(), ScipState::Streaming);
  }
}

// One bit of each byte, a different one from byte to byte.
TEST(ScipDamage, a_damaged_answer_is_asked_for_again_while_opening) {
  const std::pair<const char*, std::string> answers[] = {
      {"VV", samples::kVersion}, {"PP", samples::kParameters},
      {"II", samples::kState},   {"QT", "QT\n00P\n\n"},
      {"RS", "RS\n00P\n\n"},     {"BM", "BM\n00P\n\n"},
      {"TM0", "TM0\n00P\n\n"},   {"TM1", "TM1\n00P\n00?Xg\n\n"},
      {"TM2", "TM2\n00P\n\n"},   {"MD0000108001000", "MD0000108001000\n00P\n\n"},
  };
  ScipOptions options;
  options.clock_source = TimeSource::TimeAdjustment;
  options.time_readings = 2;
  for (const auto& [damaged_command, answer] : answers) {
    for (std::size_t at = 0; at < answer.size(); ++at) {
      Line line(options);
      bool is_damaged = false;
      line.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
        if (command == "TM1" && (is_damaged || damaged_command != command)) return "TM1\n00P\n00?Xg\n\n";
        if (command != damaged_command || is_damaged) return std::nullopt;
        is_damaged = true;
        std::string damaged = answer;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
        return damaged;
      };
      ASSERT_TRUE(line.reaches_streaming(12.0)) << damaged_command << " byte " << at;
      ASSERT_TRUE(is_damaged);
      const SensorParameters& sensor = line.session.device().parameters;
      ASSERT_EQ(sensor.min_range_mm, 23);
      ASSERT_EQ(sensor.max_range_mm, 60000);
      ASSERT_EQ(sensor.steps_per_turn, 1440);
      ASSERT_EQ(sensor.last_step, 1080);
      ASSERT_EQ(sensor.front_step, 540);
      ASSERT_EQ(sensor.scan_speed_rpm, 2400);
    }
  }
}

}  // namespace
}  // namespace stairway::drivers
