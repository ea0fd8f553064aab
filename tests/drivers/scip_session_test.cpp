// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "drivers/scip/scip_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tests/drivers/scripted_sensor.hpp"

namespace stairway::drivers {
namespace {

constexpr HostStamp kMs = 1'000'000;

// Steps session and sensor through time, a millisecond at a time.
struct Bench {
  explicit Bench(const ScipOptions& options = {}) : session(options) {}

  void run(double seconds) {
    for (const HostStamp end_ns = now_ns + std::llround(seconds * 1e9); now_ns < end_ns; now_ns += kMs) {
      for (const auto& [at_ns, bytes] : sensor.send(now_ns)) take(session.on_bytes(bytes, now_ns));
      take(session.on_time(now_ns));
      sensor.receive(session.take_output(), now_ns);
    }
  }

  void take(std::vector<ScipEvent> more) { std::ranges::move(more, std::back_inserter(events)); }

  template <typename Event>
  std::vector<Event> all() const {
    std::vector<Event> found;
    for (const ScipEvent& event : events) {
      if (const auto* one = std::get_if<Event>(&event)) found.push_back(*one);
    }
    return found;
  }
  std::vector<ScipState> states() const {
    std::vector<ScipState> found;
    for (const ScipStateEvent& event : all<ScipStateEvent>()) found.push_back(event.state);
    return found;
  }
  std::uint64_t count(ScipTrouble trouble) const { return session.counters().count(trouble); }
  int sent(const std::string& command) const { return static_cast<int>(std::ranges::count(sensor.commands, command)); }

  ScriptedSensor sensor;
  ScipSession session;
  HostStamp now_ns = 5'000 * kMs;
  std::vector<ScipEvent> events;
};

TEST(ScipSession, opens_in_the_safe_order_and_streams_the_whole_field) {
  Bench bench;
  bench.run(3.0);
  EXPECT_EQ(bench.sensor.commands,
            (std::vector<std::string>{"QT", "TM2", "RS", "RS", "VV", "PP", "II", "BM", "MD0000108001000"}));
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  ASSERT_EQ(bench.all<ScipDeviceInfo>().size(), 1U);
  EXPECT_EQ(bench.all<ScipDeviceInfo>().front().version.serial, "00903971");
  ASSERT_EQ(bench.all<ScipTroubleEvent>().size(), 1U);
  EXPECT_EQ(bench.count(ScipTrouble::OldFirmware), 1U);

  const auto scans = bench.all<LaserScan>();
  ASSERT_GT(scans.size(), 60U);
  const LaserScan& scan = scans.back();
  ASSERT_EQ(scan.ranges_m.size(), 1081U);
  ASSERT_EQ(scan.statuses.size(), 1081U);
  EXPECT_FLOAT_EQ(scan.ranges_m.front(), 2.0F);
  EXPECT_NEAR(scan.first_angle_rad, -0.75 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(scan.first_angle_rad + 1080 * scan.angle_increment_rad, 0.75 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(scan.beam_interval_ns, 25e6 / 1440, 1.0);
  EXPECT_EQ(scan.sequence, scans.size() - 1);
}

TEST(ScipSession, dates_the_first_beam_by_the_chosen_stamp_reference) {
  for (const auto& [reference, offset_ms] : {std::pair{StampReference::Rear, 3.125}, {StampReference::Step0, 0.0}}) {
    ScipOptions options;
    options.stamp_reference = reference;
    Bench bench(options);
    bench.run(3.0);
    const auto scans = bench.all<LaserScan>();
    ASSERT_GT(scans.size(), 60U);
    // Turns begin on the grid of 25 ms.
    const double phase_ms = static_cast<double>(scans.back().first_beam_stamp_ns % ScriptedSensor::kPeriod_ns) * 1e-6;
    // The bench's millisecond steps delay an arrival by 0.5 ms.
    EXPECT_NEAR(phase_ms, offset_ms + 0.5, 0.01);
  }
}

TEST(ScipSession, opens_a_sensor_that_is_already_streaming_although_it_ignores_the_first_qt) {
  Bench bench;
  bench.sensor.receive("MD0000108001000\n", bench.now_ns);
  int quits = 0;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command == "QT" && ++quits == 1) return "";
    return std::nullopt;
  };
  bench.run(4.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_EQ(quits, 2);
  EXPECT_EQ(bench.count(ScipTrouble::NoReply), 1U);
}

TEST(ScipSession, waits_for_a_laser_that_needs_seconds_after_power_up) {
  Bench bench;
  int attempts = 0;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command == "BM" && ++attempts < 5) return encode_reply("BM", "10");
    return std::nullopt;
  };
  bench.run(8.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_EQ(attempts, 5);
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 0U);
  EXPECT_EQ(bench.states(),
            (std::vector{ScipState::Opening, ScipState::WarmingUp, ScipState::Opening, ScipState::Streaming}));
}

TEST(ScipSession, complains_once_of_a_laser_that_is_not_ready_after_all_attempts) {
  ScipOptions options;
  options.laser_attempts = 4;
  Bench bench(options);
  int attempts = 0;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command != "BM") return std::nullopt;
    ++attempts;
    return encode_reply("BM", "10");
  };
  for (int i = 0; i < 1000 && attempts < 4; ++i) {
    EXPECT_EQ(bench.count(ScipTrouble::Refused), 0U);
    bench.run(0.01);
  }
  EXPECT_EQ(bench.session.state(), ScipState::WarmingUp);
  bench.run(1.2);
  EXPECT_EQ(attempts, 4);
  EXPECT_EQ(bench.session.state(), ScipState::Backoff);
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 1U);
}

