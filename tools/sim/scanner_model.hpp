// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scan_assembly/frames.hpp"
#include "tools/sim/bvh.hpp"
#include "tools/sim/mesh.hpp"
#include "tools/sim/random.hpp"

namespace stairway::sim {

/// The UTM-30LX's mirror: 1440 steps in a turn of 25 ms, of which 1081 are measured.
inline constexpr int kBeams = 1081;
inline constexpr int kStepsPerTurn = 1440;
inline constexpr int kFrontBeam = 540;
inline constexpr int kStepsBeforeFirstBeam = 180;  ///< from the rear, where a mirror turn begins
inline constexpr double kTurnPeriod_s = 0.025;

/// How the simulated UTM-30LX and its robot differ from perfect ones. The defaults are the data sheet's.
struct ScannerOptions {
  double spot_rad = 13.3e-3;        ///< full angle of the beam; 0 is a ray [rad]
  double pulse_separation_m = 0.7;  ///< surfaces nearer to each other in range give one echo between them [m]
  double noise_near_m = 0.010;      ///< standard deviation of a range below 10 m [m]
  double noise_far_m = 0.030;       ///< likewise above 10 m
  double range_bias_m = 0.0;        ///< added to every range [m]
  double dropout_share = 0.0;       ///< beams without return for no reason [share]
  double robot_roll_rad = 0.0;      ///< the robot is turned by Ry(pitch) Rx(roll) against the level scene and does
  double robot_pitch_rad = 0.0;     ///< not know; positive pitch lowers its nose [rad]

  /// First problem found; empty when usable.
  std::string problem() const;
};

/// Measures ranges in a mesh as the scanner on its turning disk would send them.
///
/// The spot is sampled by rays of equal area. Where it lies on one surface its middle counts; else the ranges are
/// grouped by `pulse_separation_m`, the group with the larger area wins, the first one on ties, and its mean is the
/// range: a mixed pixel. A spot of which less than a quarter is reflected gives no return. Results depend on the seed
/// and on `stream` alone. Cost: about 6 rays per beam.
class ScannerModel {
 public:
  ScannerModel(const Mesh& mesh, const scan::Calibration& calibration, const ScannerOptions& options,
               std::uint64_t seed);

  /// One mirror turn: `values` gets kBeams ranges in millimetres or SCIP error codes: 1 nothing within 30 m, 2 nearer
  /// than 0.1 m. The disk turns evenly from `start_angle_rad` to `end_angle_rad` during the 1440 steps. Thread-safe.
  /// @param stream  which random numbers to use; the number of the mirror turn.
  void measure_turn(std::uint64_t stream, double start_angle_rad, double end_angle_rad,
                    std::span<std::uint32_t> values) const;

 private:
  float echo_range(const Eigen::Isometry3f& T_scene_lidar, float beam_angle_rad) const;
  float mixed_range(const Eigen::Isometry3f& T_scene_lidar, float beam_angle_rad) const;
  std::uint32_t to_millimetres(float range_m, Random& random) const;

  Bvh bvh_;
  scan::Calibration calibration_;
  ScannerOptions options_;
  Eigen::Isometry3d T_scene_base_;
  std::uint64_t seed_;
};

}  // namespace stairway::sim
