// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/marked_cloud.hpp"

#include <array>
#include <cstdint>

#include "tools/stairway/stair_chart.hpp"

namespace stairway::tools {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kElsewhere{170, 170, 170};
constexpr Colour kTread{31, 119, 220};
constexpr Colour kRiser{35, 160, 70};
constexpr double kTolerance_m = 0.04;

}  // namespace

CloudMarks mark_stairways(const scan::PointCloud& cloud, const std::vector<detect::Stairway>& stairways) {
  CloudMarks marks;
  auto& [colours, labels] = marks;
  colours.assign(cloud.points.size(), kElsewhere);
  labels.assign(cloud.points.size(), 0);
  for (std::size_t s = 0; s < stairways.size(); ++s) {
    if (stairways[s].nosings.empty()) continue;
    const StairChart chart(stairways[s]);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      if (labels[i] != 0) continue;
      const auto part = chart.part_at(chart.to_chart(cloud.points[i].cast<double>()), kTolerance_m);
      if (part == StairChart::Part::None) continue;
      colours[i] = part == StairChart::Part::Tread ? kTread : kRiser;
      labels[i] = static_cast<std::uint32_t>(s + 1);
    }
  }
  return marks;
}

tl::expected<void, ipc::CloudFileError> write_marked_cloud(const std::filesystem::path& path,
                                                           const scan::PointCloud& cloud,
                                                           const std::vector<detect::Stairway>& stairways) {
  const CloudMarks marks = mark_stairways(cloud, stairways);
  return write_cloud(path, cloud, {.colours = marks.colours, .labels = marks.labels});
}

tl::expected<void, ipc::CloudFileError> write_cloud(const std::filesystem::path& path, const scan::PointCloud& cloud,
                                                    const ipc::PointAttributes& attributes) {
  return path.extension() == ".pcd" ? ipc::write_pcd(path, cloud, attributes) : ipc::write_ply(path, cloud, attributes);
}

}  // namespace stairway::tools
