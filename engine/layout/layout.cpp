#include "engine/layout/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/layout/lattice.h"
#include "engine/layout/placement.h"
#include "engine/layout/point_inside.h"

namespace acentric {
namespace {

/// The cameras that the placed regions need, in order of their ids.
std::vector<LayoutCamera> collectCameras(const Lattice& lattice, const std::vector<CellId>& cells,
                                         double nearBand) {
  std::vector<CameraId> ids;
  for (const CellId& cell : cells)
    for (const CoverTemplate& cover : lattice.coversOf(cell.slot))
      for (const PieceTemplate& piece : cover.pieces) ids.push_back(lattice.cameraOf(cell, piece));
  std::ranges::sort(ids);
  const auto repeats = std::ranges::unique(ids);
  ids.erase(repeats.begin(), repeats.end());

  std::vector<LayoutCamera> cameras;
  cameras.reserve(ids.size());
  for (const CameraId& id : ids) {
    LayoutCamera camera{id,
                        lattice.cornerPosition(id.i, id.j, id.corner),
                        lattice.azimuthOf(id.direction),
                        lattice.cameraFov(),
                        {}};
    for (const CellId& cell : lattice.servedBy(id))
      camera.served.push_back(lattice.polygonOf(cell).grown(nearBand));
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

int cameraIndex(const std::vector<LayoutCamera>& cameras, const CameraId& id) {
  const auto found = std::ranges::lower_bound(cameras, id, {}, &LayoutCamera::id);
  require(found != cameras.end() && found->id == id, "every camera of a placed region was collected");
  return static_cast<int>(found - cameras.begin());
}

Region makeRegion(const Lattice& lattice, const CellId& id, double nearBand,
                  const std::vector<LayoutCamera>& cameras) {
  Region region;
  region.id = id;
  region.kind = lattice.kindOf(id.slot);
  region.polygon = lattice.polygonOf(id);
  region.grown = region.polygon.grown(nearBand);
  for (const CoverTemplate& coverTemplate : lattice.coversOf(id.slot)) {
    Cover cover{coverTemplate.hand, {}, coverTemplate.wedges};
    cover.pieces.reserve(coverTemplate.pieces.size());
    for (const PieceTemplate& piece : coverTemplate.pieces)
      cover.pieces.push_back(
          {cameraIndex(cameras, lattice.cameraOf(id, piece)), region.polygon.corners[std::size_t(piece.apex)],
           lattice.lineOf(region.polygon, piece.low), lattice.lineOf(region.polygon, piece.high)});
    region.covers.push_back(std::move(cover));
  }
  return region;
}

/// The lattice of a spec whose size is sane; plan queries are asked of specs that are being edited.
std::optional<Lattice> latticeFor(const LayoutSpec& spec) {
  if (!(std::isfinite(spec.cellSize) && spec.cellSize > 0)) return std::nullopt;
  return Lattice::of(spec);
}

}  // namespace

bool Piece::holds(const glm::dvec2& point) const {
  return orientation(low.from, low.to, point) >= 0 && orientation(high.from, high.to, point) < 0;
}

std::optional<int> Layout::findRegion(const CellId& id) const {
  const auto found = std::ranges::lower_bound(regions, id, {}, &Region::id);
  if (found == regions.end() || found->id != id) return std::nullopt;
  return static_cast<int>(found - regions.begin());
}

std::optional<int> Layout::regionAt(const glm::dvec2& point) const {
  const std::optional<Lattice> lattice = latticeFor(spec);
  if (!lattice || !std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
  const std::optional<int> index = findRegion(lattice->cellAt(point));
  if (!index || !regions[std::size_t(*index)].polygon.contains(point)) return std::nullopt;
  return index;
}

Layout::Nearest Layout::nearestRegion(const glm::dvec2& point) const {
  if (const std::optional<int> at = regionAt(point)) return {*at, point};
  Nearest nearest{-1, point};
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return nearest;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const ConvexPolygon& polygon = regions[r].polygon;
    if (glm::distance(point, polygon.corners[0]) - 2.5 * spec.cellSize > best)
      continue;  // wider than any region
    const double distance = glm::distance(point, polygon.nearestPoint(point));
    if (distance < best) best = distance, nearest.region = static_cast<int>(r);
  }
  if (nearest.region >= 0) {
    const ConvexPolygon& polygon = regions[std::size_t(nearest.region)].polygon;
    nearest.point = pointInside(polygon, point, [&](const glm::dvec2& p) { return polygon.contains(p); });
  }
  return nearest;
}

Result<Layout> buildLayout(const LayoutSpec& spec) {
  if (Status status = spec.check(); !status) return tl::unexpected(status.error());
  const std::optional<Lattice> lattice = Lattice::of(spec);
  if (!lattice)
    return fail(ErrorKind::unsupported,
                fmt::format("configuration {} ({}) cannot be laid out yet; choose b or e",
                            nameOf(spec.configuration), describe(spec.configuration)),
                "layout");
  const Result<std::vector<CellId>> cells = placedCells(spec, *lattice);
  if (!cells) return tl::unexpected(cells.error());
  Layout layout;
  layout.spec = spec;
  layout.cameras = collectCameras(*lattice, *cells, spec.nearBand);
  layout.regions.reserve(cells->size());
  for (const CellId& id : *cells)
    layout.regions.push_back(makeRegion(*lattice, id, spec.nearBand, layout.cameras));
  return layout;
}

LatticeCell cellAt(const LayoutSpec& spec, const glm::dvec2& point) {
  const std::optional<Lattice> lattice = latticeFor(spec);
  if (!lattice) return {};
  const CellId id = lattice->cellAt(point);
  return {id, lattice->kindOf(id.slot), lattice->polygonOf(id)};
}

ConvexPolygon cellPolygon(const LayoutSpec& spec, const CellId& id) {
  const std::optional<Lattice> lattice = latticeFor(spec);
  return lattice ? lattice->polygonOf(id) : ConvexPolygon{};
}

std::vector<LatticeCell> cellsIn(const LayoutSpec& spec, const glm::dvec2& min, const glm::dvec2& max,
                                 int limit) {
  const std::optional<Lattice> lattice = latticeFor(spec);
  std::vector<LatticeCell> cells;
  if (!lattice || limit <= 0 || !(min.x < max.x && min.y < max.y)) return cells;
  if (!std::isfinite(min.x + min.y + max.x + max.y)) return cells;
  const Outline box{{{min, {max.x, min.y}, max, {min.x, max.y}}}};
  for (const CellId& id : cellsOverlapping(box, *lattice, std::size_t(limit)))
    if (cells.size() < std::size_t(limit))
      cells.push_back({id, lattice->kindOf(id.slot), lattice->polygonOf(id)});
  return cells;
}

}  // namespace acentric
