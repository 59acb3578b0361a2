#include "engine/picture/captioned_pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/base/contract.h"
#include "engine/picture/cairo_canvas.h"
#include "engine/picture/drawing.h"
#include "engine/picture/plan_picture.h"

namespace acentric {
namespace {

constexpr double kText = 12, kHeading = 13, kTitle = 16, kLine = 17, kMargin = 10, kGap = 6, kSwatch = 14;
constexpr int kMostPixels = 16384;  ///< of a side
constexpr Rgba8 kPaper{255, 255, 255, 255};

/// Draws on white paper of a size in pixels.
Result<ColourImage> draw(double width, double height, const std::function<void(CairoCanvas&)>& strokes) {
  const int w = int(std::ceil(width)), h = int(std::ceil(height));
  if (w < 1 || h < 1 || w > kMostPixels || h > kMostPixels)
    return fail(ErrorKind::invalidArgument,
                "a sheet of pictures would be larger than 16384 pixels: choose fewer or smaller ones",
                "picture");
  return pixelsOf({double(w), double(h), [&](cairo_surface_t* surface) {
                     CairoCanvas canvas(surface, 1);
                     canvas.fillRectangle({0, 0}, {w, h}, kPaper);
                     strokes(canvas);
                     return canvas.status();
                   }});
}

/// For measuring text before there is paper.
class Ruler {
 public:
  double widthOf(const std::string& text, double size, bool bold = false) {
    return text.empty() ? 0 : canvas_.textWidth(text, size, bold);
  }
  CairoCanvas& canvas() { return canvas_; }

 private:
  SurfacePtr surface_{cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1), &cairo_surface_destroy};
  CairoCanvas canvas_{surface_.get(), 1};
};

}  // namespace

Result<ColourImage> withLegend(const ColourImage& picture, std::span<const LegendLine> lines) {
  if (lines.empty()) return picture;
  Ruler ruler;
  const double width = picture.width;
  std::vector<glm::dvec2> places;
  glm::dvec2 at(kMargin, picture.height + kMargin);
  for (const LegendLine& line : lines) {
    const double needed = kSwatch + kGap + ruler.widthOf(line.text, kText);
    if (at.x > kMargin && at.x + needed > width - kMargin) at = {kMargin, at.y + kLine + 2};
    places.push_back(at);
    at.x += needed + 2 * kMargin;
  }
  return draw(width, at.y + kLine + kMargin - 2, [&](CairoCanvas& canvas) {
    canvas.image(picture, {0, 0}, {width, picture.height}, 1, true);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const glm::dvec2 low = places[i], high = low + kSwatch;
      canvas.image(lines[i].swatch, low, high, 1, false);
      canvas.strokeRectangle(low, high, kFaintColour, 0.8);
      canvas.text(lines[i].text, {high.x + kGap, high.y - 3}, kText, kInkColour);
    }
  });
}

Result<ColourImage> drawSheet(const Sheet& sheet) {
  require(!sheet.rows.empty() && !sheet.rows.front().pictures.empty(), "a sheet has pictures");
  const ColourImage& first = sheet.rows.front().pictures.front().picture;
  const double scale = sheet.pictureWidth > 0 ? double(sheet.pictureWidth) / first.width : 1;
  const glm::dvec2 size = glm::round(scale * glm::dvec2(first.width, first.height));

  Ruler ruler;
  std::size_t columns = sheet.headings.size();
  double labels = 0;
  bool captions = false;
  for (const SheetRow& row : sheet.rows) {
    columns = std::max(columns, row.pictures.size());
    labels = std::max(labels, ruler.widthOf(row.label, kText, true));
    for (const SheetPicture& p : row.pictures) captions = captions || !p.caption.empty();
  }
  const double left = kMargin + (labels > 0 ? labels + kGap : 0);
  const double rowHeight = size.y + (captions ? kLine : 0) + kGap;
  const double titleHeight = sheet.title.empty() ? 0 : kTitle + kMargin;
  const double top = kMargin + titleHeight + (sheet.headings.empty() ? 0 : kLine);
  const double width = left + double(columns) * (size.x + kGap) - kGap + kMargin;
  const double below = top + double(sheet.rows.size()) * rowHeight;
  std::vector<std::string> notes;
  for (const std::string& note : sheet.notes)
    for (std::string& line : ruler.canvas().wrap(note, kText, width - 2 * kMargin))
      notes.push_back(std::move(line));

  return draw(width, below + double(notes.size()) * kLine + kMargin, [&](CairoCanvas& canvas) {
    if (!sheet.title.empty())
      canvas.text(sheet.title, {kMargin, kMargin + kTitle - 2}, kTitle, kInkColour, Align::left, true);
    const auto columnAt = [&](std::size_t c) { return left + double(c) * (size.x + kGap); };
    for (std::size_t c = 0; c < sheet.headings.size(); ++c)
      canvas.text(sheet.headings[c], {columnAt(c) + size.x / 2, top - kGap + 1}, kHeading, kInkColour,
                  Align::middle, true);
    for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
      const SheetRow& row = sheet.rows[r];
      const double y = top + double(r) * rowHeight;
      canvas.text(row.label, {kMargin, y + kText}, kText, kInkColour, Align::left, true);
      for (std::size_t c = 0; c < row.pictures.size(); ++c) {
        const glm::dvec2 low(columnAt(c), y);
        canvas.image(row.pictures[c].picture, low, low + size, 1, scale != 1);
        canvas.text(row.pictures[c].caption, {low.x + size.x / 2, y + size.y + kLine - 4}, kText, kInkColour,
                    Align::middle);
      }
    }
    for (std::size_t n = 0; n < notes.size(); ++n)
      canvas.text(notes[n], {kMargin, below + kLine * double(n) + kText}, kText, kInkColour);
  });
}

}  // namespace acentric
