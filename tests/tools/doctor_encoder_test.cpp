// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/tools/fake_machine.hpp"
#include "tools/doctor/encoder.hpp"

namespace stairway::doctor {
namespace {

using namespace drivers;

EncoderFacts good_facts() {
  return {
      .chips = {"gpiochip0"},
      .node = {.path = "/dev/gpiochip0", .exists = true, .is_usable = true, .group = "gpio", .is_open_to_group = true},
      .refusal = "",
      .lines = {{"A", 17, "GPIO17", "", false}, {"B", 27, "", "", false}, {"index", 22, "", "", false}}};
}

TEST(DoctorEncoder, every_fault_has_its_words) {
  struct Case {
    std::function<void(EncoderFacts&)> change;
    bool has_daemon;
    const char* name;
    State state;
    const char* part;
  };
  const auto take_a = [](const char* consumer) {
    return [consumer](EncoderFacts& f) { f.lines[0] = {"A", 17, "", consumer, true}; };
  };
  const Case table[] = {
      {[](auto&) {}, false, "encoder-lines", State::Ok, "A on 17 (GPIO17), B on 27, index on 22"},
      {[](auto& f) { f.chips.clear(), f.node.exists = false; }, false, "encoder", State::Failure, "no GPIO chip"},
      {[](auto& f) { f.node.exists = false, f.refusal = "there is gpiochip4"; }, false, "encoder", State::Failure,
       "there is gpiochip4"},
      {[](auto& f) { f.node.group = "root"; }, false, "encoder-access", State::Failure, "60-stairway.rules"},
      {[](auto& f) { f.node.is_usable = false; }, false, "encoder-access", State::Warning, "usermod -aG gpio"},
      {[](auto& f) { f.refusal = "no line of that name"; }, false, "encoder-lines", State::Failure, "of that name"},
      {take_a("w1"), false, "encoder-lines", State::Failure, "taken by w1"},
      {take_a(""), false, "encoder-lines", State::Failure, "taken by the kernel"},
      {take_a("stairwayd"), true, "encoder-lines", State::Ok, "A on 17"},
      {take_a("stairwayd"), false, "encoder-lines", State::Failure, "stairwayd"},
  };
  for (const Case& row : table) {
    SCOPED_TRACE(row.part);
    EncoderFacts facts = good_facts();
    row.change(facts);
    const auto checks = judge(facts, Caller{}, row.has_daemon);
    const auto found =
        std::find_if(checks.begin(), checks.end(), [&](const Check& check) { return check.name == row.name; });
    ASSERT_NE(found, checks.end());
    EXPECT_EQ(found->state, row.state) << found->text;
    EXPECT_NE((found->text + found->remedy).find(row.part), std::string::npos) << found->text << found->remedy;
  }
}

TEST(DoctorEncoder, a_machine_without_gpio_is_told) {
  const auto checks = judge(look_at_encoder(Machine("/nonexistent"), {}), {}, false);
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks.front().state, State::Failure);
  EXPECT_NE(checks.front().text.find("no GPIO chip"), std::string::npos);
}

TEST(DoctorEncoder, a_file_that_is_no_chip_is_told) {
  test::FakeMachine fake;
  fake.name_own_group("gpio");
  fake.node("/dev/gpiochip0", 0660);
  const EncoderFacts facts = look_at_encoder(fake.machine(), {});
  EXPECT_EQ(facts.chips, std::vector<std::string>{"gpiochip0"});
  EXPECT_TRUE(facts.node.exists);
  EXPECT_NE(facts.refusal.find("not a GPIO chip"), std::string::npos) << facts.refusal;
  EXPECT_EQ(judge(facts, {}, false).back().state, State::Failure);
}

/// Lines on which the edges are as scripted, one batch per read.
class ScriptedLines : public EdgePort {
 public:
  explicit ScriptedLines(HostStamp& now_ns) : now_ns_(now_ns) {}
  tl::expected<EdgeBatch, PortError> read(std::chrono::nanoseconds) override {
    if (is_removed) return tl::unexpected(PortError::Closed);
    now_ns_ += 100'000'000;
    return EdgeBatch{edges, lost_edges, now_ns_};
  }
  int queued_edges() const override { return 16; }
  tl::expected<LineLevels, PortError> levels() override { return LineLevels{now_ns_, now_ns_, true, false, false}; }

  std::vector<Edge> edges;
  std::uint64_t lost_edges = 0;
  bool is_removed = false;

 private:
  HostStamp& now_ns_;
};

struct Lines {
  HostStamp now_ns = 0;
  ScriptedLines port{now_ns};
  Check look() {
    return judge(count_edges(port, std::chrono::seconds(1), [this] { return now_ns; }));
  }
};

TEST(DoctorCounts, lines_at_rest_are_well_and_ask_for_a_turn) {
  Lines lines;
  const Check check = lines.look();
  EXPECT_EQ(check.state, State::Ok);
  EXPECT_NE(check.text.find("A high (0 edges), B low (0 edges)"), std::string::npos) << check.text;
  EXPECT_NE(check.text.find("by hand"), std::string::npos) << check.text;
}

TEST(DoctorCounts, edges_are_counted_by_line) {
  Lines lines;
  lines.port.edges = {{0, EncoderLine::A, true}, {0, EncoderLine::B, true}};
  const Check check = lines.look();
  EXPECT_EQ(check.state, State::Ok) << check.text;
  EXPECT_NE(check.text.find("A high (10 edges), B low (10 edges), index 0 edges in 1.0 s"), std::string::npos)
      << check.text;
}

TEST(DoctorCounts, a_queue_too_short_for_the_wanted_speed_is_told) {
  drivers::EncoderOptions options;
  options.counts_per_turn = 40000;
  CountFacts facts;
  facts.rate_problem = drivers::edge_rate_problem(options, 0.6, 16);
  EXPECT_EQ(judge(facts).state, State::Warning);
  EXPECT_NE(judge(facts).text.find("disk.period_s, 3820 edges per second"), std::string::npos) << judge(facts).text;
  EXPECT_EQ(drivers::edge_rate_problem(options, 0.6, 341), "");
  EXPECT_EQ(drivers::edge_rate_problem(options, 0.0, 16), "");
}

TEST(DoctorCounts, a_dead_line_lost_edges_and_a_lost_chip_are_told) {
  Lines dead;
  dead.port.edges = {{0, EncoderLine::A, true}};
  EXPECT_EQ(dead.look().state, State::Failure);
  Lines losing;
  losing.port.edges = {{0, EncoderLine::A, true}, {0, EncoderLine::B, true}};
  losing.port.lost_edges = 2;
  EXPECT_EQ(losing.look().state, State::Warning);
  EXPECT_NE(losing.look().text.find("20 lost"), std::string::npos);
  Lines removed;
  removed.port.is_removed = true;
  EXPECT_EQ(removed.look().state, State::Failure);
}

}  // namespace
}  // namespace stairway::doctor
