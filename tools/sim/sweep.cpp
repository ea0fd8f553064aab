// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <thread>

namespace stairway::sim {
namespace {

constexpr std::uint32_t kLargestErrorCode = 22;

int count_turns(const SweepOptions& options) {
  const double turns = std::abs(options.disk_period_s) / kTurnPeriod_s;
  if (!(turns >= 1.0 && turns < 1e6))
    throw std::invalid_argument{"sweep: disk period must lie between 0.025 and 25000 s"};
  return static_cast<int>(std::lround(turns));
}

double angle_at_turn(const SweepOptions& options, int turn) {
  return options.start_angle_rad + 2 * std::numbers::pi * turn * kTurnPeriod_s / options.disk_period_s;
}

scan::Calibration checked_calibration(const scan::MountOptions& mount) {
  if (const std::string problem = mount.problem(); !problem.empty()) throw std::invalid_argument{"mount: " + problem};
  return scan::make_calibration(mount);
}

}  // namespace

std::vector<std::uint32_t> simulate_ranges(const Scene& scene, const scan::MountOptions& mount,
                                           const ScannerOptions& scanner, const SweepOptions& options,
                                           std::uint64_t seed) {
  const int turns = count_turns(options);
  const ScannerModel model{scene.mesh, checked_calibration(mount), scanner, seed};
  std::vector<std::uint32_t> values(static_cast<std::size_t>(turns) * kBeams);
  std::atomic<int> next_turn{0};
  const auto work = [&] {
    for (int turn = next_turn++; turn < turns; turn = next_turn++) {
      const std::span<std::uint32_t> part{values.data() + static_cast<std::size_t>(turn) * kBeams, kBeams};
      model.measure_turn(static_cast<std::uint64_t>(turn), angle_at_turn(options, turn),
                         angle_at_turn(options, turn + 1), part);
    }
  };
  const unsigned threads =
      options.threads > 0 ? static_cast<unsigned>(options.threads) : std::thread::hardware_concurrency();
  {
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < std::min(threads, 64U); ++i) helpers.emplace_back(work);
    work();
  }
  return values;
}

scan::PointCloud simulate_sweep(const Scene& scene, const scan::MountOptions& mount, const ScannerOptions& scanner,
                                const SweepOptions& options, std::uint64_t seed) {
  const std::vector<std::uint32_t> values = simulate_ranges(scene, mount, scanner, options, seed);
  const scan::Calibration calibration = scan::make_calibration(mount);
  scan::PointCloud cloud;
  cloud.sensor_origin = calibration.mean_sensor_origin().cast<float>();
  cloud.points.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] <= kLargestErrorCode) continue;
    const int turn = static_cast<int>(i / kBeams);
    const int beam = static_cast<int>(i % kBeams);
    const double start = angle_at_turn(options, turn);
    const double share = static_cast<double>(beam + kStepsBeforeFirstBeam) / kStepsPerTurn;
    const double disk_angle = start + (angle_at_turn(options, turn + 1) - start) * share;
    const double beam_angle = 2 * std::numbers::pi * (beam - kFrontBeam) / kStepsPerTurn;
    const double range = 0.001 * values[i];
    const Eigen::Vector3d p_lidar{range * std::cos(beam_angle), range * std::sin(beam_angle), 0.0};
    cloud.points.emplace_back((calibration.T_base_lidar(disk_angle) * p_lidar).cast<float>());
  }
  return cloud;
}

}  // namespace stairway::sim
