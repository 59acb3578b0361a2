#include "engine/picture/drawing.h"

#include <cairo-svg.h>

#include <cmath>
#include <new>
#include <span>
#include <vector>

#include "engine/base/file.h"
#include "engine/picture/cairo_canvas.h"

namespace acentric {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) noexcept try {
  const auto part = std::as_bytes(std::span(data, length));
  auto* const all = static_cast<std::vector<std::byte>*>(bytes);
  all->insert(all->end(), part.begin(), part.end());
  return CAIRO_STATUS_SUCCESS;
} catch (const std::bad_alloc&) {
  return CAIRO_STATUS_NO_MEMORY;
}

SurfacePtr pixelSurface(const Drawing& drawing) {
  return {cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(drawing.width)),
                                     static_cast<int>(std::ceil(drawing.height))),
          &cairo_surface_destroy};
}

bool isSvg(const std::filesystem::path& path) { return path.extension() == ".svg"; }

}  // namespace

Status checkDrawingPath(const std::filesystem::path& path) {
  if (isSvg(path) || path.extension() == ".png") return {};
  return fail(ErrorKind::invalidArgument, "drawings are .svg or .png: choose one of these endings",
              path.string());
}

Status writeDrawing(const Drawing& drawing, const std::filesystem::path& path) {
  if (Status possible = checkDrawingPath(path); !possible) return possible;
  std::vector<std::byte> bytes;
  const SurfacePtr surface =
      isSvg(path)
          ? SurfacePtr(cairo_svg_surface_create_for_stream(&append, &bytes, drawing.width, drawing.height),
                       &cairo_surface_destroy)
          : pixelSurface(drawing);
  if (isSvg(path)) cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  if (Status drawn = drawing.draw(surface.get()); !drawn)
    return fail(drawn.error().kind, drawn.error().message, path.string());
  if (!isSvg(path)) cairo_surface_write_to_png_stream(surface.get(), &append, &bytes);
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS || bytes.empty())
    return fail(ErrorKind::outOfSpace, "there is not enough memory for the picture", path.string());
  return writeFileAtomically(path, bytes);
}

Result<ColourImage> pixelsOf(const Drawing& drawing) {
  const SurfacePtr surface = pixelSurface(drawing);
  if (Status drawn = drawing.draw(surface.get()); !drawn) return tl::unexpected(drawn.error());
  return pixelsOf(surface.get());
}

}  // namespace acentric
