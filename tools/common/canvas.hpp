// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

struct _cairo;
struct _cairo_surface;

namespace stairway::tools {

struct Colour {
  double red, green, blue;  ///< 0..1
  double opacity = 1.0;
};

/// A grey value per cell, rows from the top; 255 is not drawn.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// A page to draw on, white at first; x to the right, y down, in pixels (of an SVG: its user units).
class Canvas {
 public:
  enum class Align { Left, Middle, Right };

  /// A page of `width` x `height`: an SVG if `path` ends in ".svg", else a PNG.
  Canvas(std::filesystem::path path, int width, int height);
  ~Canvas();

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width);
  void dashed_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width);
  void arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width);
  void polygon(const std::vector<Eigen::Vector2d>& corners, const Colour& fill);
  void rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& fill);
  void dashed_frame(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& colour, double width);
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& fill);
  void frame(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& colour);
  /// Has a white rim, to be read on any ground.
  /// @param at  at the base line.
  void text(const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour,
            Align align = Align::Left, bool bold = false);
  /// To be read from below upwards, its middle at `at`.
  void upright_text(const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour);
  double text_width(const std::string& text, double size, bool bold = false);
  /// Stretches the image over the rectangle.
  void image(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const GreyImage& image);

  /// Nothing is drawn outside the rectangle until unclip().
  void clip(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void unclip();

  /// Writes the file. The error is one line that names it.
  tl::expected<void, std::string> write();

 private:
  struct Deleter {
    void operator()(_cairo* context) const;
    void operator()(_cairo_surface* surface) const;
  };
  void stroke(const Colour& colour, double width);

  std::filesystem::path path_;
  std::unique_ptr<_cairo_surface, Deleter> surface_;
  std::unique_ptr<_cairo, Deleter> context_;
};

}  // namespace stairway::tools
