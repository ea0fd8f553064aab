// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/merged_sweeps.hpp"

#include "tools/sim/random.hpp"

namespace stairway::sim {
namespace {

Eigen::Isometry3d placed(const Stand& stand) {
  Eigen::Isometry3d T_scene_base = Eigen::Isometry3d::Identity();
  T_scene_base.translate(stand.position);
  T_scene_base.rotate(Eigen::AngleAxisd{stand.yaw_rad, Eigen::Vector3d::UnitZ()});
  return T_scene_base;
}

}  // namespace

scan::PointCloud simulate_merged(const Scene& scene, std::span<const Stand> stands, const scan::MountOptions& mount,
                                 const ScannerOptions& scanner, const SweepOptions& options, std::uint64_t seed) {
  scan::PointCloud merged;
  Random seeds{seed};
  for (const Stand& stand : stands) {
    const Eigen::Isometry3d T_scene_base = placed(stand);
    Scene seen;
    seen.mesh.append(scene.mesh, T_scene_base.inverse());
    const scan::PointCloud sweep = simulate_sweep(seen, mount, scanner, options, seeds.next());
    const Eigen::Isometry3f T = T_scene_base.cast<float>();
    merged.points.reserve(merged.points.size() + sweep.points.size());
    for (const Eigen::Vector3f& p : sweep.points) merged.points.emplace_back(T * p);
  }
  return merged;
}

}  // namespace stairway::sim
