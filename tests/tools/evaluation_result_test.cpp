// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/evaluation/parallel_runs.hpp"
#include "tools/evaluation/result_json.hpp"
#include "tools/evaluation/table_text.hpp"

namespace stairway::evaluation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Table small_table() {
  return {.name = "small",
          .title = "A small table",
          .columns = {{"method", ""}, {"height_error", "mm", 1}, {"runs", "", 0}},
          .rows = {{std::string("ours"), -0.04, 10.0}, {std::string("longer name"), {}, kNan}}};
}

TEST(TableText, aligns_columns_and_marks_what_is_empty) {
  EXPECT_EQ(table_text(small_table()),
            "A small table\n"
            "  method       height error  runs\n"
            "                       [mm]\n"
            "  -------------------------------\n"
            "  ours                  0.0    10\n"
            "  longer name             -     -\n");
}

TEST(TableText, counts_characters_not_bytes) {
  const Table table{.name = "t",
                    .title = "T",
                    .columns = {{"name", ""}, {"n", "", 0}},
                    .rows = {{std::string("P\u00e9rez"), 1.0}, {std::string("Perez"), 2.0}}};
  EXPECT_EQ(table_text(table), "T\n  name   n\n  --------\n  P\u00e9rez  1\n  Perez  2\n");
}

TEST(TableText, wraps_notes_between_words) {
  const std::string text = result_text({.notes = {std::string(100, 'a') + " " + std::string(20, 'b')}});
  EXPECT_EQ(text, "- " + std::string(100, 'a') + "\n  " + std::string(20, 'b') + "\n");
}

TEST(ResultJson, states_what_was_run_and_every_cell) {
  const Experiment experiment{"small", "a summary", nullptr};
  const Request request{.seed = 18'446'744'073'709'551'615U, .share = 0.5};
  const std::string text = result_json(experiment, request, {.tables = {small_table()}, .notes = {"read \"this\"\n"}});
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["name"], "small");
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), 18'446'744'073'709'551'615U);
  EXPECT_EQ(json["share"], 0.5);
  EXPECT_EQ(json["notes"][0], "read \"this\"\n");
  const auto& table = json["tables"][0];
  EXPECT_EQ(table["columns"][1]["name"], "height_error");
  EXPECT_EQ(table["columns"][1]["unit"], "mm");
  EXPECT_EQ(table["rows"][0], nlohmann::json::parse(R"(["ours", -0.04, 10.0])"));
  EXPECT_EQ(table["rows"][1], nlohmann::json::parse(R"(["longer name", null, null])"));
}

TEST(RunInParallel, keeps_the_order_for_any_number_of_threads) {
  for (const unsigned threads : {1U, 2U, 7U}) {
    SCOPED_TRACE(threads);
    std::size_t told = 0;
    const auto squares = run_in_parallel(
        50, [](std::size_t i) { return i * i; }, [&](std::size_t finished) { EXPECT_EQ(finished, ++told); }, threads);
    ASSERT_EQ(squares.size(), 50U);
    for (std::size_t i = 0; i < squares.size(); ++i) EXPECT_EQ(squares[i], i * i);
    EXPECT_EQ(told, 50U);
  }
  EXPECT_TRUE(run_in_parallel(0, [](std::size_t i) { return i; }).empty());
}

TEST(RunInParallel, passes_the_first_failure_on_and_begins_nothing_more) {
  std::atomic<int> begun{0};
  const auto fail_at_3 = [&](std::size_t i) {
    ++begun;
    if (i == 3) throw std::runtime_error("no stairs");
    return 0;
  };
  EXPECT_THROW(run_in_parallel(1000, fail_at_3, {}, 1), std::runtime_error);
  EXPECT_EQ(begun, 4);
}

}  // namespace
}  // namespace stairway::evaluation