TEST(ScipSession, accepts_a_laser_that_is_on_already) {
  Bench bench;
  bench.sensor.override_reply = [](const std::string& command) -> std::optional<std::string> {
    if (command == "BM") return encode_reply("BM", "02");
    return std::nullopt;
  };
  bench.run(2.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 0U);
}

TEST(ScipSession, leaves_another_unit_than_the_wanted_one_alone) {
  ScipOptions options;
  options.serial = "H0903972";
  Bench bench(options);
  bench.run(1.0);
  EXPECT_EQ(bench.count(ScipTrouble::WrongUnit), 1U);
  EXPECT_EQ(bench.all<ScipReopenEvent>().size(), 1U);
  bench.run(30.0);
  EXPECT_EQ(bench.sent("BM"), 0);
  EXPECT_EQ(bench.session.counters().scans, 0U);
}

TEST(ScipSession, leaves_a_unit_alone_that_does_not_tell_the_wanted_serial_number) {
  ScipOptions options;
  options.serial = "H0903972";
  Bench bench(options);
  bench.sensor.override_reply = [](const std::string& command) -> std::optional<std::string> {
    if (command == "VV") return encode_reply("VV", "0E");
    return std::nullopt;
  };
  bench.run(30.0);
  EXPECT_GE(bench.count(ScipTrouble::WrongUnit), 1U);
  EXPECT_EQ(bench.sent("BM"), 0);
  EXPECT_EQ(bench.session.counters().scans, 0U);
}

TEST(ScipSession, tells_that_a_scanner_is_of_another_model_and_uses_it) {
  Bench bench;
  bench.sensor.override_reply = [](const std::string& command) -> std::optional<std::string> {
    if (command != "PP") return std::nullopt;
    std::string lines;
    append_key_value(lines, "MODL", "URG-04LX(Hokuyo Automatic Co.,Ltd.)");
    const std::string& usual = samples::kParameters;
    const std::size_t numbers = usual.find("DMIN");
    return encode_reply("PP", "00", lines + usual.substr(numbers, usual.size() - numbers - 1));
  };
  bench.run(3.0);
  EXPECT_EQ(bench.count(ScipTrouble::WrongUnit), 1U);
  EXPECT_NE(bench.all<ScipTroubleEvent>().back().detail.find("URG-04LX"), std::string::npos);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, takes_the_wanted_unit_however_its_serial_is_written) {
  ScipOptions options;
  options.serial = "H0903971";
  Bench bench(options);
  bench.run(3.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, gives_intensities_when_asked) {
  ScipOptions options;
  options.intensities = true;
  options.cluster = 3;
  ASSERT_EQ(options.problem(), "");
  Bench bench(options);
  bench.run(3.0);
  EXPECT_EQ(bench.sensor.commands.back(), "ME0000108003000");
  const auto scans = bench.all<LaserScan>();
  ASSERT_GT(scans.size(), 50U);
  EXPECT_EQ(scans.back().intensities, std::vector<std::uint32_t>(scans.back().ranges_m.size(), 1500));
}

TEST(ScipSession, asks_for_ranges_where_intensities_are_not_known_and_again_at_the_next_opening) {
  ScipOptions options;
  options.intensities = true;
  options.skip_scan = 1;
  Bench bench(options);
  bool is_known = false;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command.starts_with("ME") && !is_known) return encode_reply(command, "0E");
    return std::nullopt;
  };
  bench.run(3.0);
  EXPECT_EQ(bench.sensor.commands.back(), "MD0000108001100");
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 1U);
  EXPECT_TRUE(bench.all<LaserScan>().back().intensities.empty());
  is_known = true;
  bench.take(bench.session.on_disconnect(bench.now_ns, "unplugged"));
  bench.run(4.0);
  EXPECT_EQ(bench.sensor.commands.back(), "ME0000108001100");
  EXPECT_EQ(bench.all<LaserScan>().back().intensities.size(), 1081U);
}

