// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/chart_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/evaluation/chart_frame.hpp"

namespace stairway::evaluation {
namespace {

using Eigen::Vector2d;
using tools::Canvas;
using tools::Colour;

constexpr double kLine_px = 2.0;

bool is_shown(const Chart& chart, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  return !chart.logarithmic || (y > 0.0 && (x > 0.0 || !chart.categories.empty()));
}

/// @param at  the middle of the bar, on the page.
void draw_error_bar(Canvas& canvas, const ChartFrame& frame, const Vector2d& at, double y, double spread,
                    const Colour& colour) {
  if (!(spread > 0.0)) return;
  const Vector2d half(4.0, 0.0);
  const auto on_page = [&](double value) {
    return Vector2d(at.x(), frame.to_page(0.0, std::clamp(value, frame.y_axis().low, frame.y_axis().high)).y());
  };
  const Vector2d top = on_page(y + spread), bottom = on_page(y - spread);
  canvas.line(bottom, top, colour, 1.3);
  canvas.line(top - half, top + half, colour, 1.3);
  if (y - spread >= frame.y_axis().low) canvas.line(bottom - half, bottom + half, colour, 1.3);
}

/// How far curve `index` is moved aside [px].
double aside_px(const Chart& chart, std::size_t index) {
  constexpr double kApart_px = 5.0;
  int before = 0, all = 0;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    if (chart.curves[i].spread.empty()) continue;
    before += i < index ? 1 : 0;
    ++all;
  }
  return chart.curves[index].spread.empty() ? 0.0 : kApart_px * (before - 0.5 * (all - 1));
}

void draw_points(Canvas& canvas, const ChartFrame& frame, const Chart& chart, std::size_t index) {
  const Curve& curve = chart.curves[index];
  const CurveStyle style = style_of(index);
  const Vector2d aside(aside_px(chart, index), 0.0);
  std::vector<std::optional<Vector2d>> places;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    places.emplace_back();
    if (is_shown(chart, curve.x[i], curve.y[i])) places.back() = frame.to_page(curve.x[i], curve.y[i]) + aside;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    draw_error_bar(canvas, frame, *places[i], curve.y[i], spread_at(curve, i), style.colour);
    if (i == 0 || !places[i - 1]) continue;
    curve.from_paper ? canvas.dashed_line(*places[i - 1], *places[i], style.colour, kLine_px)
                     : canvas.line(*places[i - 1], *places[i], style.colour, kLine_px);
  }
  for (const auto& place : places)
    if (place) draw_marker(canvas, *place, style, curve.from_paper);
}

std::string short_number(double value) {
  const int digits = std::abs(value) >= 100.0 ? 0 : std::abs(value) >= 10.0 ? 1 : 2;
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (digits > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void draw_bars(Canvas& canvas, const ChartFrame& frame, const Chart& chart, std::size_t index) {
  constexpr double kFilled = 0.8;  // of the width of a category
  constexpr double kNumberSize = 12.0;
  const Curve& curve = chart.curves[index];
  const CurveStyle style = style_of(index);
  const double width = kFilled / static_cast<double>(chart.curves.size());
  const double foot = std::clamp(0.0, frame.y_axis().low, frame.y_axis().high);
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!is_shown(chart, curve.x[i], curve.y[i])) continue;
    const double left = curve.x[i] - 0.5 * kFilled + width * static_cast<double>(index);
    const Vector2d a = frame.to_page(left + 0.04 * width, foot), b = frame.to_page(left + 0.96 * width, curve.y[i]);
    const Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b), top(0.5 * (a.x() + b.x()), low.y());
    curve.from_paper ? canvas.dashed_frame(low, high, style.colour, kLine_px)
                     : canvas.rectangle(low, high, style.colour);
    const double spread = spread_at(curve, i);
    draw_error_bar(canvas, frame, top, curve.y[i], spread, kInk);
    const std::string number = short_number(curve.y[i]);
    if (canvas.text_width(number, kNumberSize) > high.x() - low.x() + 8.0) continue;
    const double above = std::min(low.y(), frame.to_page(0.0, std::min(curve.y[i] + spread, frame.y_axis().high)).y());
    canvas.text({top.x(), above - 5.0}, number, kNumberSize, kInk, Canvas::Align::Middle);
  }
}

}  // namespace

tl::expected<void, std::string> draw_chart(const std::filesystem::path& path, const Chart& chart) {
  Canvas canvas(path, kChartWidth_px, kChartHeight_px);
  const ChartFrame frame(canvas, chart);
  frame.draw_below();
  for (std::size_t i = 0; i < chart.curves.size(); ++i)
    chart.categories.empty() ? draw_points(canvas, frame, chart, i) : draw_bars(canvas, frame, chart, i);
  frame.draw_above();
  return canvas.write();
}

}  // namespace stairway::evaluation
