// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/scanner_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace stairway::sim {
namespace {

constexpr float kMaxRange_m = 30.0F;
constexpr float kMinRange_m = 0.1F;
constexpr float kFarNoise_m = 10.0F;
constexpr std::uint32_t kNoReturnCode = 1;
constexpr std::uint32_t kTooNearCode = 2;
constexpr int kSpotRays = 19;
constexpr int kLeastReflected = 5;  // a quarter of the spot

// Equal areas of the unit disk: Vogel, Mathematical Biosciences 44, 1979.
const std::array<Eigen::Vector2f, kSpotRays> kSpot = [] {
  std::array<Eigen::Vector2f, kSpotRays> spot;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < kSpotRays; ++i) {
    const double radius = std::sqrt((i + 0.5) / kSpotRays);
    spot[static_cast<std::size_t>(i)] =
        Eigen::Vector2d{radius * std::cos(i * golden_angle), radius * std::sin(i * golden_angle)}.cast<float>();
  }
  return spot;
}();

struct Beam {
  Eigen::Vector3f forward, side, up;

  Beam(const Eigen::Isometry3f& T_scene_lidar, float angle_rad)
      : forward{T_scene_lidar.linear() * Eigen::Vector3f{std::cos(angle_rad), std::sin(angle_rad), 0.0F}},
        side{T_scene_lidar.linear() * Eigen::Vector3f{-std::sin(angle_rad), std::cos(angle_rad), 0.0F}},
        up{T_scene_lidar.linear().col(2)} {}

  Eigen::Vector3f direction(const Eigen::Vector2f& offset_rad) const {
    return (forward + offset_rad.x() * side + offset_rad.y() * up).normalized();
  }
};

}  // namespace

std::string ScannerOptions::problem() const {
  const auto is_within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!is_within(spot_rad, 0.0, 0.2)) return "spot must lie between 0 and 0.2 rad";
  if (!is_within(pulse_separation_m, 0.0, 100.0)) return "pulse separation must lie between 0 and 100 m";
  if (!is_within(noise_near_m, 0.0, 1.0) || !is_within(noise_far_m, 0.0, 1.0))
    return "noise must lie between 0 and 1 m";
  if (!is_within(range_bias_m, -1.0, 1.0)) return "range bias must lie within 1 m";
  if (!is_within(dropout_share, 0.0, 1.0)) return "drop-out share must lie between 0 and 1";
  if (!is_within(robot_roll_rad, -1.0, 1.0) || !is_within(robot_pitch_rad, -1.0, 1.0)) {
    return "roll and pitch of the robot must lie within 1 rad";
  }
  return {};
}

ScannerModel::ScannerModel(const Mesh& mesh, const scan::Calibration& calibration, const ScannerOptions& options,
                           std::uint64_t seed)
    : bvh_{mesh},
      calibration_{calibration},
      options_{options},
      T_scene_base_{Eigen::AngleAxisd{options.robot_pitch_rad, Eigen::Vector3d::UnitY()} *
                    Eigen::AngleAxisd{options.robot_roll_rad, Eigen::Vector3d::UnitX()}},
      seed_{seed} {
  if (const std::string problem = options.problem(); !problem.empty())
    throw std::invalid_argument{"scanner: " + problem};
}

float ScannerModel::mixed_range(const Eigen::Isometry3f& T_scene_lidar, float beam_angle_rad) const {
  const Beam beam{T_scene_lidar, beam_angle_rad};
  const float radius = static_cast<float>(options_.spot_rad / 2);
  const float separation = static_cast<float>(options_.pulse_separation_m);
  std::array<float, kSpotRays> ranges;
  std::size_t count = 0;
  for (const auto& point : kSpot) {
    const Hit hit = bvh_.cast(T_scene_lidar.translation(), beam.direction(radius * point), kMaxRange_m + 1.0F);
    if (hit.surface != kNoSurface) ranges[count++] = hit.range_m;
  }
  if (count < kLeastReflected) return std::numeric_limits<float>::infinity();
  std::sort(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(count));
  std::size_t best_size = 0;
  float best_range = 0.0F;
  for (std::size_t first = 0; first < count;) {
    std::size_t last = first + 1;
    float sum = ranges[first];
    while (last < count && ranges[last] - ranges[last - 1] < separation) sum += ranges[last++];
    if (last - first > best_size) {
      best_size = last - first;
      best_range = sum / static_cast<float>(best_size);
    }
    first = last;
  }
  return best_range;
}

float ScannerModel::echo_range(const Eigen::Isometry3f& T_scene_lidar, float beam_angle_rad) const {
  const Beam beam{T_scene_lidar, beam_angle_rad};
  const Eigen::Vector3f origin = T_scene_lidar.translation();
  const Hit middle = bvh_.cast(origin, beam.forward, kMaxRange_m + 1.0F);
  const float radius = static_cast<float>(options_.spot_rad / 2);
  if (radius == 0.0F) return middle.range_m;
  for (const auto& rim : {Eigen::Vector2f{radius, 0}, Eigen::Vector2f{-radius, 0}, Eigen::Vector2f{0, radius},
                          Eigen::Vector2f{0, -radius}}) {
    if (bvh_.cast(origin, beam.direction(rim), kMaxRange_m + 1.0F).surface != middle.surface) {
      return mixed_range(T_scene_lidar, beam_angle_rad);
    }
  }
  return middle.range_m;
}

std::uint32_t ScannerModel::to_millimetres(float range_m, Random& random) const {
  // Both numbers are drawn for every beam, so that what one beam sees does not change the noise of the next.
  const bool dropped = random.chance(options_.dropout_share);
  const double noise = random.normal();
  if (dropped || !std::isfinite(range_m)) return kNoReturnCode;
  const double sigma = range_m < kFarNoise_m ? options_.noise_near_m : options_.noise_far_m;
  const double measured = range_m + options_.range_bias_m + sigma * noise;
  if (measured > kMaxRange_m) return kNoReturnCode;
  if (measured < kMinRange_m) return kTooNearCode;
  return static_cast<std::uint32_t>(std::lround(1000.0 * measured));
}

void ScannerModel::measure_turn(std::uint64_t stream, double start_angle_rad, double end_angle_rad,
                                std::span<std::uint32_t> values) const {
  Random random{seed_, stream};
  for (int beam = 0; beam < kBeams; ++beam) {
    const double share = static_cast<double>(beam + kStepsBeforeFirstBeam) / kStepsPerTurn;
    const double disk_angle = start_angle_rad + (end_angle_rad - start_angle_rad) * share;
    const Eigen::Isometry3f T_scene_lidar = (T_scene_base_ * calibration_.T_base_lidar(disk_angle)).cast<float>();
    const double beam_angle = 2 * std::numbers::pi * (beam - kFrontBeam) / kStepsPerTurn;
    const float range = echo_range(T_scene_lidar, static_cast<float>(beam_angle));
    values[static_cast<std::size_t>(beam)] = to_millimetres(range, random);
  }
}

}  // namespace stairway::sim
