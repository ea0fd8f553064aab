// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/merged_sweeps.hpp"

#include "detector/levelling.hpp"
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
    const scan::PointCloud sweep =
        detect::transformed(simulate_sweep(seen, mount, scanner, options, seeds.next()), T_scene_base);
    merged.points.insert(merged.points.end(), sweep.points.begin(), sweep.points.end());
  }
  return merged;
}

}  // namespace stairway::sim
