// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/drivers/encoder_bench.hpp"
#include "tools/sim/random.hpp"

namespace stairway::test {
namespace {

using drivers::EncoderLine;
using drivers::EncoderOptions;
using drivers::EncoderSession;
using drivers::EncoderState;
using drivers::EncoderTrouble;
using drivers::QuadratureDecoder;
using drivers::QuadratureStep;

EncoderOptions coarse() {
  EncoderOptions options;
  options.counts_per_turn = 400;
  return options;
}

TEST(QuadratureDecoder, reads_every_pair_of_levels) {
  using enum QuadratureStep;
  const QuadratureStep table[4][4] = {{None, Forward, Backward, Illegal},
                                      {Backward, None, Illegal, Forward},
                                      {Forward, Illegal, None, Backward},
                                      {Illegal, Backward, Forward, None}};
  for (int from = 0; from < 4; ++from) {
    for (int to = 0; to < 4; ++to) {
      QuadratureDecoder decoder((from & 2) != 0, (from & 1) != 0);
      EXPECT_EQ(decoder.take((to & 2) != 0, (to & 1) != 0), table[from][to]) << from << " -> " << to;
      EXPECT_EQ(decoder.take((to & 2) != 0, (to & 1) != 0), None);
    }
  }
}

TEST(DiskEncoder, tells_the_angle_since_the_first_index) {
  for (const double speed : {1.0, -1.0, 0.18, 30.0}) {
    SCOPED_TRACE(speed);
    EncoderBench bench(coarse(), -0.1 * speed / std::abs(speed), speed);
    bench.run(3.0 * kTurn_rad / std::abs(speed));
    EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
    EXPECT_EQ(bench.session().counters().indices, 3U);
    EXPECT_LE(bench.worst_error_counts(), 0.01);
    EXPECT_FALSE(bench.samples.front().valid);
    EXPECT_TRUE(bench.samples.back().valid);
    EXPECT_TRUE(bench.details.empty()) << bench.details.front();
    const auto measured = bench.session().speed_rad_s(bench.now_ns);
    ASSERT_TRUE(measured);
    EXPECT_NEAR(*measured, speed, 1e-3 * std::abs(speed));
  }
}

TEST(DiskEncoder, follows_any_motion_within_a_count) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    sim::Random random(seed);
    EncoderBench bench(coarse(), random.uniform(-3.0, 3.0), 2.0);
    bench.run(7.0);  // past the index
    ASSERT_EQ(bench.session().state(), EncoderState::Indexed);
    for (int change = 0; change < 30; ++change) {
      bench.motion.set_speed(bench.now_ns, random.uniform(-3.0, 3.0));
      bench.run(random.uniform(0.001, 2.0));
    }
    EXPECT_LE(bench.worst_error_counts(), 1.01);
    EXPECT_TRUE(bench.details.empty()) << bench.details.front();
  }
}

TEST(DiskEncoder, samples_come_in_order_and_not_more_than_200_ms_apart) {
  EncoderBench bench(coarse(), -0.1, 1.0);
  bench.run(1.0);
  bench.motion.set_speed(bench.now_ns, 0.0);
  bench.run(1.0);
  bench.motion.set_speed(bench.now_ns, -0.05);
  bench.run(5.0);
  ASSERT_GT(bench.samples.size(), 100U);
  for (std::size_t i = 1; i < bench.samples.size(); ++i) {
    const auto step_ns = bench.samples[i].stamp_ns - bench.samples[i - 1].stamp_ns;
    EXPECT_GT(step_ns, 0);
    EXPECT_LE(step_ns, 200'000'000);
  }
}

TEST(DiskEncoder, says_standstill_by_speed_zero) {
  EncoderBench bench(coarse(), -0.1, 1.0);
  bench.run(1.0);
  bench.motion.set_speed(bench.now_ns, 0.0);
  bench.run(1.0);
  EXPECT_EQ(bench.session().speed_rad_s(bench.now_ns), 0.0);
}

