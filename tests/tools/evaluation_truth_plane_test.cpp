// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tools/evaluation/truth_plane.hpp"
#include "tools/sim/stair_spec.hpp"

namespace stairway::evaluation {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

sim::Mesh mesh_of(std::initializer_list<Corners> polygons) {
  sim::Mesh mesh;
  for (const Corners& corners : polygons) mesh.add_polygon(corners);
  return mesh;
}

const Corners kTread{{0, 0, 0.2}, {0, 1, 0.2}, {0.3, 1, 0.2}, {0.3, 0, 0.2}};

TEST(TruthPlanes, join_the_triangles_of_a_polygon) {
  EXPECT_EQ(truth_planes(mesh_of({kTread}).triangles()).size(), 1U);
}

TEST(TruthPlanes, join_neighbours_in_one_plane_that_share_part_of_an_edge) {
  const Corners beside{{0.3, 0.5, 0.2}, {0.3, 2, 0.2}, {0.6, 2, 0.2}, {0.6, 0.5, 0.2}};
  EXPECT_EQ(truth_planes(mesh_of({kTread, beside}).triangles()).size(), 1U);
}

TEST(TruthPlanes, join_neighbours_whose_normals_are_opposite) {
  const Corners backward{{0.6, 0, 0.2}, {0.6, 1, 0.2}, {0.3, 1, 0.2}, {0.3, 0, 0.2}};
  EXPECT_EQ(truth_planes(mesh_of({kTread, backward}).triangles()).size(), 1U);
}

TEST(TruthPlanes, keep_apart_what_only_touches_at_a_corner_or_not_at_all) {
  const Corners at_corner{{0.3, 1, 0.2}, {0.3, 2, 0.2}, {0.6, 2, 0.2}, {0.6, 1, 0.2}};
  const Corners apart{{0.4, 0, 0.2}, {0.4, 1, 0.2}, {0.7, 1, 0.2}, {0.7, 0, 0.2}};
  const Corners above{{0, 0, 0.4}, {0, 1, 0.4}, {0.3, 1, 0.4}, {0.3, 0, 0.4}};
  EXPECT_EQ(truth_planes(mesh_of({kTread, at_corner}).triangles()).size(), 2U);
  EXPECT_EQ(truth_planes(mesh_of({kTread, apart}).triangles()).size(), 2U);
  EXPECT_EQ(truth_planes(mesh_of({kTread, above}).triangles()).size(), 2U);
}

TEST(TruthPlanes, keep_a_riser_apart_from_its_tread) {
  const Corners riser{{0, 0, 0}, {0, 1, 0}, {0, 1, 0.2}, {0, 0, 0.2}};
  EXPECT_EQ(truth_planes(mesh_of({kTread, riser}).triangles()).size(), 2U);
}

TEST(TruthPlanes, of_a_closed_flight_are_treads_risers_sides_and_back) {
  const sim::Flight flight = sim::build_flight({.steps = 4});
  // Four treads and four risers, two sides, the back of the landing.
  EXPECT_EQ(truth_planes(flight.mesh.triangles()).size(), 4U + 4U + 2U + 1U);
}

TEST(TruthPlane, knows_heights_and_nearest_places) {
  const TruthPlane plane = truth_planes(mesh_of({kTread}).triangles()).front();
  EXPECT_NEAR(std::abs(plane.normal().z()), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(plane.height({5, 5, 0.5})), 0.3, 1e-12);
  const auto nearest = [&](const Eigen::Vector3d& p) { return plane.place(plane.nearest(plane.flatten(p))); };
  EXPECT_LT((nearest({0.1, 0.5, 0.7}) - Eigen::Vector3d(0.1, 0.5, 0.2)).norm(), 1e-9);
  EXPECT_LT((nearest({0.5, 0.5, 0.2}) - Eigen::Vector3d(0.3, 0.5, 0.2)).norm(), 1e-9);
  EXPECT_LT((nearest({-1, 3, 0.0}) - Eigen::Vector3d(0, 1, 0.2)).norm(), 1e-9);
}

TEST(TruthPlane, is_filled_with_a_raster_that_keeps_off_the_border) {
  const TruthPlane plane = truth_planes(mesh_of({kTread}).triangles()).front();
  const std::vector<Eigen::Vector2d> places = plane.raster(0.01, 0.005);
  EXPECT_EQ(places.size(), 30U * 100U);
  for (const Eigen::Vector2d& place : places) {
    const Eigen::Vector3d p = plane.place(place);
    EXPECT_GE(p.x(), 0.005 - 1e-9);
    EXPECT_LE(p.x(), 0.295 + 1e-9);
    EXPECT_GE(p.y(), 0.005 - 1e-9);
    EXPECT_LE(p.y(), 0.995 + 1e-9);
  }
}

}  // namespace
}  // namespace stairway::evaluation
