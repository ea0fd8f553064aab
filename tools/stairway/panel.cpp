// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/stairway/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stairway::tools {
namespace {

constexpr double kTitleHeight_px = 34.0;
constexpr double kLeftAxis_px = 52.0;
constexpr double kBottomAxis_px = 44.0;
constexpr double kTextSize = 13.0;
constexpr double kMinTick_px = 64.0;
constexpr double kImagePerPixel = 1.5;  // finer than the page, for zooming into an SVG
constexpr Colour kInk{0.2, 0.2, 0.2};
constexpr Colour kGridLine{0.9, 0.9, 0.9};

Eigen::AlignedBox2d drawing_area(const Eigen::AlignedBox2d& page) {
  return {page.min() + Eigen::Vector2d(kLeftAxis_px, kTitleHeight_px),
          page.max() - Eigen::Vector2d(8.0, kBottomAxis_px)};
}

// Dark where most weight is, but visible where there is any; logarithmic, because density falls with the square of
// the distance.
GreyImage shade(const std::vector<float>& weights, int width, int height) {
  constexpr double kLightest = 205.0, kDarkest = 70.0, kDarkShare = 0.98;
  std::vector<float> seen;
  std::copy_if(weights.begin(), weights.end(), std::back_inserter(seen), [](float weight) { return weight > 0.0F; });
  GreyImage image{width, height, std::vector<std::uint8_t>(weights.size(), 255)};
  if (seen.empty()) return image;
  const auto dark = seen.begin() + static_cast<std::ptrdiff_t>(kDarkShare * static_cast<double>(seen.size() - 1));
  std::nth_element(seen.begin(), dark, seen.end());
  const double full = std::log1p(std::max(static_cast<double>(*dark), 2.0));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0.0F) continue;
    const double share = std::min(1.0, std::log1p(static_cast<double>(weights[i])) / full);
    image.values[i] = static_cast<std::uint8_t>(kLightest + (kDarkest - kLightest) * share);
  }
  return image;
}

}  // namespace

Panel::Panel(const Eigen::AlignedBox2d& page, const Eigen::AlignedBox2d& scene) : page_(drawing_area(page)) {
  const Eigen::Vector2d room = page_.sizes();
  const Eigen::Vector2d wanted = scene.sizes().cwiseMax(0.1);
  scale_ = (room.array() / wanted.array()).minCoeff();
  const Eigen::Vector2d half = 0.5 * room / scale_;
  scene_ = {scene.center() - half, scene.center() + half};
}

Eigen::Vector2d Panel::to_page(double x_m, double y_m) const {
  return {page_.min().x() + (x_m - scene_.min().x()) * scale_, page_.max().y() - (y_m - scene_.min().y()) * scale_};
}

void Panel::draw_points(Canvas& canvas, const scan::PointCloud& cloud,
                        const std::function<Spot(const Eigen::Vector3f&)>& project) const {
  const int width = static_cast<int>(page_.sizes().x() * kImagePerPixel);
  const int height = static_cast<int>(page_.sizes().y() * kImagePerPixel);
  std::vector<float> weights(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  for (const Eigen::Vector3f& point : cloud.points) {
    const Spot spot = project(point);
    const Eigen::Vector2d at = (to_page(spot.x_m, spot.y_m) - page_.min()) * kImagePerPixel;
    // A point covers 2 x 2 cells, so that single ones can be seen. Comparing this way round drops NaN too.
    if (!(spot.weight > 0.0F && at.x() >= 0.0 && at.y() >= 0.0 && at.x() < width - 1 && at.y() < height - 1)) continue;
    const std::size_t cell =
        static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(width) + static_cast<std::size_t>(at.x());
    for (const std::size_t i :
         {cell, cell + 1, cell + static_cast<std::size_t>(width), cell + static_cast<std::size_t>(width) + 1})
      weights[i] += spot.weight;
  }
  canvas.image(low(), high(), shade(weights, width, height));
}

double Panel::tick_m() const {
  for (const double tick : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (tick * scale_ >= kMinTick_px) return tick;
  }
  return 0.25 * scene_.sizes().maxCoeff();
}

void Panel::draw_grid(Canvas& canvas) const {
  const double tick = tick_m();
  for (double x = std::ceil(scene_.min().x() / tick) * tick; x <= scene_.max().x(); x += tick)
    canvas.line(to_page(x, scene_.min().y()), to_page(x, scene_.max().y()), kGridLine, 1.0);
  for (double y = std::ceil(scene_.min().y() / tick) * tick; y <= scene_.max().y(); y += tick)
    canvas.line(to_page(scene_.min().x(), y), to_page(scene_.max().x(), y), kGridLine, 1.0);
}

void Panel::draw_axes(Canvas& canvas, const std::string& title, const std::string& x_name,
                      const std::string& y_name) const {
  const double tick = tick_m();
  const auto number = [&](double value) {
    return fmt::format("{:.{}f}", std::round(value / tick) * tick + 0.0, tick < 1.0 ? 1 : 0);
  };
  canvas.frame(low(), high(), kInk);
  canvas.text(low() - Eigen::Vector2d(0.0, 10.0), title, 15.0, kInk, Canvas::Align::Left, true);
  for (double x = std::ceil(scene_.min().x() / tick) * tick; x <= scene_.max().x(); x += tick) {
    const Eigen::Vector2d at = to_page(x, scene_.min().y());
    canvas.line(at, at - Eigen::Vector2d(0.0, 5.0), kInk, 1.0);
    canvas.text(at + Eigen::Vector2d(0.0, 17.0), number(x), kTextSize, kInk, Canvas::Align::Middle);
  }
  for (double y = std::ceil(scene_.min().y() / tick) * tick; y <= scene_.max().y(); y += tick) {
    const Eigen::Vector2d at = to_page(scene_.min().x(), y);
    canvas.line(at, at + Eigen::Vector2d(5.0, 0.0), kInk, 1.0);
    canvas.text(at + Eigen::Vector2d(-7.0, 4.5), number(y), kTextSize, kInk, Canvas::Align::Right);
  }
  canvas.text({0.5 * (low().x() + high().x()), high().y() + 36.0}, x_name, kTextSize, kInk, Canvas::Align::Middle);
  canvas.text(low() + Eigen::Vector2d(-kLeftAxis_px + 8.0, -10.0), y_name, kTextSize, kInk);
}

}  // namespace stairway::tools
