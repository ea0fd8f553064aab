// SPDX-FileCopyrightText: The stairwayd authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/common/canvas.hpp"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace stairway::tools {
namespace {

bool is_svg(const std::filesystem::path& path) { return path.extension() == ".svg"; }

cairo_surface_t* make_surface(const std::filesystem::path& path, int width, int height) {
  return is_svg(path) ? cairo_svg_surface_create(path.c_str(), width, height)
                      : cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
}

void set_source(cairo_t* context, const Colour& c) {
  cairo_set_source_rgba(context, c.red, c.green, c.blue, c.opacity);
}

void select_font(cairo_t* context, double size, bool bold) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
}

}  // namespace

void Canvas::Deleter::operator()(_cairo* context) const { cairo_destroy(context); }
void Canvas::Deleter::operator()(_cairo_surface* surface) const { cairo_surface_destroy(surface); }

Canvas::Canvas(std::filesystem::path path, int width, int height)
    : path_(std::move(path)), surface_(make_surface(path_, width, height)), context_(cairo_create(surface_.get())) {
  set_source(context_.get(), {1, 1, 1});
  cairo_paint(context_.get());
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

Canvas::~Canvas() = default;

void Canvas::stroke(const Colour& colour, double width) {
  set_source(context_.get(), colour);
  cairo_set_line_width(context_.get(), width);
  cairo_stroke(context_.get());
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width) {
  cairo_move_to(context_.get(), from.x(), from.y());
  cairo_line_to(context_.get(), to.x(), to.y());
  stroke(colour, width);
}

void Canvas::dashed_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width) {
  const double dashes[] = {6.0, 4.0};
  cairo_set_dash(context_.get(), dashes, 2, 0.0);
  line(from, to, colour, width);
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void Canvas::arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour, double width) {
  constexpr double kHeadLength = 11.0, kHeadHalfWidth = 4.5;
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d neck = to - kHeadLength * along;
  line(from, neck, colour, width);
  polygon({to, neck + kHeadHalfWidth * across, neck - kHeadHalfWidth * across}, colour);
}

void Canvas::polygon(const std::vector<Eigen::Vector2d>& corners, const Colour& fill) {
  for (const Eigen::Vector2d& corner : corners) cairo_line_to(context_.get(), corner.x(), corner.y());
  cairo_close_path(context_.get());
  set_source(context_.get(), fill);
  cairo_fill(context_.get());
}

void Canvas::rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& fill) {
  polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, fill);
}

void Canvas::dashed_frame(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& colour, double width) {
  cairo_rectangle(context_.get(), low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
  const double dashes[] = {6.0, 4.0};
  cairo_set_dash(context_.get(), dashes, 2, 0.0);
  stroke(colour, width);
  cairo_set_dash(context_.get(), nullptr, 0, 0.0);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, const Colour& fill) {
  cairo_arc(context_.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  set_source(context_.get(), fill);
  cairo_fill(context_.get());
}

void Canvas::frame(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& colour) {
  cairo_rectangle(context_.get(), low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
  stroke(colour, 1.0);
}

void Canvas::text(const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour, Align align,
                  bool bold) {
  const double width = align == Align::Left ? 0.0 : text_width(text, size, bold);
  select_font(context_.get(), size, bold);
  cairo_move_to(context_.get(), at.x() - (align == Align::Middle ? 0.5 * width : width), at.y());
  cairo_text_path(context_.get(), text.c_str());
  set_source(context_.get(), {1.0, 1.0, 1.0, 0.8});
  cairo_set_line_width(context_.get(), 3.0);
  cairo_stroke_preserve(context_.get());
  set_source(context_.get(), colour);
  cairo_fill(context_.get());
}

void Canvas::upright_text(const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour) {
  cairo_save(context_.get());
  cairo_translate(context_.get(), at.x(), at.y());
  cairo_rotate(context_.get(), -0.5 * std::numbers::pi);
  this->text({0.0, 0.0}, text, size, colour, Align::Middle);
  cairo_restore(context_.get());
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
  select_font(context_.get(), size, bold);
  cairo_text_extents_t extents{};
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::image(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const GreyImage& image) {
  const std::unique_ptr<_cairo_surface, Deleter> surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return;
  const int row_bytes = cairo_image_surface_get_stride(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * row_bytes);
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t grey = image.values[static_cast<std::size_t>(y) * image.width + x];
      row[x] = grey == 255 ? 0U : 0xff000000U | grey << 16 | grey << 8 | grey;
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(context_.get());
  cairo_translate(context_.get(), low.x(), low.y());
  cairo_scale(context_.get(), (high.x() - low.x()) / image.width, (high.y() - low.y()) / image.height);
  cairo_set_source_surface(context_.get(), surface.get(), 0.0, 0.0);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
}

void Canvas::clip(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
  cairo_clip(context_.get());
}

void Canvas::unclip() { cairo_restore(context_.get()); }

tl::expected<void, std::string> Canvas::write() {
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS && !is_svg(path_)) {
    status = cairo_surface_write_to_png(surface_.get(), path_.c_str());
  }
  cairo_surface_finish(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return tl::unexpected(fmt::format("{}: cannot be drawn: {}", path_.string(), cairo_status_to_string(status)));
}

}  // namespace stairway::tools