TEST(EncoderSession, tells_the_speed_of_an_encoder_whose_lines_are_of_uneven_width) {
  EncoderSession session(coarse());
  session.on_open({0, 0, false, false, false}, 16);
  // B leads; A is high for less than half of the period, and late.
  constexpr drivers::HostStamp kPeriod_ns = 4'000'000;
  for (drivers::HostStamp at_ns = kPeriod_ns; at_ns < 10 * kPeriod_ns; at_ns += kPeriod_ns) {
    const std::vector<drivers::Edge> edges{{at_ns, EncoderLine::B, true},
                                           {at_ns + 1'300'000, EncoderLine::A, true},
                                           {at_ns + 1'900'000, EncoderLine::B, false},
                                           {at_ns + 2'500'000, EncoderLine::A, false}};
    session.on_edges({edges, 0, edges.back().stamp_ns});
    if (at_ns < 3 * kPeriod_ns) continue;
    EXPECT_NEAR(session.speed_rad_s(at_ns + 2'500'000).value_or(0.0), kTurn_rad / 100.0 / 4e-3, 1e-9);
  }
}

TEST(DiskEncoder, a_reversed_encoder_turns_the_other_way) {
  EncoderOptions options = coarse();
  options.reverse = true;
  EncoderBench bench(options, 0.1, -1.0);
  bench.lines.faults().is_swapped = true;
  bench.run(8.0);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  EXPECT_LE(bench.worst_error_counts(), 0.01);
}

TEST(DiskEncoder, without_an_index_line_the_start_is_zero) {
  EncoderOptions options = coarse();
  options.line_index = "";
  EncoderBench bench(options, 0.0, 1.0);
  bench.run(8.0);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  EXPECT_TRUE(bench.samples.front().valid);
  EXPECT_LE(bench.worst_error_counts(), 1.0);
}

TEST(DiskEncoder, takes_an_eccentric_disks_error_off) {
  EncoderOptions options = coarse();
  options.harmonic_rad = 0.02;
  options.harmonic_phase_rad = 0.7;
  EncoderBench bench(options);
  bench.run(8.0);
  double most = 0.0;
  for (const drivers::AngleSample& sample : bench.samples) {
    const double raw = bench.motion.angle_at(sample.stamp_ns);
    if (!sample.valid) continue;
    EXPECT_NEAR(sample.angle_rad, raw - 0.02 * std::sin(raw + 0.7), 1e-6);
    most = std::max(most, std::abs(sample.angle_rad - raw));
  }
  EXPECT_NEAR(most, 0.02, 1e-3);
}

struct LostCase {
  const char* name;
  void (*damage)(sim::FakeEncoderFaults&);
  EncoderTrouble trouble;
};

class LostEdges : public testing::TestWithParam<LostCase> {};

TEST_P(LostEdges, are_counted_and_make_angles_invalid_until_the_next_index) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  ASSERT_EQ(bench.session().state(), EncoderState::Indexed);
  GetParam().damage(bench.lines.faults());
  bench.run(0.2);
  EXPECT_GE(bench.count(GetParam().trouble), 1U);
  EXPECT_EQ(bench.session().counters().lost_edges, GetParam().trouble == EncoderTrouble::LostEdges ? 5U : 0U);
  EXPECT_EQ(bench.session().state(), EncoderState::Unindexed);
  EXPECT_FALSE(bench.samples.back().valid);
  bench.run(kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  const std::size_t before = bench.samples.size();
  bench.run(1.0);
  bench.samples.erase(bench.samples.begin(), bench.samples.begin() + static_cast<std::ptrdiff_t>(before));
  EXPECT_LE(bench.worst_error_counts(), 0.01);
  EXPECT_TRUE(bench.samples.back().valid);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LostEdges,
    testing::Values(LostCase{"one", [](sim::FakeEncoderFaults& f) { f.dropped_edges = 1; }, EncoderTrouble::MissedPair},
                    LostCase{"two", [](sim::FakeEncoderFaults& f) { f.dropped_edges = 2; }, EncoderTrouble::MissedPair},
                    LostCase{"told", [](sim::FakeEncoderFaults& f) { f.lost_edges = 5; }, EncoderTrouble::LostEdges}),
    [](const auto& tested) { return tested.param.name; });

TEST(DiskEncoder, edges_lost_by_whole_periods_are_found_at_the_index) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  bench.lines.faults().dropped_edges = 8;  // two whole periods: nothing looks wrong until the index
  bench.run(kTurn_rad);
  EXPECT_EQ(bench.count(EncoderTrouble::IndexDeviation), 1U);
  EXPECT_EQ(bench.session().state(), EncoderState::Unindexed);
  bench.run(kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
}

