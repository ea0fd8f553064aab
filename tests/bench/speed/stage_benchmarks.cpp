// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// What each part of the detector costs, called by itself on one sweep of 1.5 million points.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "detector/fragment_merging.hpp"
#include "detector/levelling.hpp"
#include "detector/stairway_detector.hpp"
#include "detector/voxel_grid.hpp"
#include "ipc/cloud_file.hpp"
#include "tests/bench/speed/answer_check.hpp"
#include "tests/bench/speed/clouds.hpp"
#include "tests/bench/speed/temporary_folder.hpp"

namespace stairway::bench {
namespace {

using benchmark::DoNotOptimize;
using benchmark::State;

const detect::DetectorOptions kOptions;

std::vector<detect::StairPart> find_parts(const scan::PointCloud& cloud,
                                          const std::vector<detect::PlaneRegion>& regions) {
  std::vector<detect::StairPart> parts;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (auto part : {detect::find_stair_part(cloud, regions[i], kOptions.plane_finder),
                      detect::find_edge(cloud, regions[i], kOptions.plane_finder)}) {
      if (!part) continue;
      part->region = i;
      parts.push_back(*part);
    }
  }
  return parts;
}

/// What every part is given, as detect_stairways() would.
struct Inputs {
  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "sweep.pcd";
  scan::PointCloud cloud = take_sweep();
  scan::PointCloud thinned = detect::voxel_centroids(cloud, kOptions.voxel_m);
  detect::SurfaceNormals normals = detect::estimate_normals(thinned, kOptions.segmentation.normals);
  detect::SurfaceElements elements =
      detect::surface_elements(cloud, kOptions.voxel_m, kOptions.segmentation.normals, kOptions.segmentation.patches);
  std::vector<detect::PlaneRegion> regions;
  scan::PointCloud level_cloud;
  std::vector<detect::PlaneRegion> merged;
  std::vector<detect::StairPart> parts;
  detect::Winner winner;
  detect::Interval sides;
  detect::JointFit fit;

  Inputs() {
    if (!ipc::write_pcd(file, cloud)) throw std::runtime_error("no sweep could be written");
    elements.drop_ghosts(kOptions.segmentation.min_grazing_rad);
    regions = detect::grow_regions(cloud, elements, kOptions.segmentation.region_growing);
    const auto level = detect::level_by_scene(regions, kOptions.level);
    if (!level) throw std::runtime_error("the sweep could not be levelled");
    detect::transform(regions, level->T_level_cloud);
    level_cloud = detect::transformed(cloud, level->T_level_cloud);
    merged = detect::merge_fragments(level_cloud, regions, kOptions.plane_finder, kOptions.fragment_merging);
    parts = find_parts(level_cloud, merged);
    const detect::CompetitionResult competition = detect::compete(parts, kOptions.competition);
    if (competition.winners.size() != 1) throw std::runtime_error("no single flight won its parts");
    winner = competition.winners.front();
    sides = detect::from_parts(winner, parts).sides;
    const auto fitted = detect::fit_jointly(level_cloud, winner.graph, sides, winner.view, kOptions.joint_fit);
    if (!fitted) throw std::runtime_error("the flight could not be fitted");
    fit = *fitted;
    if (!railing().left || !railing().right) throw std::runtime_error("a railing was not found");
  }

  detect::Railing railing() const {
    return detect::find_railing(level_cloud, fit.model, fit.sides, fit.first, fit.last, kOptions.railing);
  }
};

const Inputs& inputs() {
  static const Inputs kInputs;
  return kInputs;
}

void read_pcd(State& state) {
  for (auto _ : state) {
    const auto loaded = ipc::read_cloud_file(inputs().file);
    if (!loaded || loaded->cloud.points.size() != inputs().cloud.points.size())
      throw std::runtime_error("the sweep was not read");
  }
}

void group_by_cell(State& state) {
  for (auto _ : state) DoNotOptimize(detect::group_by_cell(inputs().cloud.points, kOptions.voxel_m));
}

void voxel_grid(State& state) {
  for (auto _ : state) DoNotOptimize(detect::voxel_centroids(inputs().cloud, kOptions.voxel_m));
}

// The stage before or from "normals" on, of one function.
void surface_elements(State& state, bool before_normals) {
  for (auto _ : state) {
    if (!before_normals) state.PauseTiming();
    DoNotOptimize(detect::surface_elements(inputs().cloud, kOptions.voxel_m, kOptions.segmentation.normals,
                                           kOptions.segmentation.patches, [&](std::string_view stage) {
                                             if (stage != "normals") return;
                                             before_normals ? state.PauseTiming() : state.ResumeTiming();
                                           }));
    if (before_normals) state.ResumeTiming();
  }
}

void patches(State& state) { surface_elements(state, true); }
void normals(State& state) { surface_elements(state, false); }

void region_growing(State& state) {
  for (auto _ : state)
    DoNotOptimize(detect::grow_regions(inputs().cloud, inputs().elements, kOptions.segmentation.region_growing));
}

void normals_without_patches(State& state) {
  for (auto _ : state) DoNotOptimize(detect::estimate_normals(inputs().thinned, kOptions.segmentation.normals));
}

void region_growing_without_patches(State& state) {
  for (auto _ : state)
    DoNotOptimize(detect::grow_regions(inputs().thinned, inputs().normals, kOptions.segmentation.region_growing));
}

void plane_finder(State& state) {
  for (auto _ : state) {
    const std::vector<detect::PlaneRegion> merged = detect::merge_fragments(
        inputs().level_cloud, inputs().regions, kOptions.plane_finder, kOptions.fragment_merging);
    DoNotOptimize(find_parts(inputs().level_cloud, merged));
  }
}

void competition(State& state) {
  for (auto _ : state) DoNotOptimize(detect::compete(inputs().parts, kOptions.competition));
}

void joint_fit(State& state) {
  const Inputs& in = inputs();
  for (auto _ : state)
    DoNotOptimize(detect::fit_jointly(in.level_cloud, in.winner.graph, in.sides, in.winner.view, kOptions.joint_fit));
}

void railing(State& state) {
  for (auto _ : state) DoNotOptimize(inputs().railing());
}

void detect_stairways(State& state) {
  detect::Detection detection;
  for (auto _ : state) detection = detect::detect_stairways(inputs().cloud, kOptions);
  check_answer(inputs().cloud, detection, sweep_truths(), {.fewest_seen = 1, .max_height_error_mm = 1.0});
}

// In the order in which a pass takes them.
constexpr std::array<std::pair<const char*, void (*)(State&)>, 13> kBenchmarks{
    {{"read_pcd", read_pcd},
     {"group_by_cell", group_by_cell},
     {"voxel_grid", voxel_grid},
     {"patches", patches},
     {"normals", normals},
     {"region_growing", region_growing},
     {"normals_without_patches", normals_without_patches},
     {"region_growing_without_patches", region_growing_without_patches},
     {"plane_finder", plane_finder},
     {"competition", competition},
     {"joint_fit", joint_fit},
     {"railing", railing},
     {"detect_stairways", detect_stairways}}};

}  // namespace
}  // namespace stairway::bench

int main(int argc, char** argv) {
  using namespace stairway::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  // Processor time counts the work of all threads, and wall time is the one a robot waits.
  for (const auto& [name, function] : kBenchmarks)
    benchmark::RegisterBenchmark(name, function)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
  try {
    inputs();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "stage_benchmarks: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