TEST(ScipSession, tells_of_bytes_that_were_lost_on_the_way) {
  Bench bench;
  bench.run(3.0);
  bench.take(bench.session.on_lost_bytes(1024));
  EXPECT_EQ(bench.count(ScipTrouble::LostBytes), 1U);
}

TEST(ScipSession, does_without_commands_that_a_simple_sensor_does_not_know) {
  Bench bench;
  bench.sensor.override_reply = [](const std::string& command) -> std::optional<std::string> {
    if (command == "VV" || command == "QT" || command.starts_with("MD")) return std::nullopt;
    return encode_reply(command, "0E");
  };
  bench.run(3.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_GT(bench.session.counters().scans, 50U);
  EXPECT_EQ(bench.count(ScipTrouble::Refused), 4U);  // the second RS, PP, II, BM
}

TEST(ScipSession, backs_off_longer_and_longer_from_a_sick_sensor_and_recovers) {
  Bench bench;
  bool is_sick = true;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command != "II" || !is_sick) return std::nullopt;
    std::string line;
    append_key_value(line, "STAT", "Trouble!! Error No. =[00->33] ");
    return encode_reply("II", "00", line);
  };
  bench.run(60.0);
  EXPECT_NE(bench.session.state(), ScipState::Streaming);
  EXPECT_GE(bench.count(ScipTrouble::SensorFault), 5U);
  EXPECT_LE(bench.count(ScipTrouble::SensorFault), 12U);
  is_sick = false;
  bench.run(12.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, never_gives_up_on_a_silent_sensor_and_asks_for_another_port) {
  Bench bench;
  bench.sensor.is_mute = true;
  bench.run(60.0);
  EXPECT_GE(bench.all<ScipReopenEvent>().size(), 2U);
  bench.sensor.is_mute = false;
  bench.run(20.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, restarts_a_silent_stream_without_resetting_the_clock) {
  Bench bench;
  bench.run(3.0);
  bench.sensor.is_streaming = false;
  bench.run(2.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_EQ(bench.count(ScipTrouble::Silence), 1U);
  EXPECT_EQ(bench.sent("RS"), 2);
  EXPECT_EQ(bench.sent("MD0000108001000"), 2);
  EXPECT_TRUE(bench.all<ScipReopenEvent>().empty());

  const auto scans = bench.all<LaserScan>();
  std::uint64_t gap = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    gap = std::max(gap, scans[i].sequence - scans[i - 1].sequence);
  }
  EXPECT_NEAR(static_cast<double>(gap), 10.0, 4.0);  // 175 ms of watchdog, then QT and MD
}

TEST(ScipSession, asks_for_another_port_after_three_failures_in_a_row) {
  Bench bench;
  bench.run(3.0);
  bench.sensor.override_scan = [](int, std::string) { return std::string(); };
  bench.run(5.0);
  EXPECT_GE(bench.all<ScipReopenEvent>().size(), 1U);
  EXPECT_GE(bench.count(ScipTrouble::Silence), 3U);
  bench.sensor.override_scan = nullptr;
  bench.run(15.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
  EXPECT_GT(bench.session.counters().scans, 100U);
}

TEST(ScipSession, loses_one_scan_to_each_corrupt_message) {
  Bench bench;
  bench.sensor.override_scan = [](int number, std::string bytes) {
    if (number % 10 == 5) bytes[static_cast<std::size_t>(number) % 3000] ^= 0x01;
    return bytes;
  };
  bench.run(10.0);
  const auto scans = bench.all<LaserScan>();
  const auto total = static_cast<double>(bench.sensor.scans_sent);
  EXPECT_NEAR(static_cast<double>(scans.size()), 0.9 * total, 2.0);
  EXPECT_NEAR(static_cast<double>(bench.count(ScipTrouble::Corrupt) + bench.count(ScipTrouble::Unexpected)),
              0.1 * total, 2.0);
  EXPECT_EQ(bench.sent("MD0000108001000"), 1);
  EXPECT_EQ(scans.back().sequence + 1, static_cast<std::uint64_t>(bench.sensor.scans_sent));
}

TEST(ScipSession, finds_the_scan_behind_one_whose_end_was_lost) {
  Bench bench;
  bench.sensor.override_scan = [](int number, std::string bytes) {
    if (number == 30) bytes.resize(bytes.size() - 1000);
    return bytes;
  };
  bench.run(3.0);
  EXPECT_EQ(bench.session.counters().scans + 1, static_cast<std::uint64_t>(bench.sensor.scans_sent));
  EXPECT_EQ(bench.count(ScipTrouble::Corrupt), 1U);
}

TEST(ScipSession, waits_while_the_sensor_checks_itself) {
  Bench bench;
  bench.run(2.0);
  const auto scans_before = bench.session.counters().scans;
  bench.sensor.override_scan = [](int, std::string) { return std::string(); };
  bench.sensor.add_message(bench.now_ns, encode_reply("MD0000108001000", "21"));
  bench.run(3.0);
  bench.sensor.add_message(bench.now_ns, encode_reply("MD0000108001000", "98"));
  bench.sensor.override_scan = nullptr;
  bench.run(1.0);
  EXPECT_EQ(bench.count(ScipTrouble::SelfCheck), 1U);
  EXPECT_EQ(bench.count(ScipTrouble::Silence), 0U);
  EXPECT_EQ(bench.sent("MD0000108001000"), 1);
  EXPECT_GT(bench.session.counters().scans, scans_before + 30);
}

TEST(ScipSession, does_not_wait_without_end_for_a_sensor_that_goes_on_checking_itself) {
  Bench bench;
  bench.run(2.0);
  bench.sensor.override_scan = [](int, std::string) { return std::string(); };
  for (int i = 0; i < 9; ++i) {
    bench.sensor.add_message(bench.now_ns, encode_reply("MD0000108001000", "21"));
    bench.run(1.0);
  }
  EXPECT_EQ(bench.count(ScipTrouble::Silence), 0U);
  bench.sensor.add_message(bench.now_ns, encode_reply("MD0000108001000", "21"));
  bench.run(2.0);
  EXPECT_GE(bench.count(ScipTrouble::Silence), 1U);
}

TEST(ScipSession, restarts_the_stream_after_a_hardware_status) {
  Bench bench;
  bench.run(2.0);
  bench.sensor.add_message(bench.now_ns, encode_reply("MD0000108001000", "50"));
  bench.run(2.0);
  EXPECT_EQ(bench.count(ScipTrouble::SensorFault), 1U);
  EXPECT_EQ(bench.sent("MD0000108001000"), 2);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, reports_a_clock_that_is_set_back_and_goes_on) {
  Bench bench;
  bench.run(3.0);
  bench.sensor.reset_clock(bench.now_ns);
  bench.run(3.0);
  EXPECT_EQ(bench.count(ScipTrouble::ClockReset), 1U);
  const auto scans = bench.all<LaserScan>();
  for (std::size_t i = 1; i < scans.size(); ++i) {
    ASSERT_EQ(scans[i].sequence, scans[i - 1].sequence + 1);
    ASSERT_NEAR(static_cast<double>(scans[i].first_beam_stamp_ns - scans[i - 1].first_beam_stamp_ns), 25e6, 1.1e6);
  }
}

TEST(ScipSession, reports_a_stamp_that_three_scans_carry) {
  Bench bench;
  bench.run(2.0);
  ScanRequest request;
  RawScan scan{77777, std::vector<std::uint32_t>(1081, 500), {}};
  const std::string bytes = encode_reply(to_command(request), "99", encode_scan_data(scan, request));
  bench.sensor.override_scan = [&](int, std::string) { return bytes; };
  bench.run(1.0);
  EXPECT_EQ(bench.count(ScipTrouble::RepeatedStamp), 1U);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, drops_bytes_without_end_and_restarts) {
  Bench bench;
  bench.run(2.0);
  bench.sensor.override_scan = [](int, std::string) { return std::string(3000, 'x'); };
  bench.run(1.0);
  EXPECT_GE(bench.count(ScipTrouble::Overflow), 1U);
  bench.sensor.override_scan = nullptr;
  bench.run(10.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, asks_again_for_a_corrupt_description) {
  Bench bench;
  int asked = 0;
  bench.sensor.override_reply = [&](const std::string& command) -> std::optional<std::string> {
    if (command != "PP" || ++asked > 1) return std::nullopt;
    std::string bad = samples::kParameters;
    bad[bad.find("1440")] = '2';
    return bad;
  };
  bench.run(3.0);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(bench.count(ScipTrouble::Corrupt), 1U);
  EXPECT_EQ(bench.session.device().parameters.steps_per_turn, 1440);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, survives_any_noise) {
  std::uint32_t state = 12345;
  const auto random = [&] { return (state = state * 1664525U + 1013904223U) >> 16; };
  Bench bench;
  for (int i = 0; i < 3000; ++i) {
    std::string noise(random() % 300, '\0');
    for (char& c : noise) c = random() % 8 == 0 ? '\n' : static_cast<char>(random());
    bench.take(bench.session.on_bytes(noise, bench.now_ns));
    bench.session.take_output();
    bench.now_ns += static_cast<HostStamp>(random() % 50) * kMs;
    if (i % 100 == 0) bench.events.clear();
  }
  EXPECT_EQ(bench.session.counters().scans, 0U);
  bench.sensor.is_streaming = false;
  bench.run(30.0);
  EXPECT_EQ(bench.session.state(), ScipState::Streaming);
}

TEST(ScipSession, says_when_it_next_wants_to_be_called) {
  ScipSession session{ScipOptions{}};
  EXPECT_LE(session.deadline(), 0);
  session.on_time(0);
  EXPECT_EQ(session.deadline(), 150 * kMs);
  EXPECT_TRUE(session.take_output().empty());
  session.on_time(150 * kMs);
  EXPECT_EQ(session.take_output(), "\nQT\n");
  EXPECT_EQ(session.deadline(), 1150 * kMs);
}

TEST(ScipOptions, choose_a_window_within_the_field_of_view) {
  const SensorParameters sensor;
  ScipOptions options;
  EXPECT_EQ(to_command(make_request(options, sensor)), "MD0000108001000");
  options.min_angle_rad = -std::numbers::pi / 4;
  options.max_angle_rad = std::numbers::pi / 2;
  options.cluster = 2;
  options.skip_scan = 1;
  EXPECT_EQ(to_command(make_request(options, sensor)), "MD0360090002100");
  options.min_angle_rad = -3.0;
  options.max_angle_rad = -2.9;
  EXPECT_EQ(make_request(options, sensor).last_step, 1080);
}

TEST(ScipOptions, name_what_is_wrong) {
  EXPECT_EQ(ScipOptions{}.problem(), "");
  ScipOptions options;
  options.command_timeout_s = 0.01;
  EXPECT_EQ(options.problem(), "command_timeout_s must lie between 0.14 and 10");
  options = {};
  options.max_angle_rad = options.min_angle_rad;
  EXPECT_NE(options.problem().find("window"), std::string::npos);
  options = {};
  options.clock.max_gap_s = 0.0;
  EXPECT_NE(options.problem().find("max_gap"), std::string::npos);
}

TEST(ScipOptions, refuse_intensities_that_overload_the_sensor_unless_forced) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  ScipOptions options;
  options.intensities = true;
  EXPECT_NE(options.problem().find("intensities"), std::string::npos);
  const auto accepts = [&](auto change) {
    ScipOptions changed = options;
    change(changed);
    return changed.problem().empty();
  };
  EXPECT_TRUE(accepts([](ScipOptions& o) { o.cluster = 3; }));
  EXPECT_FALSE(accepts([](ScipOptions& o) { o.cluster = 2; }));
  EXPECT_TRUE(accepts([](ScipOptions& o) { o.skip_scan = 1; }));
  EXPECT_TRUE(accepts([](ScipOptions& o) { o.force_intensities = true; }));
  EXPECT_TRUE(accepts([](ScipOptions& o) { o.min_angle_rad = -47 * kDegree, o.max_angle_rad = 48 * kDegree; }));
  EXPECT_FALSE(accepts([](ScipOptions& o) { o.min_angle_rad = -48 * kDegree, o.max_angle_rad = 48 * kDegree; }));
  EXPECT_TRUE(accepts([](ScipOptions& o) { o.max_angle_rad = 55 * kDegree, o.cluster = 2; }));
}

}  // namespace
}  // namespace stairway::drivers
