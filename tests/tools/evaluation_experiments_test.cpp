// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "tools/evaluation/experiment.hpp"
#include "tools/evaluation/large_scale.hpp"
#include "tools/evaluation/occlusion.hpp"
#include "tools/evaluation/random_flights.hpp"
#include "tools/evaluation/result_json.hpp"
#include "tools/evaluation/series.hpp"
#include "tools/evaluation/strategies.hpp"

namespace stairway::evaluation {
namespace {

/// As few runs as an experiment makes, each on a quick and sparse sweep.
Request smallest_request() {
  Request request;
  request.seed = 1000;
  request.share = 1e-6;
  request.settings.disk.period_s = 3.0;
  return request;
}

/// Tables and curves that are complete in themselves.
void expect_sound(const Result& result) {
  std::set<std::string> names;
  for (const Table& table : result.tables) {
    SCOPED_TRACE(table.name);
    EXPECT_TRUE(names.insert(table.name).second) << "two tables have the same name";
    EXPECT_FALSE(table.rows.empty());
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  for (const Chart& chart : result.charts) {
    SCOPED_TRACE(chart.name);
    for (const Curve& curve : chart.curves) {
      EXPECT_EQ(curve.x.size(), curve.y.size());
      EXPECT_TRUE(curve.spread.empty() || curve.spread.size() == curve.y.size());
      for (const double x : curve.x)
        EXPECT_TRUE(chart.categories.empty() || x < static_cast<double>(chart.categories.size()));
    }
  }
  EXPECT_FALSE(result.notes.empty());
}

std::vector<std::string> table_names(const Result& result) {
  std::vector<std::string> names;
  for (const Table& table : result.tables) names.push_back(table.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(Experiments, have_names_of_their_own) {
  std::set<std::string_view> names{"all"};
  for (const Experiment& experiment : experiments()) {
    EXPECT_TRUE(names.insert(experiment.name).second) << experiment.name;
    EXPECT_FALSE(experiment.summary.empty());
  }
}

TEST(Experiments, series_tells_errors_and_places_of_both_stairways) {
  const Result result = run_series(smallest_request());
  expect_sound(result);
  EXPECT_EQ(table_names(result), (Names{"series-I-coefficients", "series-I-localisation", "series-III-coefficients",
                                        "series-III-localisation", "table-2"}));
  EXPECT_EQ(result.charts.size(), 5U);
}

TEST(Experiments, strategies_tells_every_strategy_at_both_stairways) {
  const Result result = run_strategies(smallest_request());
  expect_sound(result);
  ASSERT_EQ(table_names(result), Names{"strategies"});
  EXPECT_EQ(result.tables.front().rows.size(), 8U);
}

TEST(Experiments, occlusion_and_random_flights_tell_their_tables) {
  const std::pair<Result (*)(const Request&), const char*> table[] = {
      {run_occlusion, "occlusion"}, {run_spiral, "spiral"}, {run_descending, "descending"}};
  for (const auto& [run, name] : table) {
    SCOPED_TRACE(name);
    const Result result = run(smallest_request());
    expect_sound(result);
    EXPECT_EQ(table_names(result), Names{name});
    EXPECT_FALSE(result.charts.empty());
  }
}

TEST(Experiments, large_scale_tells_points_time_and_memory) {
  const Result result = run_large_scale(smallest_request());
  expect_sound(result);
  EXPECT_EQ(table_names(result), Names{"large-scale"});
  for (const Chart& chart : result.charts) EXPECT_TRUE(chart.logarithmic);
}

TEST(Experiments, the_same_seed_gives_the_same_figures) {
  const Experiment spiral{"spiral", "", run_spiral};
  Request request = smallest_request();
  const auto run = [&] { return result_json(spiral, request, run_spiral(request)); };
  const std::string first = run();
  EXPECT_EQ(run(), first);
  request.seed = 1001;
  EXPECT_NE(run(), first);
}

}  // namespace
}  // namespace stairway::evaluation