TEST(DiskEncoder, an_early_or_late_index_is_a_fault_from_beyond_the_tolerance_on) {
  for (const double speed : {1.0, -1.0}) {
    for (const int shift : {-40, -3, -2, -1, 1, 2, 3, 40}) {
      SCOPED_TRACE(testing::Message() << "by " << shift << " counts at " << speed << " rad/s");
      EncoderBench bench(coarse(), -0.1 * speed, speed);
      bench.run(3.0);
      bench.lines.faults().index_shift = shift;
      bench.run(kTurn_rad);
      const bool is_fault = std::abs(shift) > 2;
      EXPECT_EQ(bench.count(EncoderTrouble::IndexDeviation), is_fault ? 1U : 0U);
      EXPECT_EQ(bench.session().state(), is_fault ? EncoderState::Unindexed : EncoderState::Indexed);
      EXPECT_LE(bench.worst_error_counts(), 2.01);
      bench.run(kTurn_rad);
      EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
    }
  }
}

TEST(DiskEncoder, takes_a_wide_index_at_the_same_place_both_ways) {
  EncoderOptions options = coarse();
  options.index_tolerance = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    sim::Random random(seed);
    EncoderBench bench(options);
    bench.lines.faults().index_width = 12;
    bench.run(0.2);
    ASSERT_EQ(bench.session().state(), EncoderState::Indexed);
    for (int change = 0; change < 60; ++change) {
      const double place = bench.motion.angle_at(bench.now_ns);
      // Often close to one end of the mark.
      const double wanted_counts =
          random.chance(0.5) ? random.uniform(-30.0, 45.0) : random.integer(0, 1) * 12.0 + random.uniform(-1.0, 2.0);
      const double wanted = wanted_counts * kTurn_rad / 400.0;
      bench.motion.set_speed(bench.now_ns, wanted > place ? 1.0 : -1.0);
      bench.run(std::abs(wanted - place));
    }
    EXPECT_GT(bench.session().counters().indices, 10U);
    EXPECT_TRUE(bench.details.empty()) << bench.details.front();
    EXPECT_LE(bench.worst_error_counts(), 1.01);
  }
}

TEST(DiskEncoder, a_spurious_index_is_told_and_only_two_that_agree_are_believed) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  bench.lines.faults().spurious_indices = 1;
  bench.run(1.0);
  EXPECT_EQ(bench.count(EncoderTrouble::IndexDeviation), 1U);
  EXPECT_EQ(bench.session().state(), EncoderState::Unindexed);
  bench.run(2.0 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  const std::size_t before = bench.samples.size();
  bench.run(1.0);
  bench.samples.erase(bench.samples.begin(), bench.samples.begin() + static_cast<std::ptrdiff_t>(before));
  EXPECT_LE(bench.worst_error_counts(), 0.01);
}

