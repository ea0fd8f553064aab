// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "tests/tools/temporary_folder.hpp"
#include "tools/evaluation/axis.hpp"
#include "tools/evaluation/chart_drawing.hpp"

namespace stairway::evaluation {
namespace {

using Labels = std::vector<std::string>;

TEST(Axis, begins_and_ends_at_round_numbers_around_the_data) {
  const std::tuple<double, double, int, Labels> table[] = {
      {0.0, 6.5, 8, {"0", "1", "2", "3", "4", "5", "6", "7"}},
      {0.0, 0.3, 4, {"0.0", "0.1", "0.2", "0.3"}},
      {0.5, 6.5, 14, {"0.5", "1.0", "1.5", "2.0", "2.5", "3.0", "3.5", "4.0", "4.5", "5.0", "5.5", "6.0", "6.5"}},
      {-3.0, 17.0, 6, {"-5", "0", "5", "10", "15", "20"}},
      {0.0, 1234.0, 5, {"0", "500", "1000", "1500"}},
      {2.0, 2.0, 3, {"1", "2", "3"}},
      {0.0, 0.0, 3, {"-0.5", "0.0", "0.5"}},
  };
  for (const auto& [low, high, max_ticks, labels] : table) {
    SCOPED_TRACE(::testing::Message() << low << " to " << high);
    const Axis axis = linear_axis(low, high, max_ticks);
    EXPECT_EQ(axis.labels, labels);
    ASSERT_EQ(axis.ticks.size(), labels.size());
    EXPECT_LE(axis.low, low);
    EXPECT_GE(axis.high, high - 1e-9);
    EXPECT_DOUBLE_EQ(axis.share_of(axis.low), 0.0);
    EXPECT_DOUBLE_EQ(axis.share_of(axis.high), 1.0);
  }
}

TEST(Axis, never_has_more_ticks_than_there_is_room_for) {
  for (double high = 0.013; high < 1e5; high *= 1.7)
    for (const int max_ticks : {2, 3, 5, 9})
      for (const double low : {0.0, -0.37 * high, 0.21 * high})
        EXPECT_LE(linear_axis(low, high, max_ticks).ticks.size(),
                  static_cast<std::size_t>(max_ticks) + (low < 0 ? 1 : 0))
            << low << " to " << high << ", " << max_ticks;
}

TEST(Axis, logarithmic_ones_end_at_powers_of_ten) {
  const Axis wide = logarithmic_axis(0.2, 5e6);
  EXPECT_EQ(wide.labels, (Labels{"0.1", "1", "10", "100", "1000", "10000", "10\u2075", "10\u2076", "10\u2077"}));
  EXPECT_DOUBLE_EQ(wide.share_of(1.0), 0.125);
  EXPECT_EQ(wide.minor_ticks.size(), 8U * 8U);
  EXPECT_EQ(logarithmic_axis(3.0, 30.0).labels, (Labels{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(logarithmic_axis(10.0, 10.0).labels, (Labels{"10", "20", "50", "100"}));
}

Chart lines() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {.name = "lines",
          .title = "Errors over distance",
          .x_label = "distance [m]",
          .y_label = "error [mm]",
          .curves = {{.name = "ours", .x = {1, 2, 3}, .y = {0.5, nan, 2.0}, .spread = {0.1, nan, 3.0}},
                     {.name = "the paper", .x = {1, 3}, .y = {7, 7}, .from_paper = true}}};
}

Chart bars(bool logarithmic) {
  return {.name = "bars",
          .title = "Time",
          .x_label = "strategy",
          .y_label = "time [s]",
          .categories = {"greedy", "thorough"},
          .curves = {{.name = "ours", .x = {0, 1}, .y = {0.02, 0.0}},
                     {.name = "the paper", .x = {0, 1}, .y = {0.4, 0.9}, .from_paper = true}},
          .logarithmic = logarithmic};
}

TEST(ChartDrawing, writes_every_kind_as_svg_and_png) {
  const test::TemporaryFolder folder;
  Chart logarithmic = lines();
  logarithmic.logarithmic = true;
  for (const Chart& chart : {lines(), logarithmic, bars(false), bars(true), Chart{}}) {
    SCOPED_TRACE(chart.name);
    ASSERT_TRUE(draw_chart(folder.path("chart.svg"), chart));
    ASSERT_TRUE(draw_chart(folder.path("chart.png"), chart));
    EXPECT_EQ(test::read_text(folder.path("chart.svg")).find("nan"), std::string::npos);
    EXPECT_EQ(test::read_text(folder.path("chart.png")).substr(1, 3), "PNG");
  }
}

TEST(ChartDrawing, what_the_paper_states_is_dashed) {
  const test::TemporaryFolder folder;
  Chart chart = lines();
  ASSERT_TRUE(draw_chart(folder.path("a.svg"), chart));
  EXPECT_NE(test::read_text(folder.path("a.svg")).find("stroke-dasharray"), std::string::npos);
  chart.curves.pop_back();
  ASSERT_TRUE(draw_chart(folder.path("b.svg"), chart));
  EXPECT_EQ(test::read_text(folder.path("b.svg")).find("stroke-dasharray"), std::string::npos);
}

TEST(ChartDrawing, names_the_file_that_cannot_be_written) {
  const auto drawn = draw_chart("/no/such/folder/chart.png", lines());
  ASSERT_FALSE(drawn);
  EXPECT_NE(drawn.error().find("/no/such/folder/chart.png"), std::string::npos);
}

}  // namespace
}  // namespace stairway::evaluation
