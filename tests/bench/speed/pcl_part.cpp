// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tests/bench/speed/median.hpp"
#include "tests/bench/speed/parts.hpp"
#include "tests/bench/speed/programs.hpp"

namespace stairway::bench {
namespace {

using evaluation::Cell;
using evaluation::Table;

constexpr std::array kSegmentationStages{"voxel_grid", "normals", "segmentation"};

/// The same cloud through all programs, one right after the other.
struct Round {
  RunReport detector;
  RunReport usual;
  RunReport same;
};

StageCost sum_of_segmentation(const RunReport& report) {
  StageCost sum;
  for (const char* name : kSegmentationStages) {
    sum.wall_ms += report.stage(name).wall_ms;
    sum.cpu_ms += report.stage(name).cpu_ms;
  }
  return sum;
}

using Program = RunReport Round::*;
constexpr std::array<Program, 3> kPrograms{&Round::detector, &Round::usual, &Round::same};

template <class Figure>
void add_cost_row(Table& table, const std::vector<Round>& rounds, const std::string& name, const Figure& figure) {
  std::vector<Cell> row{name};
  for (const Program program : kPrograms) {
    const double wall_ms = median_of(rounds, [&](const Round& round) { return figure(round.*program).wall_ms; });
    const double cpu_ms = median_of(rounds, [&](const Round& round) { return figure(round.*program).cpu_ms; });
    const bool has_run = cpu_ms > 0.0;
    row.push_back(has_run ? Cell(wall_ms) : Cell());
    row.push_back(has_run ? Cell(cpu_ms) : Cell());
  }
  table.rows.push_back(std::move(row));
}

Table cost_table(const std::vector<Round>& rounds) {
  Table table{
      .name = "pcl-costs",
      .title = fmt::format("One sweep through the detector and through PCL, median of {} rounds", rounds.size()),
      .columns = {{"stage", "", 0},
                  {"detector_wall", "ms", 1},
                  {"detector_cpu", "ms", 1},
                  {"PCL_usual_wall", "ms", 1},
                  {"PCL_usual_cpu", "ms", 1},
                  {"PCL_same_wall", "ms", 1},
                  {"PCL_same_cpu", "ms", 1}},
      .rows = {}};
  for (const StageCost& stage : rounds.front().detector.stages) {
    add_cost_row(table, rounds, stage.name,
                 [&](const RunReport& report) -> const StageCost& { return report.stage(stage.name); });
    if (stage.name == kSegmentationStages.back()) add_cost_row(table, rounds, "= segments", sum_of_segmentation);
  }
  add_cost_row(table, rounds, "= total", [](const RunReport& report) { return report.sum(); });
  return table;
}

Table ratio_table(const std::vector<Round>& rounds) {
  Table table{.name = "pcl-ratios",
              .title = "How many times the detector's time PCL takes",
              .columns = {{"compared", "", 0},
                          {"usual_wall", "times", 1},
                          {"usual_cpu", "times", 1},
                          {"same_wall", "times", 1},
                          {"same_cpu", "times", 1}},
              .rows = {}};
  const auto add = [&](const std::string& name, const auto& of_detector) {
    std::vector<Cell> row{name};
    for (const Program program : {&Round::usual, &Round::same}) {
      for (double StageCost::*figure : {&StageCost::wall_ms, &StageCost::cpu_ms}) {
        row.emplace_back(median_of(rounds, [&](const Round& round) {
          return (round.*program).sum().*figure / (of_detector(round.detector).*figure);
        }));
      }
    }
    table.rows.push_back(std::move(row));
  };
  add("PCL's segments / detector's segments", sum_of_segmentation);
  add("PCL's segments / detector's stairways", [](const RunReport& report) { return report.sum(); });
  return table;
}

Table answer_table(const Round& round) {
  Table table{.name = "pcl-answers",
              .title = "What they have then",
              .columns = {{"program", "", 0},
                          {"points", "", 0},
                          {"thinned_to", "", 0},
                          {"segments", "", 0},
                          {"like_steps", "", 0},
                          {"flights", "", 0},
                          {"height_error", "mm", 2},
                          {"peak_growth", "MB", 0}},
              .rows = {}};
  const RunReport& ours = round.detector;
  table.rows.push_back({"detector", ours.points, {}, {}, {}, ours.found, ours.height_error_mm, ours.growth_MB});
  for (const auto& [name, report] : {std::pair("PCL, usual", &round.usual), std::pair("PCL, same", &round.same)})
    table.rows.push_back(
        {name, report->points, report->thinned, report->regions, report->step_parts, {}, {}, report->growth_MB});
  return table;
}

}  // namespace

evaluation::Result run_pcl(const evaluation::Request& request) {
  const std::filesystem::path file = sweep_file(request.data);
  std::vector<Round> rounds;
  const int count = evaluation::shared_count(5, request.share);
  for (int i = 0; i < count; ++i) {
    if (request.progress) request.progress(static_cast<double>(i) / count, fmt::format("round {}", i + 1));
    rounds.push_back(
        {run_detector(file, "sweep"), run_pcl_segmentation(file, "usual"), run_pcl_segmentation(file, "same")});
  }
  return {
      .tables = {cost_table(rounds), ratio_table(rounds), answer_table(rounds.front())},
      .charts = {},
      .notes = {"PCL is pcl::VoxelGrid, pcl::NormalEstimationOMP on 2 threads and pcl::RegionGrowing, its templates "
                "compiled with the flags of the detector. \"usual\": normals of 30 neighbours; growing over 30 "
                "neighbours, 5 degrees, 200 points. \"same\": the detector's radius, neighbours, angle and points, "
                "as far as PCL has them.",
                "The comparison is unfair to the detector: PCL ends with segments, of which the column \"like "
                "steps\" counts those that pass for a riser or a tread, and still has to find stairs among them. "
                "It is unfair to PCL in that the detector need not tell a normal of every point.",
                "Ratios are medians of the ratios within single rounds. CPU time counts all threads; where others "
                "use the machine, wall time tells of them as well."}};
}

}  // namespace stairway::bench
