// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/chart_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stairway::evaluation {
namespace {

using Eigen::Vector2d;
using tools::Canvas;
using tools::Colour;

constexpr Colour kGridLine{0.88, 0.88, 0.88};
constexpr Colour kFaintGridLine{0.95, 0.95, 0.95};
constexpr double kMargin_px = 24.0;
constexpr double kTitleBaseline_px = 34.0;
constexpr double kLegendTop_px = 62.0;
constexpr double kLegendRow_px = 23.0;
constexpr double kSymbol_px = 34.0;
constexpr double kTextSize = 15.0;
constexpr double kBottom_px = 66.0;
constexpr int kMaxTicksX = 14;
constexpr int kMaxTicksY = 9;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value, bool only_positive) {
    if (!std::isfinite(value) || (only_positive && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool is_empty() const { return !(low <= high); }
};

Axis make_axis(const Range& range, bool logarithmic, int max_ticks) {
  if (range.is_empty()) return logarithmic ? logarithmic_axis(1.0, 10.0) : linear_axis(0.0, 1.0, max_ticks);
  return logarithmic ? logarithmic_axis(range.low, range.high) : linear_axis(range.low, range.high, max_ticks);
}

Axis make_x_axis(const Chart& chart) {
  if (!chart.categories.empty()) return {.low = -0.5, .high = static_cast<double>(chart.categories.size()) - 0.5};
  Range range;
  for (const Curve& curve : chart.curves)
    for (const double x : curve.x) range.take(x, chart.logarithmic);
  return make_axis(range, chart.logarithmic, kMaxTicksX);
}

Axis make_y_axis(const Chart& chart) {
  Range range;
  for (const Curve& curve : chart.curves) {
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      const double spread = spread_at(curve, i);
      range.take(curve.y[i] + spread, chart.logarithmic);
      if (!chart.logarithmic && curve.y[i] < 0.0) range.take(curve.y[i] - spread, false);
      if (chart.logarithmic) range.take(curve.y[i], true);
    }
  }
  if (!chart.logarithmic && !range.is_empty()) range.take(0.0, false);
  // The number above a bar needs a place.
  constexpr double kHeadroom = 0.05;
  if (!chart.logarithmic && !chart.categories.empty() && !range.is_empty())
    range.high += kHeadroom * (range.high - range.low);
  return make_axis(range, chart.logarithmic, kMaxTicksY);
}

double entry_width(Canvas& canvas, const Curve& curve) {
  return kSymbol_px + canvas.text_width(curve.name, kTextSize) + 26.0;
}

/// Upper left corner of every entry of the legend; as many rows as it takes.
std::vector<Vector2d> legend_places(Canvas& canvas, const Chart& chart) {
  std::vector<Vector2d> places;
  Vector2d at(kMargin_px, kLegendTop_px);
  for (const Curve& curve : chart.curves) {
    const double width = entry_width(canvas, curve);
    if (at.x() > kMargin_px && at.x() + width > kChartWidth_px - kMargin_px) at = {kMargin_px, at.y() + kLegendRow_px};
    places.push_back(at);
    at.x() += width;
  }
  return places;
}

}  // namespace

double spread_at(const Curve& curve, std::size_t i) {
  return i < curve.spread.size() && std::isfinite(curve.spread[i]) ? curve.spread[i] : 0.0;
}

CurveStyle style_of(std::size_t curve) {
  // Okabe and Ito's colours, which people with any colour vision can tell apart.
  static constexpr std::array<Colour, 7> kColours{{{0.00, 0.45, 0.70},
                                                   {0.84, 0.37, 0.00},
                                                   {0.00, 0.62, 0.45},
                                                   {0.80, 0.47, 0.65},
                                                   {0.90, 0.62, 0.00},
                                                   {0.34, 0.71, 0.91},
                                                   {0.30, 0.30, 0.30}}};
  return {kColours[curve % kColours.size()], static_cast<CurveStyle::Marker>(curve % 4)};
}

void draw_marker(Canvas& canvas, const Vector2d& at, const CurveStyle& style, bool is_hollow) {
  constexpr double kRadius_px = 5.0, kHollowRadius_px = 3.2;
  const auto draw = [&](double radius, const Colour& colour) {
    const double r = radius;
    switch (style.marker) {
      case CurveStyle::Marker::Disc:
        return canvas.disc(at, r, colour);
      case CurveStyle::Marker::Square:
        return canvas.rectangle(at - Vector2d(0.9 * r, 0.9 * r), at + Vector2d(0.9 * r, 0.9 * r), colour);
      case CurveStyle::Marker::Triangle:
        return canvas.polygon(
            {at + Vector2d(0, -1.25 * r), at + Vector2d(1.1 * r, 0.75 * r), at + Vector2d(-1.1 * r, 0.75 * r)}, colour);
      case CurveStyle::Marker::Diamond:
        return canvas.polygon({at + Vector2d(0, -1.3 * r), at + Vector2d(1.3 * r, 0), at + Vector2d(0, 1.3 * r),
                               at + Vector2d(-1.3 * r, 0)},
                              colour);
    }
  };
  draw(kRadius_px, style.colour);
  if (is_hollow) draw(kHollowRadius_px, {1.0, 1.0, 1.0});
}

