// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cloud_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stairway::detect {
namespace {

struct Cloud {
  const char* name;
  std::vector<Eigen::Vector3f> points;
};

std::vector<Cloud> clouds() {
  std::mt19937 engine(11);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  Cloud uniform{"uniform", {}};
  Cloud huge{"huge span", {}};
  Cloud clusters{"two clusters", {}};
  Cloud integers{"integer grid", {}};
  Cloud duplicates{"duplicates", {}};
  for (int i = 0; i < 800; ++i) {
    const Eigen::Vector3f p(unit(engine), unit(engine), unit(engine));
    uniform.points.push_back(p);
    huge.points.push_back(p * 5000.0F);
    clusters.points.push_back(0.1F * p + Eigen::Vector3f::Constant(i % 2 == 0 ? 0.0F : 10.0F));
    integers.points.push_back((4.0F * p).array().round());
    duplicates.points.push_back(Eigen::Vector3f(static_cast<float>(i % 5), 0.0F, 0.0F));
  }
  return {uniform, huge, clusters, integers, duplicates};
}

// Ties have no order, so distances are compared, not indices.
std::vector<float> sorted_distances(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& query) {
  std::vector<float> distances;
  for (const Eigen::Vector3f& p : points) distances.push_back((p - query).norm());
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST(CloudIndex, finds_the_same_nearest_as_a_search_of_all_points) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const CloudIndex index(cloud.points);
    std::vector<std::uint32_t> found;
    for (std::size_t q = 0; q < cloud.points.size(); q += 37) {
      index.nearest(cloud.points[q], 12, found);
      const std::vector<float> expected = sorted_distances(cloud.points, cloud.points[q]);
      ASSERT_EQ(found.size(), 12U);
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_FLOAT_EQ((cloud.points[found[i]] - cloud.points[q]).norm(), expected[i]);
    }
  }
}

TEST(CloudIndex, finds_all_within_a_radius_and_no_others) {
  for (const Cloud& cloud : clouds()) {
    SCOPED_TRACE(cloud.name);
    const CloudIndex index(cloud.points);
    std::vector<std::uint32_t> found;
    for (std::size_t q = 0; q < cloud.points.size(); q += 53) {
      const double radius = 0.37;
      index.within(cloud.points[q], radius, found);
      const std::vector<float> all = sorted_distances(cloud.points, cloud.points[q]);
      const auto expected = std::count_if(all.begin(), all.end(), [&](float d) { return d <= radius; });
      EXPECT_EQ(static_cast<std::ptrdiff_t>(found.size()), expected);
    }
  }
}

TEST(CloudIndex, returns_what_there_is_when_asked_for_more) {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {1, 0, 0}};
  const CloudIndex index(points);
  std::vector<std::uint32_t> found;
  index.nearest({0.2F, 0, 0}, 5, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace stairway::detect
