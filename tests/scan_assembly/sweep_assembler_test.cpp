// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_assembly/sweep_assembler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/scan_assembly/turning_scanner.hpp"

namespace stairway::scan {
namespace {

constexpr drivers::HostStamp kMs = 1'000'000;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

// Scans and angles interleaved as they come live: the angle every 5 ms, a scan 23.5 ms after its turn began.
struct Rig {
  TurningScanner scanner;
  SweepAssembler assembler;
  std::vector<Sweep> sweeps;
  std::uint64_t scans = 0;
  std::vector<drivers::LaserScan> fed;

  explicit Rig(const TurningScanner& from, const SweepOptions& options = {})
      : scanner(from), assembler(from.calibration, options) {}

  void add_angle(drivers::HostStamp at_ns) {
    const drivers::AngleSample sample = scanner.sample(at_ns);
    assembler.add(std::span(&sample, 1));
  }

  void run(double seconds) {
    for (drivers::HostStamp at_ns = -5 * kMs; at_ns <= std::llround(seconds * 1e9); at_ns += 5 * kMs) {
      while (TurningScanner::scan_begin_ns(scans) + 20 * kMs <= at_ns) assembler.add(scanner.scan(scans++));
      add_angle(at_ns);
      take();
    }
  }

  void take() {
    while (auto sweep = assembler.take_sweep()) sweeps.push_back(std::move(*sweep));
  }
};

TurningScanner fast_scanner(double speed_rad_s) {
  TurningScanner scanner;
  scanner.speed_rad_s = speed_rad_s;
  scanner.angle_at_zero_rad = 0.5;
  return scanner;
}

double distance_to_room_m(const TurningScanner& scanner, const Sweep& sweep) {
  double worst = 0.0;
  for (const Eigen::Vector3f& point : sweep.cloud.points) {
    worst = std::max(worst, scanner.distance_to_room_m(point.cast<double>()));
  }
  return worst;
}

TEST(SweepAssembler, cuts_a_sweep_per_turn_of_the_disk_in_either_direction) {
  for (const double speed_rad_s : {kTurn_rad, -kTurn_rad}) {
    SCOPED_TRACE(speed_rad_s);
    Rig rig(fast_scanner(speed_rad_s));
    rig.run(4.5);
    ASSERT_GE(rig.sweeps.size(), 4U);
    EXPECT_FALSE(rig.sweeps[0].statistics.is_whole_turn);
    for (std::size_t i = 1; i < rig.sweeps.size(); ++i) {
      const Sweep& sweep = rig.sweeps[i];
      EXPECT_EQ(sweep.number, i);
      EXPECT_EQ(sweep.statistics.end, SweepEnd::FullTurn);
      EXPECT_TRUE(sweep.statistics.is_whole_turn);
      EXPECT_TRUE(sweep.statistics.flaws().empty());
      EXPECT_NEAR(sweep.statistics.covered_angle_rad, kTurn_rad, 0.05);
      EXPECT_NEAR(static_cast<double>(sweep.end_ns - sweep.begin_ns), 1e9, 8e6);
      EXPECT_NEAR(static_cast<double>(sweep.cloud.points.size()), 40.0 * 1081, 400.0);
      EXPECT_EQ(sweep.lines.size(), sweep.cloud.points.size());
      EXPECT_EQ(sweep.beams.size(), sweep.cloud.points.size());
    }
  }
}

TEST(SweepAssembler, copy_of_the_sweep_under_way_is_what_the_whole_one_begins_with) {
  Rig rig(fast_scanner(kTurn_rad));
  EXPECT_EQ(rig.assembler.sweep_under_way(), nullptr);
  rig.run(1.5);
  ASSERT_NE(rig.assembler.sweep_under_way(), nullptr);
  const Sweep part = *rig.assembler.sweep_under_way();
  rig.run(2.2);
  ASSERT_GT(rig.sweeps.size(), part.number);
  const Sweep& whole = rig.sweeps[part.number];
  EXPECT_EQ(part.number, whole.number);
  EXPECT_EQ(part.begin_ns, whole.begin_ns);
  EXPECT_LT(part.end_ns, 1'500 * kMs);
  EXPECT_GT(part.end_ns, 1'440 * kMs);
  const double seconds = 1e-9 * static_cast<double>(part.end_ns - part.begin_ns);
  EXPECT_NEAR(part.statistics.covered_angle_rad, kTurn_rad * seconds, 0.05);
  EXPECT_EQ(part.statistics.beams.kept, part.cloud.points.size());
  EXPECT_EQ(part.cloud.sensor_origin, whole.cloud.sensor_origin);
  ASSERT_GT(part.cloud.points.size(), 10000U);
  ASSERT_LT(part.cloud.points.size(), whole.cloud.points.size());
  EXPECT_TRUE(std::equal(part.cloud.points.begin(), part.cloud.points.end(), whole.cloud.points.begin()));
}

TEST(SweepAssembler, gives_a_flat_room_although_the_disk_turns_fast) {
  Rig rig(fast_scanner(kTurn_rad));
  rig.run(2.2);
  ASSERT_GE(rig.sweeps.size(), 2U);
  for (const Sweep& sweep : rig.sweeps) EXPECT_LT(distance_to_room_m(rig.scanner, sweep), 3e-6);
  EXPECT_TRUE(rig.sweeps[1].cloud.sensor_origin->isApprox(Eigen::Vector3f(0.0F, 0.0F, 0.5F)));
}

TEST(SweepAssembler, loses_no_beam_at_a_cut) {
  Rig rig(fast_scanner(kTurn_rad));
  rig.run(3.0);
  rig.assembler.flush();
  rig.take();
  std::uint64_t points = 0, scans = 0;
  for (const Sweep& sweep : rig.sweeps) {
    EXPECT_EQ(sweep.statistics.beams.kept, sweep.cloud.points.size());
    points += sweep.cloud.points.size();
    scans += sweep.statistics.scans;
  }
  EXPECT_EQ(points, rig.scans * 1081);
  EXPECT_EQ(scans, rig.scans);
}

TEST(SweepAssembler, gives_the_same_cloud_for_every_interleaving) {
  const TurningScanner scanner = fast_scanner(3.0);
  const auto assemble = [&](drivers::HostStamp angle_lead_ns) {
    SweepOptions options;
    options.max_waiting_scans = 100;
    Rig rig(scanner, options);
    drivers::HostStamp angle_ns = -5 * kMs;
    for (std::uint64_t n = 0; n < 60; ++n) {
      for (; angle_ns < TurningScanner::scan_begin_ns(n) + angle_lead_ns; angle_ns += 5 * kMs) rig.add_angle(angle_ns);
      rig.assembler.add(scanner.scan(n));
    }
    for (; angle_ns < 1600 * kMs; angle_ns += 5 * kMs) rig.add_angle(angle_ns);
    rig.assembler.flush();
    rig.take();
    std::vector<Eigen::Vector3f> points;
    for (const Sweep& sweep : rig.sweeps) {
      points.insert(points.end(), sweep.cloud.points.begin(), sweep.cloud.points.end());
    }
    return points;
  };
  const auto in_step = assemble(0);
  EXPECT_EQ(in_step.size(), 60U * 1081U);
  EXPECT_EQ(assemble(-700 * kMs), in_step);
  EXPECT_EQ(assemble(2000 * kMs), in_step);
}

TEST(SweepAssembler, holds_a_scan_back_until_the_angle_of_its_last_beam_is_known) {
  const TurningScanner scanner = fast_scanner(1.0);
  Rig rig(scanner);
  rig.add_angle(-1 * kMs);
  rig.add_angle(10 * kMs);
  rig.assembler.add(scanner.scan(0));
  EXPECT_EQ(rig.assembler.waiting_scans(), 1U);
  rig.add_angle(18 * kMs);
  EXPECT_EQ(rig.assembler.waiting_scans(), 1U);
  rig.add_angle(19 * kMs);
  EXPECT_EQ(rig.assembler.waiting_scans(), 0U);
}

TEST(SweepAssembler, tells_of_scans_that_could_not_wait_for_their_angle) {
  const TurningScanner scanner = fast_scanner(1.0);
  SweepOptions options;
  options.max_waiting_scans = 5;
  options.max_duration_s = 1.0;
  Rig rig(scanner, options);
  for (std::uint64_t n = 0; n < 50; ++n) {
    rig.assembler.add(scanner.scan(n));
    EXPECT_LE(rig.assembler.waiting_scans(), 5U);
  }
  rig.take();
  ASSERT_EQ(rig.sweeps.size(), 1U);
  const Sweep& sweep = rig.sweeps.front();
  EXPECT_TRUE(sweep.cloud.points.empty());
  EXPECT_EQ(sweep.statistics.end, SweepEnd::TimeLimit);
  EXPECT_EQ(sweep.statistics.hurried_scans, 40U);
  EXPECT_EQ(sweep.statistics.beams.no_angle, 40U * 1081U);
  const auto flaws = sweep.statistics.flaws();
  EXPECT_NE(std::ranges::find(flaws, "holds no point"), flaws.end());
  EXPECT_NE(std::ranges::find(flaws, "no disk angle for 100 % of the beams"), flaws.end());
}

TEST(SweepAssembler, counts_lost_scans_and_keeps_their_lines_free) {
  Rig rig(fast_scanner(kTurn_rad));
  rig.scanner.angle_at_zero_rad = 0.0;
  for (drivers::HostStamp at_ns = -5 * kMs; at_ns < 1100 * kMs; at_ns += 5 * kMs) rig.add_angle(at_ns);
  for (const std::uint64_t sequence : {3U, 4U, 8U, 9U, 20U}) rig.assembler.add(rig.scanner.scan(sequence));
  rig.assembler.flush();
  rig.take();
  ASSERT_EQ(rig.sweeps.size(), 1U);
  const Sweep& sweep = rig.sweeps.front();
  EXPECT_EQ(sweep.statistics.lost_scans, 13U);
  EXPECT_EQ(sweep.statistics.scans, 5U);
  EXPECT_EQ(sweep.statistics.end, SweepEnd::Flushed);
  std::vector<std::uint32_t> lines(sweep.lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  EXPECT_EQ(lines, (std::vector<std::uint32_t>{0, 1, 5, 6, 17}));
}

TEST(SweepAssembler, takes_a_stream_that_begins_anew_without_inventing_losses) {
  Rig rig(fast_scanner(1.0));
  for (drivers::HostStamp at_ns = -5 * kMs; at_ns < 300 * kMs; at_ns += 5 * kMs) rig.add_angle(at_ns);
  for (const std::uint64_t sequence : {5U, 6U}) rig.assembler.add(rig.scanner.scan(sequence));
  drivers::LaserScan scan = rig.scanner.scan(8);
  scan.sequence = 0;
  rig.assembler.add(scan);
  scan = rig.scanner.scan(9);
  scan.sequence = ~0ULL;
  rig.assembler.add(scan);
  rig.assembler.flush();
  rig.take();
  ASSERT_EQ(rig.sweeps.size(), 2U);
  EXPECT_EQ(rig.sweeps[0].statistics.lost_scans, 0U);
  EXPECT_EQ(rig.sweeps[0].lines.back(), 2U);
  EXPECT_EQ(rig.sweeps[1].statistics.lost_scans, 0U);
}

TEST(SweepAssembler, cuts_once_where_the_disk_trembles_about_a_whole_turn) {
  TurningScanner scanner = fast_scanner(0.0);
  Rig rig(scanner);
  const auto angle_at = [](drivers::HostStamp at_ns) {
    const double seconds = static_cast<double>(at_ns) * 1e-9;
    return kTurn_rad - 0.025 + 0.05 * seconds + 0.005 * std::sin(60.0 * seconds);
  };
  for (std::uint64_t n = 0; n < 40; ++n) {
    for (drivers::HostStamp ms = -5; ms < 25; ms += 5) {
      const auto at_ns = TurningScanner::scan_begin_ns(n) + ms * kMs;
      const drivers::AngleSample sample{at_ns, angle_at(at_ns), true};
      rig.assembler.add(std::span(&sample, 1));
    }
    rig.assembler.add(scanner.scan(n));
    rig.take();
  }
  EXPECT_EQ(rig.sweeps.size(), 1U);
}

TEST(SweepAssembler, does_not_call_it_a_whole_turn_when_the_disk_comes_back) {
  const TurningScanner scanner = fast_scanner(0.0);
  Rig rig(scanner);
  // Up over a whole turn, half a turn on, back down over it, and on.
  const auto angle_at = [](double seconds) { return kTurn_rad + 3.0 - 3.5 * std::abs(seconds - 1.0); };
  std::uint64_t n = 0;
  for (drivers::HostStamp at_ns = 0; at_ns < 2000 * kMs; at_ns += 5 * kMs) {
    const drivers::AngleSample sample{at_ns, angle_at(static_cast<double>(at_ns) * 1e-9), true};
    rig.assembler.add(std::span(&sample, 1));
    if (TurningScanner::scan_begin_ns(n) + 20 * kMs <= at_ns) rig.assembler.add(scanner.scan(n++));
    rig.take();
  }
  ASSERT_EQ(rig.sweeps.size(), 2U);
  EXPECT_FALSE(rig.sweeps[1].statistics.is_whole_turn);
  EXPECT_NEAR(rig.sweeps[1].statistics.covered_angle_rad, 3.0, 0.1);
}

TEST(SweepAssembler, stream_that_begins_anew_begins_a_sweep_and_loses_no_scan) {
  Rig rig(fast_scanner(kTurn_rad));
  for (drivers::HostStamp at_ns = 0; at_ns < 400 * kMs; at_ns += 5 * kMs) rig.add_angle(at_ns);
  for (const std::uint64_t n : {3U, 4U, 5U}) rig.assembler.add(rig.scanner.scan(n));
  for (const std::uint64_t n : {6U, 7U}) {
    auto scan = rig.scanner.scan(n);
    scan.sequence += kMaxLostScans + 1;
    rig.assembler.add(std::move(scan));
  }
  rig.assembler.flush();
  rig.take();
  ASSERT_EQ(rig.sweeps.size(), 2U);
  EXPECT_EQ(rig.sweeps[0].statistics.end, SweepEnd::NewStream);
  EXPECT_EQ(rig.sweeps[0].statistics.scans, 3U);
  EXPECT_FALSE(rig.sweeps[0].statistics.is_whole_turn);
  EXPECT_EQ(rig.sweeps[1].statistics.scans, 2U);
  EXPECT_EQ(rig.sweeps[1].statistics.lost_scans, 0U);
}

TEST(SweepAssembler, gives_a_sweep_of_a_disk_that_stands) {
  SweepOptions options;
  options.max_duration_s = 0.5;
  Rig rig(fast_scanner(0.0), options);
  rig.run(1.2);
  ASSERT_EQ(rig.sweeps.size(), 2U);
  EXPECT_EQ(rig.sweeps[0].statistics.end, SweepEnd::TimeLimit);
  EXPECT_EQ(rig.sweeps[0].cloud.points.size(), 20U * 1081U);
  EXPECT_FALSE(rig.sweeps[0].statistics.flaws().empty());
}

TEST(SweepAssembler, never_holds_more_points_than_allowed) {
  SweepOptions options;
  options.max_points = 10000;
  Rig rig(fast_scanner(0.1), options);
  rig.run(1.0);
  ASSERT_GE(rig.sweeps.size(), 3U);
  for (const Sweep& sweep : rig.sweeps) {
    EXPECT_LE(sweep.cloud.points.size(), 10000U);
    EXPECT_EQ(sweep.statistics.end, SweepEnd::PointLimit);
  }
}

TEST(SweepAssembler, keeps_the_newest_sweeps_when_nobody_takes_them) {
  const TurningScanner scanner = fast_scanner(kTurn_rad);
  Rig rig(scanner);
  for (drivers::HostStamp at_ns = -5 * kMs; at_ns < 5000 * kMs; at_ns += 5 * kMs) rig.add_angle(at_ns);
  for (std::uint64_t n = 0; n < 190; ++n) rig.assembler.add(scanner.scan(n));
  EXPECT_EQ(rig.assembler.untaken_sweeps(), 2U);
  EXPECT_EQ(rig.assembler.take_sweep()->number, 2U);
  EXPECT_EQ(rig.assembler.take_sweep()->number, 3U);
  EXPECT_FALSE(rig.assembler.take_sweep());
}

TEST(SweepOptions, name_what_is_wrong) {
  EXPECT_EQ(SweepOptions{}.problem(), "");
  SweepOptions options;
  options.max_range_m = 0.05;
  EXPECT_NE(options.problem().find("max_range"), std::string::npos);
  options = {};
  options.max_waiting_scans = 0;
  EXPECT_NE(options.problem().find("max_waiting_scans"), std::string::npos);
  options = {};
  options.angle.max_gap_s = -1.0;
  EXPECT_NE(options.problem().find("max_gap"), std::string::npos);
}

}  // namespace
}  // namespace stairway::scan
