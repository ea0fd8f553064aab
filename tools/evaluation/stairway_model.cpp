// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/stairway_model.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "tools/sim/stl_file.hpp"

namespace stairway::evaluation {
namespace {

constexpr std::size_t kMostTriangles = 20'000;
constexpr double kBeforeFoot_m = 0.5;
constexpr double kBelowFloor_m = 0.25;  // stringers are often cut off there
constexpr double kHighest_m = 4.4;
constexpr double kReach_m = 5.4;  // 4.5 m before the robot, it ends before the wall at 10 m

std::string problem_of(const sim::Mesh& model) {
  if (model.triangles().size() > kMostTriangles)
    return fmt::format("{} triangles, more than the limit of {}", model.triangles().size(), kMostTriangles);
  Eigen::AlignedBox3d box;
  double reach_m = 0.0;
  for (const sim::Triangle& triangle : model.triangles()) {
    for (const Eigen::Vector3d& corner : triangle.corners) {
      box.extend(corner);
      reach_m = std::max(reach_m, corner.head<2>().norm());
    }
  }
  if (box.min().x() >= -kBeforeFoot_m && box.min().z() >= -kBelowFloor_m && box.max().z() <= kHighest_m &&
      reach_m <= kReach_m)
    return {};
  return fmt::format(
      "x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} is not a stairway in metres that goes up along x "
      "from "
      "its first nosing at x = 0, within {} m of it and from z = 0 to {} m",
      box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z(), kReach_m, kHighest_m);
}

sim::Mesh with_shared_surfaces(sim::Mesh model) {
  model.share_coplanar_surfaces();
  return model;
}

}  // namespace

sim::Mesh read_stairway_model(const std::filesystem::path& path) {
  sim::Mesh model = sim::read_stl(path);
  if (const std::string problem = problem_of(model); !problem.empty())
    throw std::runtime_error(fmt::format("{}: {}", path.string(), problem));
  return with_shared_surfaces(std::move(model));
}

sim::Mesh stairway_model(const sim::StairSpec& flight) {
  return with_shared_surfaces(sim::decode_stl(sim::encode_stl(sim::flight_model(flight))));
}

}  // namespace stairway::evaluation
