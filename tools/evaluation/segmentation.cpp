// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/segmentation.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "detector/segmentation.hpp"
#include "detector/voxel_grid.hpp"
#include "tools/evaluation/paper_stairways.hpp"
#include "tools/evaluation/segmentation_truth.hpp"
#include "tools/evaluation/stairway_model.hpp"
#include "tools/sim/random.hpp"
#include "tools/sim/sweep.hpp"

namespace stairway::evaluation {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPositions = 50;
constexpr double kPercent = 100.0;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Method {
  detect::SegmentationMethod method;
  const char* name;
  const char* paper_on_time;
};
constexpr std::array kMethods{
    Method{detect::SegmentationMethod::RegionGrowing, "region-growing", "3 s for the segmentation, after 4 s"},
    Method{detect::SegmentationMethod::SplitAndMerge, "split-and-merge", "much shorter, as it needs no normals"},
    Method{detect::SegmentationMethod::VoxelSac, "voxel-sac", "almost 1 s faster than region growing"}};

// What the paper tells in words of its Fig 15, as a difference to region growing in percentage points.
struct Measure {
  const char* name;
  const char* paper_name;
  double SegmentationMeasures::*value;
  std::array<std::optional<double>, kMethods.size()> paper_pp;
};
constexpr std::array kMeasures{
    Measure{"plane recall", "precision, eq 21", &SegmentationMeasures::plane_recall, {0.0, std::nullopt, -2.5}},
    Measure{"plane precision", "recall, eq 22", &SegmentationMeasures::plane_precision, {0.0, std::nullopt, -8.0}},
    Measure{"point recall", "precision, eq 23", &SegmentationMeasures::point_recall, {0.0, -20.0, -2.5}},
    Measure{"point precision", "recall, eq 25", &SegmentationMeasures::point_precision, {0.0, 0.0, 0.0}}};

// Of one method over all positions.
struct Series {
  std::vector<SegmentationMeasures> measures;
  std::vector<double> normals_ms;
  std::vector<double> segmentation_ms;
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double middle = mean(values);
  std::vector<double> squares;
  for (const double value : values) squares.push_back((value - middle) * (value - middle));
  return std::sqrt(mean(squares));
}

std::vector<double> percentages(const Series& series, const Measure& measure) {
  std::vector<double> values;
  for (const SegmentationMeasures& each : series.measures) values.push_back(kPercent * each.*measure.value);
  return values;
}

// Everything about one position that does not depend on the method.
struct Position {
  scan::PointCloud thinned;
  std::vector<TruthPlane> planes;
  PointTruth truth;
};

// The hall, and in it the stairway.
struct Models {
  sim::Scene hall;
  sim::Mesh stairs;
};

Models models_of(sim::SceneSpec spec, const std::optional<sim::Mesh>& given) {
  const sim::StairSpec flight = spec.stairs.front();
  spec.stairs.clear();
  Models models{.hall = sim::build_scene(spec), .stairs = {}};
  Eigen::Isometry3d T_hall_model = Eigen::Isometry3d::Identity();
  T_hall_model.translation().head<2>() = flight.position;
  T_hall_model.rotate(Eigen::AngleAxisd(flight.heading_rad, Eigen::Vector3d::UnitZ()));
  models.stairs.append(given ? *given : stairway_model(flight), T_hall_model);
  return models;
}

Position look(const Request& request, const std::optional<sim::Mesh>& given, int number) {
  const auto [hall, stairs] = models_of(segmentation_scene(request.seed, number), given);
  sim::Scene scene = hall;
  scene.mesh.append(stairs);
  const scan::PointCloud cloud =
      sim::simulate_sweep(scene, request.settings.mount, {}, {}, request.seed + static_cast<std::uint64_t>(number));
  Position position;
  position.thinned = detect::voxel_centroids(cloud, request.settings.detector.voxel_m);
  position.planes = truth_planes(stairs.triangles());
  position.truth =
      assign_points(position.thinned, position.planes, truth_planes(hall.mesh.triangles()), sim::Bvh(scene.mesh));
  return position;
}

void run_method(const Position& position, detect::SegmentationOptions options, const Method& method, Series& series) {
  options.method = method.method;
  std::optional<Clock::time_point> normals_began;
  Clock::time_point segmentation_began;
  const auto regions = detect::segment(position.thinned, options, [&](std::string_view stage) {
    if (stage == "normals") normals_began = Clock::now();
    if (stage == "segmentation") segmentation_began = Clock::now();
  });
  const auto milliseconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
  };
  series.segmentation_ms.push_back(milliseconds(segmentation_began, Clock::now()));
  series.normals_ms.push_back(normals_began ? milliseconds(*normals_began, segmentation_began) : 0.0);
  const auto match_of = match_regions(regions, position.thinned.points, position.planes, position.truth.is_detectable);
  series.measures.push_back(measure(regions, match_of, position.truth));
}

using AllSeries = std::array<Series, kMethods.size()>;

