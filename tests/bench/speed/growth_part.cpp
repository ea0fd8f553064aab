// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/speed/median.hpp"
#include "tests/bench/speed/parts.hpp"
#include "tests/bench/speed/power_law.hpp"
#include "tests/bench/speed/programs.hpp"

namespace stairway::bench {
namespace {

using evaluation::Cell;
using evaluation::Chart;
using evaluation::Curve;
using evaluation::Table;

constexpr std::size_t kMillion = 1'000'000;
// Beyond it, PCL takes minutes, and numbers the cells of its grid with too few bits.
constexpr std::size_t kMostForPcl = 5 * kMillion;

const std::vector<std::size_t>& all_sizes() {
  static const std::vector<std::size_t> kSizes{kMillion / 5, kMillion / 2,  kMillion,     2 * kMillion,
                                               5 * kMillion, 10 * kMillion, 20 * kMillion};
  return kSizes;
}

struct Cost {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double growth_MB = 0.0;
};

Cost median_cost(const std::vector<RunReport>& reports) {
  return {.wall_s = 1e-3 * median_of(reports, [](const RunReport& report) { return report.sum().wall_ms; }),
          .cpu_s = 1e-3 * median_of(reports, [](const RunReport& report) { return report.sum().cpu_ms; }),
          .growth_MB = median_of(reports, &RunReport::growth_MB)};
}

struct Measured {
  double points = 0.0;
  int rounds = 0;
  double seen = 0.0;
  double found = 0.0;
  Cost detector;
  std::optional<Cost> pcl;
};

// A large cloud takes so long that what disturbs a run evens out within it.
int rounds_for(std::size_t points, double share) {
  return points > 2 * kMillion ? 1 : evaluation::shared_count(3, share);
}

Measured measure(const std::filesystem::path& file, std::size_t points, int rounds) {
  std::vector<RunReport> detector, pcl;
  for (int i = 0; i < rounds; ++i) {
    detector.push_back(run_detector(file, "tower"));
    if (points <= kMostForPcl) pcl.push_back(run_pcl_segmentation(file, "usual"));
  }
  Measured measured{.points = static_cast<double>(points),
                    .rounds = rounds,
                    .seen = detector.front().seen,
                    .found = detector.front().found,
                    .detector = median_cost(detector)};
  if (!pcl.empty()) measured.pcl = median_cost(pcl);
  return measured;
}

Table cost_table(const std::vector<Measured>& all) {
  Table table{.name = "growth",
              .title = "Time and memory over the number of points, medians",
              .columns = {{"points", "million", 1},
                          {"rounds", "", 0},
                          {"flights", "", 0},
                          {"found", "", 0},
                          {"wall", "s", 2},
                          {"cpu", "s", 2},
                          {"cpu_per_point", "us", 2},
                          {"growth", "MB", 0},
                          {"growth_per_point", "byte", 0},
                          {"PCL_wall", "s", 2},
                          {"PCL_cpu", "s", 2},
                          {"PCL_growth", "MB", 0},
                          {"cpu_ratio", "times", 1}},
              .rows = {}};
  for (const Measured& m : all) {
    table.rows.push_back({1e-6 * m.points, static_cast<double>(m.rounds), m.seen, m.found, m.detector.wall_s,
                          m.detector.cpu_s, 1e6 * m.detector.cpu_s / m.points, m.detector.growth_MB,
                          m.detector.growth_MB * 1024.0 * 1024.0 / m.points});
    std::vector<Cell>& row = table.rows.back();
    if (m.pcl)
      row.insert(row.end(), {m.pcl->wall_s, m.pcl->cpu_s, m.pcl->growth_MB, m.pcl->cpu_s / m.detector.cpu_s});
    else
      row.resize(table.columns.size());
  }
  return table;
}

/// One figure of one program over the points.
struct Growth {
  std::string name;
  Curve curve;
};

Growth growth_of(const std::vector<Measured>& all, std::string name, bool is_pcl, double Cost::*figure) {
  Growth growth{.name = std::move(name), .curve = {.name = is_pcl ? "PCL, segments only" : "detector"}};
  for (const Measured& m : all) {
    if (is_pcl && !m.pcl) continue;
    growth.curve.add(m.points, (is_pcl ? *m.pcl : m.detector).*figure);
  }
  return growth;
}

Table exponent_table(const std::vector<Growth>& all) {
  Table table{.name = "growth-exponents",
              .title = "Fitted exponent of the number of points (1: in proportion)",
              .columns = {{"quantity", "", 0}, {"exponent", "", 3}, {"from", "million", 1}, {"to", "million", 1}},
              .rows = {}};
  for (const Growth& growth : all)
    table.rows.push_back({growth.name, fitted_exponent(growth.curve.x, growth.curve.y), 1e-6 * growth.curve.x.front(),
                          1e-6 * growth.curve.x.back()});
  return table;
}

Chart growth_chart(const char* name, const char* title, const char* y_label, const Growth& detector,
                   const Growth& pcl) {
  Curve linear{.name = "in proportion to the points", .from_paper = true};
  for (const double x : detector.curve.x) linear.add(x, detector.curve.y.back() * x / detector.curve.x.back());
  return {.name = name,
          .title = title,
          .x_label = "points",
          .y_label = y_label,
          .curves = {detector.curve, pcl.curve, std::move(linear)},
          .logarithmic = true};
}

}  // namespace

evaluation::Result run_growth(const evaluation::Request& request) {
  std::vector<std::size_t> sizes = all_sizes();
  sizes.resize(
      static_cast<std::size_t>(std::max(2, evaluation::shared_count(static_cast<int>(sizes.size()), request.share))));
  if (request.progress) request.progress(0.0, "simulating a walk through a tower");
  const std::vector<std::filesystem::path> files = tower_files(request.data, sizes);
  std::vector<Measured> all;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    // Every size takes about as long as all smaller ones together.
    if (request.progress)
      request.progress(std::pow(2.0, static_cast<double>(i) - static_cast<double>(sizes.size())),
                       fmt::format("{} points", sizes[i]));
    all.push_back(measure(files[i], sizes[i], rounds_for(sizes[i], request.share)));
    std::filesystem::remove(files[i]);
  }
  const std::vector<Growth> growths{growth_of(all, "detector, CPU time", false, &Cost::cpu_s),
                                    growth_of(all, "detector, peak growth", false, &Cost::growth_MB),
                                    growth_of(all, "PCL, CPU time", true, &Cost::cpu_s),
                                    growth_of(all, "PCL, peak growth", true, &Cost::growth_MB)};
  return {
      .tables = {cost_table(all), exponent_table(growths)},
      .charts = {growth_chart("growth-time", "Time over the number of points", "CPU time [s]", growths[0], growths[2]),
                 growth_chart("growth-memory", "Memory over the number of points, besides the cloud",
                              "peak growth [MB]", growths[1], growths[3])},
      .notes = {"The clouds are beginnings of one walk through a tower of offices, a sweep of 7 s at every stop, "
                "merged without error: more points are more rooms at the same density. Such a cloud has no single "
                "place of the sensor, so no beams can be fitted. \"flights\" are those of which enough was seen.",
                "Growth is what a process holds at the most beyond the cloud it was given, as Linux counts "
                "resident pages; each run is a process of its own. PCL has the usual settings and 2 threads, and "
                "ends with segments.",
                "Exponents are fitted to CPU time and growth on logarithmic scales, all sizes counting alike."}};
}

}  // namespace stairway::bench
