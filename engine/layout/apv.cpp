#include "engine/layout/apv.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/layout/layout.h"

namespace acentric {
namespace {

glm::dvec2 rotated(const glm::dvec2& v, double angle) {
  const glm::dvec2 along = directionOf(angle);
  return {along.x * v.x - along.y * v.y, along.y * v.x + along.x * v.y};
}

/// A traditional panorama's sectors have the directions of an APV whose d points along +x.
Cover traditionalCover(const Apv& apv) {
  const int n = apv.cameraCount();
  const double step = kTwoPi / n;
  // The viewing direction of camera 0 is d turned by +90 or -90 degrees.
  const double first = (apv.hand == Hand::counterClockwise ? kPi / 2 : -kPi / 2) - 0.5 * step;
  const auto border = [&](int i) {
    return BorderLine{apv.centre, apv.centre + directionOf(first + step * (i % n))};
  };
  Cover cover{apv.hand, {}, 0};
  for (int i = 0; i < n; ++i) cover.pieces.push_back({i, apv.centre, border(i), border(i + 1)});
  return cover;
}

}  // namespace

Status Apv::check() const {
  const auto refuse = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message), "APV");
  };
  if (!std::isfinite(centre.x + centre.y + offset.x + offset.y))
    return refuse("centre and offset must be finite");
  if (!(fovDegrees >= 1 && fovDegrees <= 120))
    return refuse(fmt::format("a field of view of {} degrees: it must lie in 1..120", fovDegrees));
  if (std::abs(fovDegrees * cameraCount() - 360) > 1e-9)
    return refuse(fmt::format("360 is no whole multiple of a field of view of {} degrees; try {}", fovDegrees,
                              360.0 / cameraCount()));
  return {};
}

int Apv::cameraCount() const { return static_cast<int>(std::lround(360 / fovDegrees)); }

int Apv::subCameras() const { return static_cast<int>(std::ceil(fovDegrees / 60 - 1e-9)); }

ConvexPolygon polygonOf(const Apv& apv) {
  ConvexPolygon polygon;
  if (apv.traditional()) return polygon;
  const int n = apv.cameraCount();
  for (int i = 0; i < n; ++i) polygon.corners.push_back(apv.centre + rotated(apv.offset, kTwoPi * i / n));
  return polygon;
}

Cover coverOf(const Apv& apv) {
  if (apv.traditional()) return traditionalCover(apv);
  const std::vector<glm::dvec2> corners = polygonOf(apv).corners;
  const std::size_t n = corners.size();
  Cover cover{apv.hand, {}, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &before = corners[(i + n - 1) % n], &here = corners[i], &behind = corners[(i + 1) % n];
    if (apv.hand == Hand::counterClockwise)  // from e[i-1] to e[i]
      cover.pieces.push_back({static_cast<int>(i), here, {before, here}, {here, behind}});
    else  // from -e[i-1] to -e[i]
      cover.pieces.push_back({static_cast<int>(i), here, {here, before}, {behind, here}});
  }
  return cover;
}

Cover captureCoverOf(const Apv& apv) {
  const Cover whole = coverOf(apv);
  const int parts = apv.subCameras();
  if (parts == 1) return whole;
  Cover cover{whole.hand, {}, 0};
  for (const Piece& piece : whole.pieces) {
    const glm::dvec2 low = piece.low.direction();
    const double step = radians(apv.fovDegrees) / parts;
    const auto border = [&](int part) {
      return BorderLine{piece.apex, piece.apex + rotated(low, part * step)};
    };
    for (int part = 0; part < parts; ++part)
      cover.pieces.push_back({piece.camera * parts + part, piece.apex, part == 0 ? piece.low : border(part),
                              part + 1 == parts ? piece.high : border(part + 1)});
  }
  return cover;
}

}  // namespace acentric