Table measure_table(const AllSeries& all) {
  Table table{.name = "segmentation-measures",
              .title = "Planes and points found by the three segmentations (Fig 15)",
              .columns = {{"measure", ""},
                          {"paper_name", ""},
                          {"method", ""},
                          {"mean", "%", 1},
                          {"sd", "%", 1},
                          {"to_region_growing", "pp", 1},
                          {"paper_to_region_growing", "pp", 1}},
              .rows = {}};
  for (const Measure& measure : kMeasures) {
    const double baseline = mean(percentages(all[0], measure));
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
      const std::vector<double> values = percentages(all[i], measure);
      table.rows.push_back({measure.name, measure.paper_name, kMethods[i].name, mean(values), deviation(values),
                            mean(values) - baseline, measure.paper_pp[i] ? Cell(*measure.paper_pp[i]) : Cell()});
    }
  }
  return table;
}

Table time_table(const AllSeries& all) {
  Table table{
      .name = "segmentation-time",
      .title = "Time of the three segmentations, mean of the positions (Fig 16)",
      .columns = {{"method", ""}, {"normals", "ms", 0}, {"segmentation", "ms", 0}, {"total", "ms", 0}, {"paper", ""}},
      .rows = {}};
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    const double normals = mean(all[i].normals_ms);
    const double segmentation = mean(all[i].segmentation_ms);
    table.rows.push_back({kMethods[i].name, normals > 0.0 ? Cell(normals) : Cell(), segmentation,
                          normals + segmentation, kMethods[i].paper_on_time});
  }
  return table;
}

Chart measure_chart(const AllSeries& all) {
  Chart chart{.name = "segmentation-measures",
              .title = "Segmentations against region growing",
              .y_label = "of region growing [%]"};
  for (const Measure& measure : kMeasures) chart.categories.emplace_back(measure.name);
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    Curve ours{.name = kMethods[i].name};
    Curve paper{.name = fmt::format("{} (paper)", kMethods[i].name), .from_paper = true};
    for (std::size_t k = 0; k < kMeasures.size(); ++k) {
      const double baseline = mean(percentages(all[0], kMeasures[k]));
      ours.add(static_cast<double>(k), kPercent * mean(percentages(all[i], kMeasures[k])) / baseline);
      paper.add(static_cast<double>(k), kMeasures[k].paper_pp[i] ? kPercent + *kMeasures[k].paper_pp[i] : kUnknown);
    }
    chart.curves.push_back(std::move(ours));
    if (i > 0) chart.curves.push_back(std::move(paper));
  }
  return chart;
}

Chart time_chart(const AllSeries& all) {
  Chart chart{.name = "segmentation-time",
              .title = "Time of the three segmentations",
              .y_label = "time [ms]",
              .curves = {{.name = "normals"}, {.name = "segmentation"}, {.name = "together"}}};
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    chart.categories.emplace_back(kMethods[i].name);
    const std::array times{mean(all[i].normals_ms), mean(all[i].segmentation_ms)};
    const std::array bars{times[0], times[1], times[0] + times[1]};
    for (std::size_t k = 0; k < bars.size(); ++k) chart.curves[k].add(static_cast<double>(i), bars[k]);
  }
  return chart;
}

}  // namespace

sim::SceneSpec segmentation_scene(std::uint64_t seed, int position) {
  constexpr double kFarthestAside_rad = std::numbers::pi / 4;
  sim::Random random(seed, static_cast<std::uint64_t>(position));
  const auto stairways = paper_stairways();
  sim::SceneSpec spec;
  spec.name = fmt::format("segmentation-{}", position);
  spec.room = {.low = {-10.0, -10.0}, .high = {10.0, 10.0}, .height_m = 4.5};
  sim::StairSpec flight = stairways[static_cast<std::size_t>(position) % stairways.size()].flight;
  const double distance = random.uniform(1.0, 4.5);
  const double bearing = random.uniform(-std::numbers::pi, std::numbers::pi);
  flight.position = distance * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
  flight.heading_rad = bearing + random.uniform(-kFarthestAside_rad, kFarthestAside_rad);
  spec.stairs = {flight};
  return spec;
}

Result run_segmentation(const Request& request) {
  const int positions = shared_count(kPositions, request.share);
  std::optional<sim::Mesh> given;
  if (!request.model.empty()) given = read_stairway_model(request.model);
  AllSeries all;
  for (int number = 0; number < positions; ++number) {
    if (request.progress)
      request.progress(static_cast<double>(number) / positions,
                       fmt::format("position {} of {}", number + 1, positions));
    const Position position = look(request, given, number);
    for (std::size_t i = 0; i < kMethods.size(); ++i)
      run_method(position, request.settings.detector.segmentation, kMethods[i], all[i]);
  }
  Result result{
      .tables = {measure_table(all), time_table(all)},
      .charts = {measure_chart(all), time_chart(all)},
      .notes = {
          "Names of the measures are those in common use; the paper calls the recalls precision and the other way "
          "round, as the column paper_name shows.",
          "Figures of the paper are what its text tells of Fig 15, which shows ratios to region growing; where the "
          "text says close or very similar, they are approximate.",
          "Each mean is taken over the positions. Only the stairway's planes count, and of the room only the points "
          "nearer to it are left out.",
          "Times are measured one after the other in one thread, after thinning; the paper's are from another "
          "computer."}};
  if (given)
    result.notes.push_back(fmt::format("Every position is before the stairway of {}.", request.model.string()));
  return result;
}

}  // namespace stairway::evaluation
