// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "scan_assembly/point_cloud.hpp"
#include "tools/common/canvas.hpp"

namespace stairway::tools {

/// A part of a page that shows a part of a plane, in one scale for both directions.
class Panel {
 public:
  /// @param page   the place on the page, axes and title included [px].
  /// @param scene  what must be visible, in the plane [m]; more is shown in the direction that has room.
  Panel(const Eigen::AlignedBox2d& page, const Eigen::AlignedBox2d& scene);

  Eigen::Vector2d to_page(double x_m, double y_m) const;
  const Eigen::AlignedBox2d& scene() const { return scene_; }
  Eigen::Vector2d low() const { return page_.min(); }   ///< upper left corner of the drawing [px]
  Eigen::Vector2d high() const { return page_.max(); }  ///< lower right corner
  double pixels_per_metre() const { return scale_; }

  /// How a point of the cloud appears: its place in the plane [m], and how much it counts; 0 leaves it out.
  struct Spot {
    double x_m;
    double y_m;
    float weight;
  };
  /// Draws the cloud; the more points share a place, the darker it is.
  void draw_points(Canvas& canvas, const scan::PointCloud& cloud,
                   const std::function<Spot(const Eigen::Vector3f&)>& project) const;
  void draw_grid(Canvas& canvas) const;
  /// Title above, numbers along the axes, and a frame.
  void draw_axes(Canvas& canvas, const std::string& title, const std::string& x_name, const std::string& y_name) const;

 private:
  double tick_m() const;

  Eigen::AlignedBox2d page_;
  Eigen::AlignedBox2d scene_;
  double scale_ = 1.0;
};

}  // namespace stairway::tools
