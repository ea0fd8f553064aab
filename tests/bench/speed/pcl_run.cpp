// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
// Takes a cloud through the segmentation of the same paper as programs make it of PCL, and prints what it cost as a
// line of JSON. It ends with planar segments, where the detector has stairways. Usage: pcl_run FILE usual|same
#include <pcl/point_types.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <numbers>
#include <pcl/features/impl/normal_3d_omp.hpp>
#include <pcl/filters/impl/voxel_grid.hpp>
#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/segmentation/impl/region_growing.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "detector/plane_finder.hpp"
#include "detector/segmentation.hpp"
#include "detector/stairway_detector.hpp"
#include "ipc/cloud_file.hpp"
#include "tests/bench/speed/run_report.hpp"
#include "tools/evaluation/peak_memory.hpp"

namespace stairway::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

constexpr unsigned kThreads = 2;

struct Settings {
  int normal_neighbours = 0;  // or, where it is 0,
  double normal_radius_m = 0.0;
  int growing_neighbours = 0;
  double max_angle_rad = 0.0;
  int min_points = 0;
};

// PCL's tutorial takes 50 and 30 neighbours, 3 degrees and 50 points, of a cloud from a camera nearby.
constexpr Settings kUsual{.normal_neighbours = 30,
                          .growing_neighbours = 30,
                          .max_angle_rad = 5.0 * std::numbers::pi / 180.0,
                          .min_points = 200};

// Those of the detector, as far as PCL has them.
Settings same() {
  const detect::SegmentationOptions ours;
  return {.normal_radius_m = ours.normals.radius_m,
          .growing_neighbours = ours.region_growing.num_neighbours,
          .max_angle_rad = ours.region_growing.max_normal_angle_rad,
          .min_points = ours.region_growing.min_points};
}

Cloud::Ptr load(const std::string& path) {
  const auto loaded = ipc::read_cloud_file(path);
  if (!loaded) throw std::runtime_error(loaded.error().text);
  auto cloud = pcl::make_shared<Cloud>();
  for (const Eigen::Vector3f& p : loaded->cloud.points) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

Cloud::Ptr thinned(const Cloud::Ptr& cloud) {
  const auto leaf = static_cast<float>(detect::DetectorOptions{}.voxel_m);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  auto result = pcl::make_shared<Cloud>();
  grid.filter(*result);
  // What it does when the numbers of its cells overflow.
  if (result->size() == cloud->size()) throw std::runtime_error("the voxel grid has left the cloud as it was");
  return result;
}

Normals::Ptr normals_of(const Cloud::Ptr& cloud, const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree,
                        const Settings& settings) {
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(kThreads);
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(settings.normal_neighbours);
  estimation.setRadiusSearch(settings.normal_radius_m);
  auto normals = pcl::make_shared<Normals>();
  estimation.compute(*normals);
  return normals;
}

std::vector<pcl::PointIndices> segments_of(const Cloud::Ptr& cloud, const Normals::Ptr& normals,
                                           const pcl::search::KdTree<pcl::PointXYZ>::Ptr& tree,
                                           const Settings& settings) {
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(cloud);
  growing.setInputNormals(normals);
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(static_cast<unsigned>(settings.growing_neighbours));
  growing.setSmoothnessThreshold(static_cast<float>(settings.max_angle_rad));
  growing.setMinClusterSize(settings.min_points);
  std::vector<pcl::PointIndices> segments;
  growing.extract(segments);
  return segments;
}

double count_step_parts(const Cloud& cloud, const std::vector<pcl::PointIndices>& segments) {
  scan::PointCloud points;
  for (const pcl::PointXYZ& p : cloud) points.points.push_back(p.getVector3fMap());
  double count = 0;
  for (const pcl::PointIndices& segment : segments) {
    const detect::PlaneRegion region =
        detect::make_region(points, std::vector<std::uint32_t>(segment.indices.begin(), segment.indices.end()));
    count += detect::find_stair_part(points, region).has_value() ? 1 : 0;
  }
  return count;
}

RunReport run(const std::string& path, const Settings& settings) {
  Cloud::Ptr cloud = load(path);
  RunReport report{.points = static_cast<double>(cloud->size())};
  StageWatch watch;
  const evaluation::PeakMemory memory;
  watch.begin("voxel_grid");
  const Cloud::Ptr thin = thinned(cloud);
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  watch.begin("normals");
  const Normals::Ptr normals = normals_of(thin, tree, settings);
  watch.begin("segmentation");
  const std::vector<pcl::PointIndices> segments = segments_of(thin, normals, tree, settings);
  watch.stop();
  report.growth_MB = memory.growth_MB();
  report.stages = watch.costs();
  report.thinned = static_cast<double>(thin->size());
  report.regions = static_cast<double>(segments.size());
  report.step_parts = count_step_parts(*thin, segments);
  // Every room here has six surfaces.
  if (segments.size() < 6) throw std::runtime_error("hardly anything was segmented");
  return report;
}

}  // namespace
}  // namespace stairway::bench

int main(int argc, char** argv) {
  using namespace stairway::bench;
  try {
    const std::string settings = argc == 3 ? argv[2] : "";
    if (settings != "usual" && settings != "same") throw std::invalid_argument("usage: pcl_run FILE usual|same");
    std::cout << to_json(run(argv[1], settings == "usual" ? kUsual : same())) << '\n';
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "pcl_run: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
