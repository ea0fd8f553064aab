// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/tools/temporary_folder.hpp"
#include "tools/evaluation/paper_stairways.hpp"
#include "tools/evaluation/stairway_model.hpp"
#include "tools/evaluation/truth_plane.hpp"
#include "tools/sim/stl_file.hpp"

namespace stairway::evaluation {
namespace {

TEST(StairwayModel, of_a_flight_has_the_planes_of_the_flight) {
  std::vector<sim::StairSpec> flights{{.depth_m = 0.25, .width_m = 0.9, .turn_per_step_rad = 0.4},
                                      {.open_risers = true, .turn_per_step_rad = -0.35}};
  for (const PaperStairway& stairway : paper_stairways()) flights.push_back(stairway.flight);
  for (std::size_t i = 0; i < flights.size(); ++i) {
    for (const bool has_railings : {false, true}) {
      SCOPED_TRACE(::testing::Message() << i << ", railings " << has_railings);
      sim::StairSpec flight = flights[i];
      flight.railing_left = flight.railing_right = has_railings;
      const sim::Mesh exact = sim::flight_model(flight), model = stairway_model(flight);
      EXPECT_EQ(model.triangles().size(), exact.triangles().size());
      EXPECT_EQ(truth_planes(model.triangles()).size(), truth_planes(exact.triangles()).size());
    }
  }
}

TEST(StairwayModel, stands_with_its_first_nosing_above_the_origin) {
  sim::StairSpec flight = paper_stairways()[2].flight;
  const sim::Mesh expected = stairway_model(flight);
  flight.position = {-7.0, 3.0};
  flight.heading_rad = 2.0;
  flight.level_m = 1.0;
  const sim::Mesh model = stairway_model(flight);
  EXPECT_TRUE(sim::encode_stl(model) == sim::encode_stl(expected));
  Eigen::AlignedBox3d box;
  for (const sim::Triangle& triangle : model.triangles())
    for (const Eigen::Vector3d& corner : triangle.corners) box.extend(corner);
  EXPECT_NEAR(box.min().x(), 0.0, 1e-6);
  EXPECT_NEAR(box.min().y(), -0.5 * flight.width_m, 1e-6);
  EXPECT_NEAR(box.max().y(), 0.5 * flight.width_m, 1e-6);
  EXPECT_NEAR(box.min().z(), 0.0, 1e-6);
  EXPECT_NEAR(box.max().z(), flight.steps * flight.height_m, 1e-6);
}

TEST(StairwayModel, is_read_as_it_was_written) {
  const test::TemporaryFolder folder;
  const sim::StairSpec flight = paper_stairways()[0].flight;
  sim::write_stl(folder.path("stairs.stl"), sim::flight_model(flight));
  const sim::Mesh model = read_stairway_model(folder.path("stairs.stl"));
  EXPECT_TRUE(sim::encode_stl(model) == sim::encode_stl(stairway_model(flight)));
  EXPECT_EQ(model.surface_count(), stairway_model(flight).surface_count());
}

TEST(StairwayModel, that_does_not_fit_is_refused) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("stairs.stl");
  const sim::Mesh stairs = sim::flight_model(paper_stairways()[2].flight);
  const Eigen::Affine3d in_millimetres(Eigen::Scaling(1000.0)), under_the_floor(Eigen::Translation3d(0, 0, -0.3)),
      far_ahead(Eigen::Translation3d(4, 0, 0)), at_its_middle(Eigen::Translation3d(-1.5, 0, 0)),
      through_the_ceiling(Eigen::Translation3d(0, 0, 3.5));
  for (const auto& [name, change] : {std::pair{"in millimetres", in_millimetres},
                                     {"under the floor", under_the_floor},
                                     {"far ahead", far_ahead},
                                     {"at its middle", at_its_middle},
                                     {"through the ceiling", through_the_ceiling}}) {
    SCOPED_TRACE(name);
    sim::Mesh changed;
    for (const sim::Triangle& triangle : stairs.triangles())
      changed.add_polygon(
          std::array{change * triangle.corners[0], change * triangle.corners[1], change * triangle.corners[2]});
    sim::write_stl(path, changed);
    try {
      read_stairway_model(path);
      ADD_FAILURE() << "was taken";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(path + ": x "), 0U) << error.what();
    }
  }
}

}  // namespace
}  // namespace stairway::evaluation
