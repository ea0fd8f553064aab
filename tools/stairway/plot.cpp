// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tools/common/canvas.hpp"
#include "tools/stairway/panel.hpp"
#include "tools/stairway/stair_chart.hpp"

namespace stairway::tools {
namespace {

constexpr int kWidth_px = 1600;
constexpr int kHeight_px = 820;
constexpr double kHeader_px = 74.0;

constexpr Colour kInk{0.15, 0.15, 0.15};
constexpr Colour kSoftInk{0.4, 0.4, 0.4};
constexpr Colour kTread{0.12, 0.42, 0.80};
constexpr Colour kTreadArea{0.12, 0.42, 0.80, 0.22};
constexpr Colour kRiser{0.10, 0.58, 0.28};
constexpr Colour kNosing{0.87, 0.30, 0.06};
constexpr Colour kRailing{0.55, 0.20, 0.65};
constexpr Colour kRobot{0.15, 0.15, 0.15};

// Rounded to what is printed, so that no "-0.0" appears.
double degrees(double angle_rad) { return std::round(angle_rad * 1800.0 / std::numbers::pi) / 10.0 + 0.0; }

std::string summary(const detect::Stairway& s) {
  std::string text = fmt::format(
      "{}, {}, {} steps   height {:.1f} ±{:.1f} mm   depth {:.1f} ±{:.1f} mm   width {:.0f} ±{:.0f} mm   "
      "pitch {:.1f}°   heading {:.1f}°",
      to_string(s.kind), to_string(s.direction), s.nosings.size(), 1e3 * s.step_height, 1e3 * s.step_height_sigma,
      1e3 * s.step_depth, 1e3 * s.step_depth_sigma, 1e3 * s.width, 1e3 * s.width_sigma, degrees(s.pitch()),
      degrees(s.heading));
  if (s.kind == detect::StairwayKind::Spiral) text += fmt::format("   turn {:.1f}° a step", degrees(s.turn_per_step));
  return text;
}

void draw_header(Canvas& canvas, const std::string& title, const detect::Detection& detection) {
  const auto& stairways = detection.stairways;
  canvas.text({24.0, 32.0}, title, 20.0, kInk, Canvas::Align::Left, true);
  std::string line = "no stairway";
  if (!stairways.empty()) {
    line = summary(stairways.front());
  } else if (!detection.rejected.empty()) {
    line += ": " + detection.rejected.front().detail;
  }
  canvas.text({24.0, 58.0}, line, 15.0, kInk);
  if (stairways.size() > 1) {
    canvas.text({kWidth_px - 24.0, 32.0}, fmt::format("the best of {} stairways", stairways.size()), 15.0, kSoftInk,
                Canvas::Align::Right);
  }
}

/// Where most of the points are: the 1st to 99th percentile of two coordinates.
Eigen::AlignedBox2d bulk(const scan::PointCloud& cloud, int x, int y) {
  Eigen::AlignedBox2d box;
  std::vector<float> values;
  Eigen::Vector2d low(0.0, 0.0), high(1.0, 1.0);
  for (const auto& [axis, out] : {std::pair{x, 0}, std::pair{y, 1}}) {
    values.clear();
    for (const Eigen::Vector3f& p : cloud.points)
      if (p.allFinite()) values.push_back(p[axis]);
    if (values.empty()) continue;
    const auto nth = [&](double share) {
      const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
      std::nth_element(values.begin(), place, values.end());
      return static_cast<double>(*place);
    };
    low[out] = nth(0.01);
    high[out] = nth(0.99);
  }
  box.extend(low).extend(high);
  return box;
}

void draw_legend(Canvas& canvas, const Panel& panel) {
  double x = panel.high().x();
  const double y = panel.low().y() - 10.0;
  const auto entry = [&](const std::string& name, const auto& draw_symbol) {
    x -= canvas.text_width(name, 13.0);
    canvas.text({x, y}, name, 13.0, kInk);
    x -= 24.0;
    draw_symbol(Eigen::Vector2d(x + 9.0, y - 4.5));
    x -= 14.0;
  };
  const Eigen::Vector2d half(9.0, 0.0);
  entry("riser", [&](const Eigen::Vector2d& at) { canvas.line(at - half, at + half, kRiser, 3.0); });
  entry("tread", [&](const Eigen::Vector2d& at) { canvas.line(at - half, at + half, kTread, 3.0); });
  entry("nosing", [&](const Eigen::Vector2d& at) { canvas.disc(at, 4.5, kNosing); });
}

/// A length between two parallel lines that lead from the object to the dimension line, as on a drawing.
void draw_height_dimension(Canvas& canvas, const Panel& panel, const StairChart& chart, double height_m) {
  const Eigen::Vector3d& upper = chart.nosings().front();
  const double lower_z = chart.foot_m();
  const double u = upper.x() - 0.25;
  for (const double z : {lower_z, upper.z()})
    canvas.line(panel.to_page(upper.x() - 0.03, z), panel.to_page(u - 0.04, z), kSoftInk, 1.0);
  const Eigen::Vector2d a = panel.to_page(u, lower_z), b = panel.to_page(u, upper.z());
  canvas.arrow(0.5 * (a + b), a, kSoftInk, 1.0);
  canvas.arrow(0.5 * (a + b), b, kSoftInk, 1.0);
  canvas.text(0.5 * (a + b) + Eigen::Vector2d(-8.0, 5.0), fmt::format("{:.1f} mm", 1e3 * height_m), 14.0, kInk,
              Canvas::Align::Right);
}

void draw_depth_dimension(Canvas& canvas, const Panel& panel, const StairChart& chart, double depth_m) {
  if (chart.nosings().size() < 2) return;
  const Eigen::Vector3d& first = chart.nosings()[chart.nosings().size() - 2];
  const Eigen::Vector3d& last = chart.nosings().back();
  const double z = last.z() + 0.22;
  for (const Eigen::Vector3d& nosing : {first, last})
    canvas.line(panel.to_page(nosing.x(), nosing.z() + 0.03), panel.to_page(nosing.x(), z + 0.04), kSoftInk, 1.0);
  const Eigen::Vector2d a = panel.to_page(first.x(), z), b = panel.to_page(last.x(), z);
  canvas.arrow(0.5 * (a + b), a, kSoftInk, 1.0);
  canvas.arrow(0.5 * (a + b), b, kSoftInk, 1.0);
  canvas.text(0.5 * (a + b) - Eigen::Vector2d(0.0, 9.0), fmt::format("{:.1f} mm", 1e3 * depth_m), 14.0, kInk,
              Canvas::Align::Middle);
}

void draw_profile(Canvas& canvas, const Panel& panel, const StairChart& chart) {
  const auto& nosings = chart.nosings();
  const auto at = [&](double u, double z) { return panel.to_page(u, z); };
  for (std::size_t i = 0; i < nosings.size(); ++i) {
    const double below = i > 0 ? nosings[i - 1].z() : chart.foot_m();
    canvas.line(at(nosings[i].x(), below), at(nosings[i].x(), nosings[i].z()), kRiser, 2.5);
    if (i + 1 < nosings.size())
      canvas.line(at(nosings[i].x(), nosings[i].z()), at(nosings[i + 1].x(), nosings[i].z()), kTread, 2.5);
  }
  for (const Eigen::Vector3d& nosing : nosings) canvas.disc(at(nosing.x(), nosing.z()), 4.0, kNosing);
}

void draw_side_view(Canvas& canvas, const Eigen::AlignedBox2d& page, const scan::PointCloud& cloud,
                    const detect::Stairway& stairway) {
  const StairChart chart(stairway);
  Eigen::AlignedBox2d scene;
  for (const Eigen::Vector3d& nosing : chart.nosings()) scene.extend(Eigen::Vector2d(nosing.x(), nosing.z()));
  scene.extend(Eigen::Vector2d(0.0, chart.foot_m()));
  scene.extend(scene.min() - Eigen::Vector2d(1.0, 0.3)).extend(scene.max() + Eigen::Vector2d(0.9, 0.6));
  const Panel panel(page, scene);
  canvas.clip(panel.low(), panel.high());
  panel.draw_grid(canvas);
  panel.draw_points(canvas, cloud, [&](const Eigen::Vector3f& point) {
    const Eigen::Vector3d p = chart.to_chart(point.cast<double>());
    return Panel::Spot{p.x(), p.z(), std::abs(p.y()) <= chart.half_width_m() ? 1.0F : 0.0F};
  });
  draw_profile(canvas, panel, chart);
  draw_height_dimension(canvas, panel, chart, stairway.step_height);
  draw_depth_dimension(canvas, panel, chart, stairway.step_depth);
  canvas.unclip();
  panel.draw_axes(canvas, "From the side", "along the ascent from the lowest nosing [m]", "z [m]");
  draw_legend(canvas, panel);
}

void draw_robot(Canvas& canvas, const Panel& panel) {
  const Eigen::Vector2d at = panel.to_page(0.0, 0.0);
  canvas.polygon({at + Eigen::Vector2d(13.0, 0.0), at + Eigen::Vector2d(-8.0, -8.0), at + Eigen::Vector2d(-4.0, 0.0),
                  at + Eigen::Vector2d(-8.0, 8.0)},
                 kRobot);
  canvas.text(at + Eigen::Vector2d(-2.0, 24.0), "base", 13.0, kRobot, Canvas::Align::Middle);
}

void draw_from_above(Canvas& canvas, const Panel& panel, const detect::Stairway& stairway, const std::string& label) {
  const auto at = [&](const Eigen::Vector3d& p) { return panel.to_page(p.x(), p.y()); };
  const auto& nosings = stairway.nosings;
  for (std::size_t i = 0; i + 1 < nosings.size(); ++i)
    canvas.polygon({at(nosings[i].left), at(nosings[i].right), at(nosings[i + 1].right), at(nosings[i + 1].left)},
                   kTreadArea);
  for (std::size_t i = 0; i + 1 < nosings.size(); ++i) {
    if (stairway.railing_left) canvas.line(at(nosings[i].left), at(nosings[i + 1].left), kRailing, 4.0);
    if (stairway.railing_right) canvas.line(at(nosings[i].right), at(nosings[i + 1].right), kRailing, 4.0);
  }
  for (const detect::Nosing& nosing : nosings) canvas.line(at(nosing.left), at(nosing.right), kNosing, 2.0);

  const Eigen::Vector2d from = at(nosings.front().middle()), to = at(nosings.back().middle());
  if ((to - from).norm() > 30.0 && stairway.kind == detect::StairwayKind::Straight) canvas.arrow(from, to, kInk, 1.5);
  canvas.disc(at(stairway.anchor), 6.5, kInk);
  canvas.disc(at(stairway.anchor), 4.0, {1.0, 1.0, 1.0});
  const Eigen::Vector2d beyond =
      (to - from).norm() > 1.0 ? Eigen::Vector2d((to - from).normalized()) : Eigen::Vector2d(1.0, 0.0);
  if (!label.empty())
    canvas.text(to + 18.0 * beyond + Eigen::Vector2d(0.0, 5.0), label, 15.0, kInk, Canvas::Align::Middle, true);
}

Eigen::AlignedBox2d plan_area(const scan::PointCloud& cloud, const std::vector<detect::Stairway>& stairways) {
  if (stairways.empty()) return bulk(cloud, 0, 1);
  constexpr double kRobotInView_m = 8.0;
  constexpr double kMargin_m = 0.8;
  Eigen::AlignedBox2d area;
  for (const detect::Stairway& stairway : stairways) {
    for (const detect::Nosing& nosing : stairway.nosings)
      area.extend(nosing.left.head<2>()).extend(nosing.right.head<2>());
  }
  if (area.exteriorDistance(Eigen::Vector2d::Zero()) < kRobotInView_m) area.extend(Eigen::Vector2d(0.0, 0.0));
  return {area.min() - Eigen::Vector2d::Constant(kMargin_m), area.max() + Eigen::Vector2d::Constant(kMargin_m)};
}

/// What hides the stairway from above is left out; handrails stay.
double highest_shown_m(const std::vector<detect::Stairway>& stairways) {
  constexpr double kAbove_m = 1.0;
  double highest = 0.5;
  for (const detect::Stairway& stairway : stairways) highest = std::max(highest, stairway.nosings.back().left.z());
  return highest + kAbove_m;
}

void draw_plan(Canvas& canvas, const Eigen::AlignedBox2d& page, const scan::PointCloud& cloud,
               const std::vector<detect::Stairway>& stairways) {
  constexpr float kFloorWeight = 0.03F;  // the floor would else be darker than what stands on it
  constexpr float kFloorThickness_m = 0.06F;
  const Panel panel(page, plan_area(cloud, stairways));
  const auto highest = static_cast<float>(highest_shown_m(stairways));
  canvas.clip(panel.low(), panel.high());
  panel.draw_grid(canvas);
  panel.draw_points(canvas, cloud, [&](const Eigen::Vector3f& p) {
    const float weight = p.z() > highest ? 0.0F : std::abs(p.z()) < kFloorThickness_m ? kFloorWeight : 1.0F;
    return Panel::Spot{static_cast<double>(p.x()), static_cast<double>(p.y()), weight};
  });
  for (std::size_t i = 0; i < stairways.size(); ++i)
    draw_from_above(canvas, panel, stairways[i], stairways.size() > 1 ? std::to_string(i + 1) : "");
  draw_robot(canvas, panel);
  canvas.unclip();
  panel.draw_axes(canvas, "From above", "x [m]", "y [m]");
}

void draw_scene_from_the_side(Canvas& canvas, const Eigen::AlignedBox2d& page, const scan::PointCloud& cloud) {
  const Panel panel(page, bulk(cloud, 0, 2));
  canvas.clip(panel.low(), panel.high());
  panel.draw_grid(canvas);
  panel.draw_points(canvas, cloud, [](const Eigen::Vector3f& p) {
    return Panel::Spot{static_cast<double>(p.x()), static_cast<double>(p.z()), 1.0F};
  });
  canvas.unclip();
  panel.draw_axes(canvas, "From the side", "x [m]", "z [m]");
}

std::vector<detect::Stairway> with_nosings(std::vector<detect::Stairway> stairways) {
  std::erase_if(stairways, [](const detect::Stairway& stairway) { return stairway.nosings.empty(); });
  return stairways;
}

}  // namespace

bool is_plottable(const std::filesystem::path& path) {
  return path.extension() == ".png" || path.extension() == ".svg";
}

tl::expected<void, std::string> plot_detection(const std::filesystem::path& path, const std::string& title,
                                               const scan::PointCloud& cloud, const detect::Detection& detection) {
  const std::vector<detect::Stairway> stairways = with_nosings(detection.stairways);
  const double middle = 0.5 * kWidth_px;
  const Eigen::AlignedBox2d left{Eigen::Vector2d(16.0, kHeader_px), Eigen::Vector2d(middle - 4.0, kHeight_px - 8.0)};
  const Eigen::AlignedBox2d right{Eigen::Vector2d(middle + 4.0, kHeader_px),
                                  Eigen::Vector2d(kWidth_px - 16.0, kHeight_px - 8.0)};
  Canvas canvas(path, kWidth_px, kHeight_px);
  draw_header(canvas, title, detection);
  if (stairways.empty()) {
    draw_scene_from_the_side(canvas, left, cloud);
  } else {
    draw_side_view(canvas, left, cloud, stairways.front());
  }
  draw_plan(canvas, right, cloud, stairways);
  return canvas.write();
}

}  // namespace stairway::tools
