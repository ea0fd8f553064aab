// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "detector/cloud_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "detector/cell_groups.hpp"
#include "detector/cloud_index.hpp"
#include "detector/extents.hpp"
#include "detector/statistics.hpp"

namespace stairway::detect {
namespace {

constexpr double kLargestCloud_m = 500.0;
constexpr double kSmallestCloud_m = 0.5;
constexpr double kStepArea_m2 = 0.14;  // what a usual step shows: 0.17 m by 0.8 m
constexpr double kMaxTilt_rad = std::numbers::pi / 12;
constexpr double kMinPlaneShare = 0.05;     // of all points, on a plane that tells how a cloud lies
constexpr double kSinglePlaneShare = 0.95;  // of all points

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

// Largest of the three extents, without the outermost twentieth of the points on each side; nothing when none is
// finite.
std::optional<double> extent(const scan::PointCloud& cloud) {
  std::vector<float> values;
  double largest = 0.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const Eigen::Vector3f& p : cloud.points)
      if (p.allFinite()) values.push_back(p[axis]);
    if (values.empty()) return std::nullopt;
    const auto outer = static_cast<std::ptrdiff_t>(values.size() / 20);
    std::nth_element(values.begin(), values.begin() + outer, values.end());
    const double low = values[static_cast<std::size_t>(outer)];
    std::nth_element(values.begin(), values.end() - 1 - outer, values.end());
    largest = std::max(largest, *(values.end() - 1 - outer) - low);
  }
  return largest;
}

// Edge of the square of surface that a point has to itself, from how many share a cell; right for dense clouds.
double spacing_in_cells(const scan::PointCloud& cloud, double edge_m) {
  const CellGroups cells = group_by_cell(cloud.points, edge_m);
  std::vector<double> shared;
  shared.reserve(cells.order.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    shared.insert(shared.end(), cells[i].size(), static_cast<double>(cells[i].size()));
  return shared.empty() ? edge_m : edge_m / std::sqrt(median(std::move(shared)));
}

// The same from how far its nearest neighbours reach.
double spacing_of_neighbours(const scan::PointCloud& thinned) {
  constexpr std::size_t kSample = 1000;
  constexpr std::size_t kNeighbours = 8;
  if (thinned.points.size() <= kNeighbours) return kLargestCloud_m;
  const CloudIndex index(thinned.points);
  std::vector<double> reaches;
  std::vector<std::uint32_t> neighbours;
  const std::size_t stride = std::max<std::size_t>(1, thinned.points.size() / kSample);
  for (std::size_t i = 0; i < thinned.points.size(); i += stride) {
    index.nearest(thinned.points[i], kNeighbours + 1, neighbours);
    reaches.push_back((thinned.points[neighbours.back()] - thinned.points[i]).norm());
  }
  return median(std::move(reaches)) * std::sqrt(std::numbers::pi / static_cast<double>(kNeighbours));
}

double typical_spacing(const scan::PointCloud& cloud, double limit_m) {
  const double rough = spacing_in_cells(cloud, 2.0 * limit_m);
  return rough < 0.5 * limit_m ? rough : spacing_of_neighbours(cloud);
}

double tilt(const PlaneRegion& region) { return std::acos(std::min(std::abs(region.axes.normal().z()), 1.0)); }

// The largest plane that is nearer to level than to upright.
const PlaneRegion* level_plane(const std::vector<PlaneRegion>& regions, double min_points) {
  const PlaneRegion* largest = nullptr;
  for (const PlaneRegion& region : regions) {
    const auto size = static_cast<double>(region.points.size());
    if (size < min_points || tilt(region) > std::numbers::pi / 4) continue;
    if (largest == nullptr || region.points.size() > largest->points.size()) largest = &region;
  }
  return largest;
}

Rejection wrong_units(double extent_m) {
  const bool large = extent_m > kLargestCloud_m;
  return {.reason = "units-suspicious",
          .detail = large ? "the cloud spans " + std::to_string(std::lround(extent_m)) +
                                " m: if its file is in millimetres, divide the coordinates by 1000"
                          : "the whole cloud is smaller than half a metre: coordinates are taken as metres",
          .figures = {{"extent", extent_m}, {"limit", large ? kLargestCloud_m : kSmallestCloud_m}}};
}

}  // namespace

std::optional<Rejection> cloud_fault(const scan::PointCloud& cloud, const scan::PointCloud& thinned,
                                     const std::vector<PlaneRegion>& regions, int min_points) {
  const std::optional<double> extent_m = extent(cloud);
  if (!extent_m)
    return Rejection{.reason = "empty-cloud",
                     .detail = "the cloud has no finite point: look at how it was recorded or written",
                     .figures = {{"points", static_cast<double>(cloud.points.size())}}};
  if (*extent_m > kLargestCloud_m || *extent_m < kSmallestCloud_m) return wrong_units(*extent_m);

  const double spacing_limit = std::sqrt(kStepArea_m2 / min_points);
  const double spacing = typical_spacing(thinned, spacing_limit);
  if (spacing > spacing_limit)
    return Rejection{.reason = "too-sparse",
                     .detail =
                         "the points lie too far apart to show steps: scan more slowly or from nearer, or thin "
                         "the cloud less",
                     .figures = {{"spacing", spacing}, {"limit", spacing_limit}}};

  const auto count = static_cast<double>(thinned.points.size());
  const PlaneRegion* level = level_plane(regions, kMinPlaneShare * count);
  if (level != nullptr && tilt(*level) > kMaxTilt_rad)
    return Rejection{.reason = "cloud-tilted",
                     .detail = "the floor seems to slope by " + std::to_string(std::lround(degrees(tilt(*level)))) +
                               " degrees: z must point up; tell gravity, or roll and pitch, of the sensor",
                     .figures = {{"tilt", tilt(*level)}, {"limit", kMaxTilt_rad}}};

  for (const PlaneRegion& region : regions)
    if (static_cast<double>(region.points.size()) > kSinglePlaneShare * count)
      return Rejection{.reason = "single-plane",
                       .detail = "the cloud shows hardly more than one plane: is the sensor turned towards the stairs?",
                       .figures = {{"points", count}, {"on_plane", static_cast<double>(region.points.size())}}};
  return std::nullopt;
}

}  // namespace stairway::detect