TEST(DiskEncoder, a_dead_index_is_told_after_one_and_a_half_turns) {
  EncoderBench bench(coarse());
  bench.run(1.0);
  bench.lines.faults().is_index_dead = true;
  bench.run(1.3 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  bench.run(0.2 * kTurn_rad);
  EXPECT_EQ(bench.count(EncoderTrouble::IndexMissing), 1U);
  EXPECT_EQ(bench.session().state(), EncoderState::Unindexed);
  bench.lines.faults().is_index_dead = false;
  bench.run(1.1 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
}

TEST(DiskEncoder, a_dead_line_is_never_taken_for_an_angle) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  bench.lines.faults().is_a_dead = true;
  bench.run(2.0 * kTurn_rad);
  EXPECT_GE(bench.count(EncoderTrouble::DeadLine), 1U);
  EXPECT_EQ(bench.session().state(), EncoderState::Unindexed);
  bench.lines.faults().is_a_dead = false;
  bench.run(3.0 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
}

TEST(DiskEncoder, bounces_are_counted_off_exactly) {
  EncoderBench bench(coarse());
  bench.lines.faults().bounce_probability = 0.3;
  bench.run(3.0 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  EXPECT_LE(bench.worst_error_counts(), 0.1);
}

TEST(DiskEncoder, the_index_is_not_believed_where_the_disk_turns_round) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  const std::uint64_t indices = bench.session().counters().indices;
  // To and fro over the index, by less than four counts to either side.
  const double wanted_rad = kTurn_rad;
  bench.run(wanted_rad - bench.motion.angle_at(bench.now_ns) - 2.0 * kTurn_rad / 400.0);
  for (int i = 0; i < 20; ++i) {
    bench.motion.set_speed(bench.now_ns, i % 2 == 0 ? -1.0 : 1.0);
    bench.run(0.03);
  }
  EXPECT_LE(bench.session().counters().indices, indices + 1);
  bench.motion.set_speed(bench.now_ns, 1.0);
  bench.run(2.0 * kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  EXPECT_LE(bench.worst_error_counts(), 1.01);
}

TEST(DiskEncoder, comes_back_after_its_chip_was_away) {
  EncoderBench bench(coarse());
  bench.run(3.0);
  bench.is_plugged = false;
  bench.run(20.0);
  EXPECT_EQ(bench.session().state(), EncoderState::Absent);
  EXPECT_GE(bench.count(EncoderTrouble::Disconnected), 4U);
  EXPECT_LE(bench.count(EncoderTrouble::Disconnected), 8U);
  EXPECT_EQ(bench.details.back(), "no such chip");
  bench.is_plugged = true;
  bench.run(10.0 + kTurn_rad);
  EXPECT_EQ(bench.session().state(), EncoderState::Indexed);
  EXPECT_LE(bench.worst_error_counts(), 0.5);
}

TEST(DiskEncoder, warns_of_edges_faster_than_the_queue_allows) {
  EncoderOptions options;
  options.counts_per_turn = 40000;
  EncoderBench bench(options, -0.1, 2.0);
  bench.run(0.5);
  EXPECT_EQ(bench.count(EncoderTrouble::EdgeRate), 1U);
  EXPECT_NE(bench.details.back().find("edges per second"), std::string::npos);
}

TEST(EncoderSession, an_edge_from_just_before_a_repeated_angle_keeps_the_order) {
  EncoderSession session{EncoderOptions{}};
  session.on_open({0, 0, false, false, false}, 16);
  const auto repeated = session.on_edges({{}, 0, 60'000'000});
  const auto edge = session.on_edges({{{59'990'000, drivers::EncoderLine::B, true}}, 0, 60'100'000});
  ASSERT_FALSE(repeated.empty() || edge.empty());
  const auto& before = std::get<std::vector<drivers::AngleSample>>(repeated.front());
  const auto& after = std::get<std::vector<drivers::AngleSample>>(edge.front());
  EXPECT_EQ(before.back().stamp_ns, 60'000'000);
  EXPECT_EQ(after.front().stamp_ns, 60'000'000);
}

TEST(EncoderSession, an_index_among_edges_that_were_lost_is_not_believed) {
  const auto step = [](drivers::HostStamp stamp_ns, int count) {
    return drivers::Edge{stamp_ns, count % 2 == 0 ? EncoderLine::A : EncoderLine::B, count % 4 == 1 || count % 4 == 2};
  };
  const drivers::Edge index{25, EncoderLine::Index, true};
  const std::vector<drivers::Edge> passed{step(10, 1), step(20, 2), index, step(30, 3)};
  const std::vector<drivers::Edge> begun{step(10, 1), step(20, 2), index};
  for (const auto& edges : {passed, begun}) {
    for (const std::uint64_t lost : {0, 4}) {
      EncoderSession session(coarse());
      session.on_open({0, 0, false, false, false}, 16);
      session.on_edges({edges, lost, 30});
      EXPECT_EQ(session.wants_levels(), lost > 0);
      if (lost > 0) session.on_levels({31, 31, true, edges.size() == 3, true});
      session.on_edges({edges.size() == 4 ? std::vector{step(40, 4)} : std::vector{step(40, 3), step(50, 4)}, 0, 50});
      EXPECT_EQ(session.state(), lost > 0 ? EncoderState::Unindexed : EncoderState::Indexed);
    }
  }
}

TEST(EncoderSession, edges_older_than_the_levels_are_in_them_already) {
  EncoderSession session(coarse());
  session.on_open({100, 100, true, true, false}, 16);
  session.on_edges({{{98, EncoderLine::B, true}, {99, EncoderLine::A, true}}, 0, 100});
  EXPECT_FALSE(session.wants_levels());
  session.on_edges({{}, 1, 200});
  session.on_levels({200, 200, false, false, false});
  session.on_edges({{{198, EncoderLine::B, false}, {199, EncoderLine::A, false}}, 0, 200});
  EXPECT_FALSE(session.wants_levels());
  session.on_edges({{{201, EncoderLine::B, true}}, 0, 201});
  EXPECT_FALSE(session.wants_levels());
  EXPECT_EQ(session.counters().edges, 1U);
}

TEST(EncoderSession, an_edge_that_comes_while_the_levels_are_read_is_counted_unless_it_is_in_them) {
  struct Case {
    bool is_b_high;
    std::uint64_t edges;
  };
  for (const Case& read : {Case{false, 3}, Case{true, 2}}) {
    EncoderSession session(coarse());
    session.on_open({100, 200, false, read.is_b_high, false}, 16);
    session.on_edges(
        {{{150, EncoderLine::B, true}, {250, EncoderLine::A, true}, {350, EncoderLine::B, false}}, 0, 400});
    EXPECT_EQ(session.counters().edges, read.edges);
    EXPECT_EQ(session.counters().count(EncoderTrouble::MissedPair), 0U);

    session.on_edges({{}, 1, 500});
    session.on_levels({500, 600, true, read.is_b_high, false});
    session.on_edges({{{550, EncoderLine::B, true}, {650, EncoderLine::A, false}}, 0, 700});
    EXPECT_EQ(session.counters().edges, 2 * read.edges - 1);
    EXPECT_EQ(session.counters().count(EncoderTrouble::MissedPair), 0U);
    EXPECT_FALSE(session.wants_levels());
  }
}

TEST(EncoderSession, random_edges_do_not_break_it) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    sim::Random random(seed);
    EncoderSession session(coarse());
    session.on_open({1000, 1000, false, false, false}, 16);
    drivers::HostStamp stamp_ns = 1000, last_ns = 0;
    for (int i = 0; i < 200; ++i) {
      drivers::EdgeBatch batch;
      for (int edge = random.integer(0, 5); edge > 0; --edge) {
        stamp_ns += random.integer(-1000, 100000);
        batch.edges.push_back({stamp_ns, static_cast<EncoderLine>(random.integer(0, 2)), random.chance(0.5)});
      }
      batch.lost_edges = random.chance(0.02) ? 3 : 0;
      batch.complete_ns = stamp_ns;
      auto events = session.on_edges(batch);
      if (session.wants_levels())
        session.on_levels({stamp_ns, stamp_ns, random.chance(0.5), random.chance(0.5), false});
      EXPECT_FALSE(session.wants_levels());
      for (const auto& event : events) {
        const auto* samples = std::get_if<std::vector<drivers::AngleSample>>(&event);
        if (samples == nullptr) continue;
        for (const drivers::AngleSample& sample : *samples) {
          EXPECT_GE(sample.stamp_ns, last_ns);
          last_ns = sample.stamp_ns;
        }
      }
    }
  }
}

TEST(EncoderOptions, bad_values_are_named) {
  const std::pair<const char*, void (*)(EncoderOptions&)> cases[] = {
      {"chip", [](EncoderOptions& o) { o.chip = ""; }},
      {"line_a", [](EncoderOptions& o) { o.line_a = ""; }},
      {"another", [](EncoderOptions& o) { o.line_b = o.line_a; }},
      {"counts_per_turn", [](EncoderOptions& o) { o.counts_per_turn = 1023; }},
      {"index_tolerance", [](EncoderOptions& o) { o.index_tolerance = 2000; }},
      {"harmonic", [](EncoderOptions& o) { o.harmonic_rad = 1.0; }},
      {"event_buffer", [](EncoderOptions& o) { o.event_buffer = 1; }},
      {"debounce", [](EncoderOptions& o) { o.debounce_us = -1; }},
      {"max_backoff", [](EncoderOptions& o) { o.max_backoff_s = 0.1; }},
  };
  EXPECT_EQ(EncoderOptions().problem(), "");
  for (const auto& [word, damage] : cases) {
    EncoderOptions options;
    damage(options);
    EXPECT_NE(options.problem().find(word), std::string::npos) << word << ": " << options.problem();
  }
}

}  // namespace
}  // namespace stairway::test
