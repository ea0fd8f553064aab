// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "tools/common/canvas.hpp"
#include "tools/evaluation/axis.hpp"
#include "tools/evaluation/experiment.hpp"

namespace stairway::evaluation {

inline constexpr int kChartWidth_px = 1000;
inline constexpr int kChartHeight_px = 620;
inline constexpr tools::Colour kInk{0.15, 0.15, 0.15};

/// Half the height of the error bar at point `i`; 0 where there is none.
double spread_at(const Curve& curve, std::size_t i);

/// How one curve looks. Curves differ in colour and in marker, so that a copy without colours can be read as well.
struct CurveStyle {
  enum class Marker { Disc, Square, Triangle, Diamond };
  tools::Colour colour;
  Marker marker;
};
CurveStyle style_of(std::size_t curve);

/// Draws a marker; a hollow one for what the paper states.
void draw_marker(tools::Canvas& canvas, const Eigen::Vector2d& at, const CurveStyle& style, bool is_hollow);

/// Everything around the data: title, legend, grid, axes with their numbers. The legend stands above the drawing.
class ChartFrame {
 public:
  ChartFrame(tools::Canvas& canvas, const Chart& chart);

  /// Where a place of the chart is on the page [px]. Bars have their categories at x = 0, 1, 2 ...
  Eigen::Vector2d to_page(double x, double y) const;
  const Axis& y_axis() const { return y_; }
  const Eigen::AlignedBox2d& area() const { return area_; }  ///< of the drawing [px]

  void draw_below() const;  ///< grid, before the data
  void draw_above() const;  ///< the rest, after them

 private:
  void draw_legend() const;
  void draw_x_axis() const;
  void draw_y_axis() const;

  tools::Canvas& canvas_;
  const Chart& chart_;
  Axis x_;
  Axis y_;
  Eigen::AlignedBox2d area_;
};

}  // namespace stairway::evaluation
