#include "engine/picture/cairo_canvas.h"

#include <algorithm>
#include <sstream>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Cairo's pixels: native-endian ARGB, colour multiplied by alpha.
std::uint32_t premultiplied(const Rgba8& c) {
  const auto times = [&](std::uint32_t v) { return (v * c.a + 127) / 255; };
  return (std::uint32_t(c.a) << 24) | (times(c.r) << 16) | (times(c.g) << 8) | times(c.b);
}

}  // namespace

ColourImage pixelsOf(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  ColourImage image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const unsigned char* const bytes = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y) {
    const auto* const row = reinterpret_cast<const std::uint32_t*>(bytes + std::ptrdiff_t(y) * stride);
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = {std::uint8_t(row[x] >> 16), std::uint8_t(row[x] >> 8), std::uint8_t(row[x]), 255};
  }
  return image;
}

CairoCanvas::CairoCanvas(cairo_surface_t* surface, double scale)
    : context_(cairo_create(surface), &cairo_destroy) {
  cairo_scale(context_.get(), scale, scale);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

void CairoCanvas::setColour(const Rgba8& c, double opacity) {
  cairo_set_source_rgba(context_.get(), c.r / 255.0, c.g / 255.0, c.b / 255.0, opacity * c.a / 255.0);
}

void CairoCanvas::fillRectangle(const glm::dvec2& min, const glm::dvec2& max, const Rgba8& colour) {
  setColour(colour);
  cairo_rectangle(context_.get(), min.x, min.y, max.x - min.x, max.y - min.y);
  cairo_fill(context_.get());
}

void CairoCanvas::strokeRectangle(const glm::dvec2& min, const glm::dvec2& max, const Rgba8& colour,
                                  double width) {
  cairo_rectangle(context_.get(), min.x, min.y, max.x - min.x, max.y - min.y);
  strokePath(colour, width, false);
}

void CairoCanvas::path(const std::vector<glm::dvec2>& points, bool closed) {
  for (std::size_t i = 0; i < points.size(); ++i)
    (i == 0 ? cairo_move_to : cairo_line_to)(context_.get(), points[i].x, points[i].y);
  if (closed && !points.empty()) cairo_close_path(context_.get());
}

void CairoCanvas::fillPath(const Rgba8& colour) {
  setColour(colour);
  cairo_fill_preserve(context_.get());
}

void CairoCanvas::strokePath(const Rgba8& colour, double width, bool dashed) {
  setColour(colour);
  cairo_set_line_width(context_.get(), width);
  const double dashes[2]{4 * width, 3 * width};
  cairo_set_dash(context_.get(), dashes, dashed ? 2 : 0, 0);
  cairo_stroke(context_.get());
}

void CairoCanvas::wedge(const glm::dvec2& centre, double radius, double fromAngle, double toAngle) {
  cairo_move_to(context_.get(), centre.x, centre.y);
  cairo_arc(context_.get(), centre.x, centre.y, radius, fromAngle, toAngle);
  cairo_close_path(context_.get());
}

void CairoCanvas::circle(const glm::dvec2& centre, double radius) {
  cairo_new_sub_path(context_.get());
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0, kTwoPi);
  cairo_close_path(context_.get());
}

void CairoCanvas::image(const ColourImage& image, const glm::dvec2& min, const glm::dvec2& max,
                        double opacity, bool smooth) {
  // SVG viewers blend pixels whatever we ask for, so squares are made of several pixels each.
  const int repeat = smooth ? 1 : std::clamp(1600 / std::max(image.width, image.height), 1, 16);
  const SurfacePtr surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, repeat * image.width, repeat * image.height),
      &cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS) {
    unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < repeat * image.height; ++y) {
      auto* const row = reinterpret_cast<std::uint32_t*>(bytes + std::ptrdiff_t(y) * stride);
      for (int x = 0; x < repeat * image.width; ++x) row[x] = premultiplied(image.at(x / repeat, y / repeat));
    }
    cairo_surface_mark_dirty(surface.get());
  }
  cairo_save(context_.get());
  cairo_translate(context_.get(), min.x, min.y);
  cairo_scale(context_.get(), (max.x - min.x) / (repeat * image.width),
              (max.y - min.y) / (repeat * image.height));
  cairo_set_source_surface(context_.get(), surface.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_.get()),
                           smooth ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_paint_with_alpha(context_.get(), opacity);
  cairo_restore(context_.get());
}

void CairoCanvas::clipTo(const glm::dvec2& min, const glm::dvec2& max) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), min.x, min.y, max.x - min.x, max.y - min.y);
  cairo_clip(context_.get());
}

void CairoCanvas::setFont(double size, bool bold) {
  cairo_select_font_face(context_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), size);
}

std::string CairoCanvas::sound(const std::string& text) {
  cairo_glyph_t* glyphs = nullptr;
  int count = 0;
  const cairo_status_t status =
      cairo_scaled_font_text_to_glyphs(cairo_get_scaled_font(context_.get()), 0, 0, text.data(),
                                       int(text.size()), &glyphs, &count, nullptr, nullptr, nullptr);
  cairo_glyph_free(glyphs);
  std::string out = text;
  if (status == CAIRO_STATUS_INVALID_STRING)
    std::ranges::replace_if(
        out, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');
  return out;
}

double CairoCanvas::textWidth(const std::string& text, double size, bool bold) {
  setFont(size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), sound(text).c_str(), &extents);
  return extents.x_advance;
}

void CairoCanvas::text(const std::string& text, const glm::dvec2& at, double size, const Rgba8& colour,
                       Align align, bool bold) {
  const double width = align == Align::left ? 0 : textWidth(text, size, bold);
  setFont(size, bold);
  setColour(colour);
  cairo_move_to(context_.get(), at.x - (align == Align::middle ? width / 2 : width), at.y);
  cairo_show_text(context_.get(), sound(text).c_str());
  endPath();
}

void CairoCanvas::haloText(const std::string& words, const glm::dvec2& at, double size, const Rgba8& colour,
                           Align align) {
  const double width = align == Align::left ? 0 : textWidth(words, size);
  setFont(size, false);
  cairo_move_to(context_.get(), at.x - (align == Align::middle ? width / 2 : width), at.y);
  cairo_text_path(context_.get(), sound(words).c_str());
  strokePath({255, 255, 255, 220}, 0.28 * size, false);
  text(words, at, size, colour, align);
}

std::vector<std::string> CairoCanvas::wrap(const std::string& text, double size, double width, bool bold) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty() && textWidth(lines.back() + " " + word, size, bold) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

Status CairoCanvas::status() const {
  const cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return fail(status == CAIRO_STATUS_NO_MEMORY ? ErrorKind::outOfSpace : ErrorKind::internal,
              std::string("the picture could not be drawn: ") + cairo_status_to_string(status));
}

}  // namespace acentric
