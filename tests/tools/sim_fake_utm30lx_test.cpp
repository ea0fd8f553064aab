// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/scip/scip_replies.hpp"
#include "tools/sim/fake_utm30lx.hpp"
#include "tools/sim/scanner_model.hpp"

namespace stairway::sim {
namespace {

using drivers::HostStamp;

constexpr HostStamp kMillisecond_ns = 1'000'000;

// Ranges that name their turn and beam.
void number_beams(std::uint64_t turn, HostStamp, std::span<std::uint32_t> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint32_t>(1000 + 2000 * (turn % 10) + i);
}

// Talks to the sensor as a patient host: waits for every message.
class Host {
 public:
  explicit Host(const FakeUtm30lxOptions& options = {}) : sensor{options, number_beams} {}

  std::string ask(const std::string& command) {
    sensor.receive(command + "\n", now_ns);
    return next();
  }
  std::string next() {
    if (sensor.next_due_ns() == std::numeric_limits<HostStamp>::max()) return {};
    now_ns = sensor.next_due_ns();
    const auto chunk = sensor.take(now_ns);
    EXPECT_TRUE(chunk);
    EXPECT_EQ(chunk->arrival_ns, now_ns);
    return chunk->bytes;
  }

  FakeUtm30lx sensor;
  HostStamp now_ns = 0;
};

TEST(SimFakeUtm30lx, answers_commands_as_specified) {
  const std::vector<std::pair<std::string, std::string>> dialogue{
      {"QT", "QT\n00P\n\n"},
      {"BM", "BM\n00P\n\n"},
      {"BM", "BM\n02R\n\n"},
      {"QT;tag 1", "QT;tag 1\n00P\n\n"},
      {"RS", "RS\n00P\n\n"},
      {"RT", "RT\n00P\n\n"},
      {"CR00", "CR00\n04T\n\n"},
      {"HS1", "HS1\n03S\n\n"},
      {"XX", "XX\n0Ee\n\n"},
      {"GE0000108001", "GE0000108001\n0Ee\n\n"},
      {"SCIP2.0", "SCIP2.0\n0Ee\n\n"},
      {"QT;abcdefghijklmnopq", "QT;abcdefghijklmnopq\n0Gg\n\n"},
      {"QT;a!", "QT;a!\n0Hh\n\n"},
      {"GD0000108001", "GD0000108001\n10Q\n\n"},
      {"MDx000108001000", "MDx000108001000\n01Q\n\n"},
      {"MD0000x08001000", "MD0000x08001000\n02R\n\n"},
      {"MD00001080x1000", "MD00001080x1000\n03S\n\n"},
      {"MD0000108101000", "MD0000108101000\n04T\n\n"},
      {"MD0500040001000", "MD0500040001000\n05U\n\n"},
      {"MD0000108001x00", "MD0000108001x00\n06V\n\n"},
      {"MD00001080010x0", "MD00001080010x0\n07W\n\n"},
      {"MD000010800100", "MD000010800100\n0Cc\n\n"},
      {"MD00001080010000", "MD00001080010000\n0Dd\n\n"},
      {"TM1", "TM1\n04T\n\n"},
      {"TM2", "TM2\n03S\n\n"},
      {"TM7", "TM7\n01Q\n\n"},
      {"TM0", "TM0\n00P\n\n"},
      {"TM0", "TM0\n02R\n\n"},
      {"QT", "QT\n0Ee\n\n"},
      {"TM2", "TM2\n00P\n\n"},
      {"QT", "QT\n00P\n\n"},
  };
  Host host;
  for (const auto& [command, reply] : dialogue) {
    SCOPED_TRACE(command);
    EXPECT_EQ(host.ask(command), reply);
  }
}

TEST(SimFakeUtm30lx, describes_itself_as_the_real_one_does) {
  Host host;
  EXPECT_EQ(host.ask("PP"),
            "PP\n00P\nMODL:UTM-30LX(Hokuyo Automatic Co.,Ltd.);U\nDMIN:23;7\nDMAX:60000;J\nARES:1440;^\nAMIN:0;?\n"
            "AMAX:1080;Z\nAFRT:540;0\nSCAN:2400;U\n\n");
  const std::string version = host.ask("VV");
  EXPECT_NE(version.find("PROD:SOKUIKI Sensor TOP-URG UTM-30LX;P\n"), std::string::npos);
  const std::string state = host.ask("II");
  EXPECT_NE(state.find("LASR:OFF;"), std::string::npos);
  EXPECT_NE(state.find("STAT:Sensor works well.;8\n"), std::string::npos);
}

TEST(SimFakeUtm30lx, replies_once_per_mirror_turn) {
  Host host;
  host.sensor.receive("VV\nPP\nII\n", 3 * kMillisecond_ns);
  std::vector<HostStamp> arrivals;
  for (int i = 0; i < 3; ++i) {
    host.next();
    arrivals.push_back(host.now_ns);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const HostStamp earliest = (25 * (static_cast<HostStamp>(i) + 1)) * kMillisecond_ns + 23'500'000;
    EXPECT_GE(arrivals[i], earliest);
    EXPECT_LE(arrivals[i], earliest + kMillisecond_ns);
  }
}

struct DecodedScan {
  drivers::ScanRequest request;
  drivers::RawScan scan;
};

DecodedScan decode(std::string message) {
  message.pop_back();  // the empty line that ends it
  const auto reply = drivers::parse_reply(message);
  EXPECT_TRUE(reply) << message.substr(0, 40);
  DecodedScan result;
  if (!reply) return result;
  EXPECT_EQ(reply->status, "99");
  const auto command = drivers::parse_command(reply->echo);
  result.request = drivers::parse_scan_request(command.value()).value();
  EXPECT_TRUE(drivers::decode_scan(reply->data, result.request, result.scan));
  return result;
}

TEST(SimFakeUtm30lx, a_whole_stream_decodes_to_what_was_measured) {
  FakeUtm30lxOptions options;
  options.counter_at_start_ms = 0xffffff - 400;  // the counter wraps on the way
  Host host{options};
  EXPECT_EQ(host.ask("MD0000108001000"), "MD0000108001000\n00P\n\n");
  for (std::uint64_t turn = 1; turn <= 60; ++turn) {
    const std::string message = host.next();
    EXPECT_EQ(message.size(), 3372U);
    const auto [request, scan] = decode(message);
    std::vector<std::uint32_t> expected(kBeams);
    number_beams(turn, 0, expected);
    EXPECT_EQ(scan.ranges_mm, expected);
    const auto elapsed_ms = static_cast<std::uint32_t>(25.0 * static_cast<double>(turn) * 1.00005);
    EXPECT_EQ(scan.stamp_ms, (0xffffff - 400 + elapsed_ms) & 0xffffff);
    const HostStamp delay_ns = host.now_ns - static_cast<HostStamp>(turn) * 25 * kMillisecond_ns;
    EXPECT_GE(delay_ns, 23'500'000);
    EXPECT_LE(delay_ns, 24'500'000);
  }
  EXPECT_TRUE(host.sensor.is_streaming());
}

TEST(SimFakeUtm30lx, gives_intensities_that_fall_with_the_distance) {
  Host host;
  EXPECT_EQ(host.ask("ME0500054001000"), "ME0500054001000\n00P\n\n");
  const auto [request, scan] = decode(host.next());
  EXPECT_TRUE(request.has_intensity());
  ASSERT_EQ(scan.intensities.size(), 41U);
  EXPECT_EQ(scan.ranges_mm.front(), 3500U);
  EXPECT_EQ(scan.intensities.front(), 16'000'000U / 4500U);
  EXPECT_LT(scan.intensities.back(), scan.intensities.front());
}

TEST(SimFakeUtm30lx, is_overloaded_by_intensities_of_the_whole_field) {
  Host host;
  host.ask("ME0000108001000");
  const std::string first_half = host.next();
  const HostStamp first_ns = host.now_ns;
  EXPECT_EQ(first_half.size() + host.next().size(), 6717U);
  EXPECT_NEAR(static_cast<double>(host.now_ns - first_ns), 25e6, 1e3);
  for (int i = 0; i < 7; ++i) host.next();
  EXPECT_NEAR(static_cast<double>(host.now_ns - first_ns), 4 * 50e6, 1e6);
}

TEST(SimFakeUtm30lx, answers_the_time_at_once_when_it_is_that_kind) {
  FakeUtm30lxOptions options;
  options.answers_time_at_once = true;
  options.clock_rate = 1.0;
  Host host{options};
  EXPECT_EQ(host.ask("TM1"), "TM1\n04T\n\n");
  host.ask("TM0");
  const HostStamp asked_ns = host.now_ns;
  const std::string answer = host.ask("TM1");
  EXPECT_EQ(host.now_ns - asked_ns, kMillisecond_ns);
  EXPECT_EQ(drivers::decode_number(answer.substr(8, 4)).value(), (asked_ns + kMillisecond_ns / 2) / kMillisecond_ns);
}

TEST(SimFakeUtm30lx, counts_down_a_counted_stream_and_falls_silent) {
  Host host;
  EXPECT_EQ(host.ask("MD0528055101003;x"), "MD0528055101003;x\n00P\n\n");
  for (const char* echo : {"MD0528055101002;x\n99b\n", "MD0528055101001;x\n99b\n", "MD0528055101000;x\n99b\n"}) {
    EXPECT_EQ(host.next().substr(0, 22), echo);
  }
  EXPECT_EQ(host.next(), "");
  EXPECT_NE(host.ask("II").find("LASR:OFF"), std::string::npos);
}

TEST(SimFakeUtm30lx, skips_turns_and_groups_beams_when_asked) {
  Host host;
  host.ask("MD0000001010200");
  const auto first = decode(host.next());
  const HostStamp first_arrival = host.now_ns;
  const auto second = decode(host.next());
  EXPECT_EQ(first.scan.ranges_mm, (std::vector<std::uint32_t>{3000, 3010}));
  EXPECT_EQ(second.scan.ranges_mm, (std::vector<std::uint32_t>{9000, 9010}));
  EXPECT_NEAR(static_cast<double>(host.now_ns - first_arrival), 75e6, 1e6);
}

TEST(SimFakeUtm30lx, a_group_gives_its_nearest_distance_and_not_an_error_code) {
  FakeUtm30lx sensor{{}, [](std::uint64_t, HostStamp, std::span<std::uint32_t> values) {
                       std::fill(values.begin(), values.end(), 1U);
                       values[1] = 500;
                       values[2] = 400;
                     }};
  sensor.receive("BM\nGD0000000503\n", 0);
  sensor.take(1'000 * kMillisecond_ns);
  std::string message = sensor.take(1'000 * kMillisecond_ns)->bytes;
  message.pop_back();  // the empty line that ends it
  EXPECT_EQ(message.substr(0, 17), "GD0000000503\n00P\n");
  drivers::RawScan scan;
  drivers::ScanRequest request{"GD", 0, 5, 3, 0, 0};
  const auto reply = drivers::parse_reply(message);
  ASSERT_TRUE(drivers::decode_scan(reply->data, request, scan));
  EXPECT_EQ(scan.ranges_mm, (std::vector<std::uint32_t>{400, 1}));
}

TEST(SimFakeUtm30lx, answers_a_command_in_the_turns_that_a_stream_skips) {
  Host host;
  host.ask("MD0000001010900");
  host.next();
  const HostStamp asked_ns = host.now_ns + 60 * kMillisecond_ns;
  host.sensor.receive("QT\n", asked_ns);
  EXPECT_FALSE(host.sensor.take(asked_ns));
  EXPECT_EQ(host.next(), "QT\n00P\n\n");
  EXPECT_NEAR(static_cast<double>(host.now_ns - asked_ns), 37e6, 14e6);
}

TEST(SimFakeUtm30lx, stops_at_once_and_resets_its_clock) {
  Host host;
  host.ask("MD0000108001000");
  for (int i = 0; i < 5; ++i) host.next();
  EXPECT_EQ(host.ask("QT"), "QT\n00P\n\n");
  EXPECT_EQ(host.next(), "");
  host.now_ns += 5'000 * kMillisecond_ns;
  host.ask("RS");
  host.ask("TM0");
  drivers::RawScan scan;
  const std::string time = host.ask("TM1");
  EXPECT_LT(drivers::decode_number(time.substr(8, 4)).value(), 100U);
}

TEST(SimFakeUtm30lx, survives_garbage_and_floods) {
  Host host;
  std::string junk;
  for (int i = 0; i < 20000; ++i) junk.push_back(static_cast<char>(i * 7919 >> 3));
  host.sensor.receive(junk, 0);
  host.sensor.receive("\n", 0);
  int replies = 0;
  while (!host.next().empty()) ++replies;
  EXPECT_LE(replies, 16);
  EXPECT_EQ(host.ask("BM"), "BM\n00P\n\n");
}

TEST(SimFakeUtm30lx, a_late_host_loses_scans_and_not_memory) {
  Host host;
  host.ask("MD0000108001000");
  const HostStamp late = host.now_ns + 3600LL * 1000 * kMillisecond_ns;
  int scans = 0;
  while (host.sensor.take(late)) ++scans;
  EXPECT_GT(scans, 30);
  EXPECT_LE(scans, 45);
}

}  // namespace
}  // namespace stairway::sim