ChartFrame::ChartFrame(Canvas& canvas, const Chart& chart)
    : canvas_(canvas), chart_(chart), x_(make_x_axis(chart)), y_(make_y_axis(chart)) {
  double widest = 0.0;
  for (const std::string& label : y_.labels) widest = std::max(widest, canvas.text_width(label, kTextSize));
  const std::vector<Vector2d> legend = legend_places(canvas, chart);
  const double top = (legend.empty() ? kLegendTop_px - kLegendRow_px : legend.back().y()) + 26.0;
  area_ = {Vector2d(kMargin_px + 34.0 + widest, top),
           Vector2d(kChartWidth_px - kMargin_px, kChartHeight_px - kBottom_px)};
}

Vector2d ChartFrame::to_page(double x, double y) const {
  // Markers on the left and right border would be cut in half.
  const double inset = chart_.categories.empty() ? 16.0 : 0.0;
  return {area_.min().x() + inset + x_.share_of(x) * (area_.sizes().x() - 2.0 * inset),
          area_.max().y() - y_.share_of(y) * area_.sizes().y()};
}

void ChartFrame::draw_below() const {
  const auto across = [&](double y, const Colour& colour) {
    const double v = to_page(x_.low, y).y();
    canvas_.line({area_.min().x(), v}, {area_.max().x(), v}, colour, 1.0);
  };
  const auto upwards = [&](double x, const Colour& colour) {
    canvas_.line(to_page(x, y_.low), to_page(x, y_.high), colour, 1.0);
  };
  for (const double y : y_.minor_ticks) across(y, kFaintGridLine);
  for (const double x : x_.minor_ticks) upwards(x, kFaintGridLine);
  for (const double y : y_.ticks) across(y, kGridLine);
  for (const double x : x_.ticks) upwards(x, kGridLine);
}

void ChartFrame::draw_above() const {
  canvas_.text({kMargin_px, kTitleBaseline_px}, chart_.title, 19.0, kInk, Canvas::Align::Left, true);
  draw_legend();
  draw_x_axis();
  draw_y_axis();
  if (!y_.logarithmic && y_.low < 0.0 && y_.high > 0.0) {
    const double zero = to_page(x_.low, 0.0).y();
    canvas_.line({area_.min().x(), zero}, {area_.max().x(), zero}, kInk, 1.0);
  }
  canvas_.frame(area_.min(), area_.max(), kInk);
}

void ChartFrame::draw_legend() const {
  const std::vector<Vector2d> places = legend_places(canvas_, chart_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Curve& curve = chart_.curves[i];
    const CurveStyle style = style_of(i);
    const Vector2d middle = places[i] + Vector2d(0.5 * kSymbol_px - 4.0, -5.0);
    const Vector2d half(13.0, 0.0);
    if (!chart_.categories.empty()) {
      const Vector2d low = middle - Vector2d(11.0, 6.0), high = middle + Vector2d(11.0, 6.0);
      curve.from_paper ? canvas_.dashed_frame(low, high, style.colour, 2.0)
                       : canvas_.rectangle(low, high, style.colour);
    } else {
      curve.from_paper ? canvas_.dashed_line(middle - half, middle + half, style.colour, 2.0)
                       : canvas_.line(middle - half, middle + half, style.colour, 2.0);
      draw_marker(canvas_, middle, style, curve.from_paper);
    }
    canvas_.text(places[i] + Vector2d(kSymbol_px, 0.0), curve.name, kTextSize, kInk);
  }
}

void ChartFrame::draw_x_axis() const {
  const double below = area_.max().y() + 20.0;
  for (std::size_t i = 0; i < chart_.categories.size(); ++i)
    canvas_.text({to_page(static_cast<double>(i), y_.low).x(), below}, chart_.categories[i], kTextSize, kInk,
                 Canvas::Align::Middle);
  for (std::size_t i = 0; i < x_.ticks.size(); ++i) {
    const double x = to_page(x_.ticks[i], y_.low).x();
    canvas_.line({x, area_.max().y()}, {x, area_.max().y() - 5.0}, kInk, 1.0);
    canvas_.text({x, below}, x_.labels[i], kTextSize, kInk, Canvas::Align::Middle);
  }
  canvas_.text({area_.center().x(), kChartHeight_px - 18.0}, chart_.x_label, kTextSize, kInk, Canvas::Align::Middle);
}

void ChartFrame::draw_y_axis() const {
  for (std::size_t i = 0; i < y_.ticks.size(); ++i) {
    const Vector2d at(area_.min().x(), to_page(x_.low, y_.ticks[i]).y());
    canvas_.line(at, at + Vector2d(5.0, 0.0), kInk, 1.0);
    canvas_.text(at + Vector2d(-8.0, 5.0), y_.labels[i], kTextSize, kInk, Canvas::Align::Right);
  }
  canvas_.upright_text({kMargin_px + 10.0, area_.center().y()}, chart_.y_label, kTextSize, kInk);
}

}  // namespace stairway::evaluation
