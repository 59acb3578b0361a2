#include "engine/layout/layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.h"
#include "engine/geometry/predicates/orientation.h"
#include "engine/layout/lattice.h"
#include "engine/layout/panoramas.h"
#include "engine/layout/placement.h"
#include "engine/layout/point_inside.h"
#include "engine/layout/region_index.h"

namespace acentric {
namespace {

std::optional<Clip> clipOf(const Lattice& lattice, const ConvexPolygon& polygon, const PieceTemplate& piece) {
  if (!piece.clip) return std::nullopt;
  Clip clip{{lattice.lineOf(polygon, piece.clip->line), piece.clip->left}};
  if (piece.clip->claim)
    clip.claim = HalfPlane{lattice.lineOf(polygon, *piece.clip->claim), !piece.clip->left};
  return clip;
}

/// The role of a camera that draws this part for a region; -1 if there is none.
int findRole(const LayoutCamera& camera, const CellId& region, const std::optional<Clip>& clip) {
  const auto found =
      std::ranges::find_if(camera.roles, [&](const Role& r) { return r.region == region && r.clip == clip; });
  return found == camera.roles.end() ? -1 : int(found - camera.roles.begin());
}

/// What a region draws from a camera, each part once, whichever of its covers it belongs to.
void addRoles(const Lattice& lattice, const CellId& cell, double nearBand, LayoutCamera& camera) {
  const ConvexPolygon polygon = lattice.polygonOf(cell);
  for (const CoverTemplate& cover : lattice.coversOf(cell.slot))
    for (const PieceTemplate& piece : cover.pieces) {
      if (lattice.cameraOf(cell, piece) != camera.id) continue;
      const std::optional<Clip> clip = clipOf(lattice, polygon, piece);
      if (findRole(camera, cell, clip) < 0)
        camera.roles.push_back({cell, polygon, polygon.grown(nearBand), clip});
    }
}

double densityOf(const LayoutSpec& spec, const Lattice& lattice, CellId id) {
  for (;; id = lattice.parentOf(id)) {
    if (const auto own = spec.density.find(id); own != spec.density.end()) return own->second;
    const bool part = id.slot != kFreeSlot && id.level > 0 && id.level <= kMaxLevel;
    if (!part || !canSplit(spec.configuration)) return 1;
  }
}

/// The most of what is asked for by placed regions; 1 where it serves none, as a panorama that helps out.
double densityOf(const LayoutSpec& spec, const Lattice& lattice, const LayoutCamera& camera) {
  if (spec.density.empty()) return 1;
  double most = 0;
  for (const Role& role : camera.roles)
    if (role.region.slot == kFreeSlot || isPlaced(spec, lattice, role.region))
      most = std::max(most, densityOf(spec, lattice, role.region));
  return most > 0 ? most : 1;
}

/// The cameras of the placed lattice regions, in order of their ids.
std::vector<LayoutCamera> latticeCameras(const Lattice& lattice, const std::vector<CellId>& cells,
                                         const LayoutSpec& spec) {
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
                        lattice.cornerPosition(id.i, id.j, id.corner, id.level),
                        lattice.azimuthOf(id.direction),
                        lattice.cameraFov(),
                        {}};
    for (const CellId& cell : lattice.servedBy(id, spec.split))
      addRoles(lattice, cell, spec.nearBand, camera);
    camera.density = densityOf(spec, lattice, camera);
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

/// Lattice regions (placed or not) that come within `reach` of a point.
std::vector<Role> regionsAround(const Lattice& lattice, const glm::dvec2& point, double reach) {
  std::vector<Role> around;
  Outline box;
  box.loops = {
      {point - reach, {point.x + reach, point.y - reach}, point + reach, {point.x - reach, point.y + reach}}};
  for (const CellId& cell : cellsOverlapping(box, lattice, std::size_t(kMaxRegions))) {
    ConvexPolygon polygon = lattice.polygonOf(cell);
    if (glm::distance(polygon.nearestPoint(point), point) <= reach)
      around.push_back({cell, std::move(polygon), {}});
  }
  return around;
}

/// A free APV serves its own polygon. A free panorama has none: it helps the regions around it.
void addFreeCameras(const LayoutSpec& spec, const Lattice& lattice, std::vector<LayoutCamera>& cameras) {
  for (const auto& [number, apv] : spec.freeApvs) {
    std::vector<Role> roles;
    if (apv.traditional())
      roles = regionsAround(lattice, apv.centre, panoramaReach(spec));
    else
      roles.push_back({{number, 0, kFreeSlot}, polygonOf(apv), {}});
    for (Role& role : roles) role.grown = role.polygon.grown(spec.nearBand);
    for (const Piece& piece : captureCoverOf(apv).pieces) {
      const glm::dvec2 low = piece.low.direction();
      cameras.push_back({{number, 0, kFreeCorner, piece.camera},
                         piece.apex,
                         wrapAngle(std::atan2(low.y, low.x)),
                         radians(apv.fovDegrees) / apv.subCameras(),
                         roles});
      cameras.back().density = densityOf(spec, lattice, cameras.back());
    }
  }
}

std::optional<int> findIn(const std::vector<LayoutCamera>& cameras, const CameraId& id) {
  const auto found = std::ranges::lower_bound(cameras, id, {}, &LayoutCamera::id);
  if (found == cameras.end() || found->id != id) return std::nullopt;
  return static_cast<int>(found - cameras.begin());
}

int cameraIndex(const std::vector<LayoutCamera>& cameras, const CameraId& id) {
  const std::optional<int> index = findIn(cameras, id);
  require(index.has_value(), "every camera of a placed region was collected");
  return *index;
}

Cover makeCover(const Lattice& lattice, const CellId& id, const ConvexPolygon& polygon,
                const CoverTemplate& coverTemplate, const std::vector<LayoutCamera>& cameras) {
  Cover cover{coverTemplate.hand, {}, coverTemplate.wedges};
  cover.pieces.reserve(coverTemplate.pieces.size());
  for (const PieceTemplate& piece : coverTemplate.pieces) {
    const int camera = cameraIndex(cameras, lattice.cameraOf(id, piece));
    const std::optional<Clip> clip = clipOf(lattice, polygon, piece);
    const int role = findRole(cameras[std::size_t(camera)], id, clip);
    require(role >= 0, "a placed region has a role at each of its cameras");
    cover.pieces.push_back({camera, polygon.corners[std::size_t(piece.apex)],
                            lattice.lineOf(polygon, piece.low), lattice.lineOf(polygon, piece.high), clip,
                            role});
  }
  return cover;
}

Region makeRegion(const Lattice& lattice, const CellId& id, double nearBand,
                  const std::vector<LayoutCamera>& cameras) {
  Region region;
  region.id = id;
  region.kind = lattice.kindOf(id.slot);
  region.polygon = lattice.polygonOf(id);
  region.grown = region.polygon.grown(nearBand);
  for (const CoverTemplate& cover : lattice.coversOf(id.slot))
    region.covers.push_back(makeCover(lattice, id, region.polygon, cover, cameras));
  return region;
}

/// The cover of a free APV with its cameras' places in the layout, as a region draws it.
Cover freeCover(int number, const Apv& apv, const CellId& region, const std::vector<LayoutCamera>& cameras) {
  Cover cover = captureCoverOf(apv);
  for (Piece& piece : cover.pieces) {
    piece.camera = cameraIndex(cameras, {number, 0, kFreeCorner, piece.camera});
    piece.role = findRole(cameras[std::size_t(piece.camera)], region, std::nullopt);
  }
  return cover;
}

Region freeRegion(int number, const Apv& apv, double nearBand, const std::vector<LayoutCamera>& cameras) {
  Region region;
  region.id = {number, 0, kFreeSlot};
  region.polygon = polygonOf(apv);
  region.grown = region.polygon.grown(nearBand);
  region.covers = {freeCover(number, apv, region.id, cameras)};
  return region;
}

/// The panorama of all cameras at a corner, counter-clockwise; nothing if one of them is not placed.
std::optional<Cover> cornerPanorama(const Layout& layout, const Lattice& lattice, CameraId id) {
  Cover cover;
  for (int direction = id.direction % lattice.cameraSteps(); direction < 24;
       direction += lattice.cameraSteps()) {
    id.direction = direction;
    const std::optional<int> camera = layout.findCamera(id);
    if (!camera) return std::nullopt;
    const glm::dvec2 apex = layout.cameras[std::size_t(*camera)].position;
    const auto border = [&](int steps) {
      return BorderLine{apex, apex + layout.spec.cellSize * directionOf(lattice.azimuthOf(steps % 24))};
    };
    cover.pieces.push_back({*camera, apex, border(direction), border(direction + lattice.cameraSteps())});
  }
  return cover;
}

void addLeafCells(const Lattice& lattice, const std::set<CellId>& split, const CellId& id, std::size_t limit,
                  std::vector<LatticeCell>& cells) {
  if (cells.size() >= limit) return;
  if (!split.contains(id)) {
    cells.push_back({id, lattice.kindOf(id.slot), lattice.polygonOf(id)});
    return;
  }
  for (const CellId& child : lattice.childrenOf(id)) addLeafCells(lattice, split, child, limit, cells);
}

/// The lattice of a spec whose size is sane; plan queries are asked of specs that are being edited.
std::optional<Lattice> latticeFor(const LayoutSpec& spec) {
  if (!(std::isfinite(spec.cellSize) && spec.cellSize > 0)) return std::nullopt;
  return Lattice::of(spec);
}

}  // namespace

double nearestSample(const LayoutCamera& camera) {
  constexpr double kShareOfEdge = 2.5e-6;
  if (camera.roles.empty() || camera.roles.front().grown.size() < 3) return 0;
  const auto& corners = camera.roles.front().grown.corners;
  return kShareOfEdge * glm::distance(corners[0], corners[1]);
}

double exitDistance(const LayoutCamera& camera, const Role& role, const glm::dvec2& direction) {
  const auto span = role.grown.raySpan(camera.position, direction);
  return std::max(span ? span->second : 0, nearestSample(camera));
}

std::uint8_t roleBit(const LayoutCamera& camera, int role) {
  if (role < 0) return 0xff;
  const int count = int(camera.roles.size());
  require(role < count, "the camera has this role");
  return std::uint8_t(1u << (count <= kRoleBits ? role : role * kRoleBits / count));
}

bool HalfPlane::holds(const glm::dvec2& point) const {
  const int side = orientation(line.from, line.to, point);
  return left ? side >= 0 : side < 0;
}

bool Piece::holds(const glm::dvec2& point) const {
  return orientation(low.from, low.to, point) >= 0 && orientation(high.from, high.to, point) < 0 &&
         (!clip || clip->holds(point));
}

std::optional<int> Layout::findRegion(const CellId& id) const {
  if (index) return index->find(id);
  const auto found = std::ranges::find(regions, id, &Region::id);
  if (found == regions.end()) return std::nullopt;
  return static_cast<int>(found - regions.begin());
}

std::optional<int> Layout::findCamera(const CameraId& id) const { return findIn(cameras, id); }

std::optional<int> Layout::regionAt(const glm::dvec2& point) const {
  if (index) return index->regionAt(point);
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (regions[r].polygon.containsClosed(point)) return int(r);
  return std::nullopt;
}

std::vector<Cover> Layout::panoramasFor(int region) const {
  require(region >= 0 && std::size_t(region) < regions.size(), "the region exists");
  if (!index) return panoramas.empty() ? std::vector<Cover>{} : panoramas[std::size_t(region)];
  std::vector<Cover> covers;
  const Region& home = regions[std::size_t(region)];
  const Lattice& lattice = index->lattice();
  if (home.id.slot != kFreeSlot && lattice.panoramas()) {
    std::set<CameraId> corners;  // each once, by its first camera
    for (const Piece& piece : home.covers.front().pieces) {
      CameraId id = cameras[std::size_t(piece.camera)].id;
      id.direction %= lattice.cameraSteps();
      if (!corners.insert(id).second) continue;
      if (auto cover = cornerPanorama(*this, lattice, id)) covers.push_back(std::move(*cover));
    }
  }
  struct Free {
    double distance;
    int number;
  };
  std::vector<Free> near;
  for (const auto& [number, apv] : spec.freeApvs)
    if (apv.traditional() &&
        glm::distance(home.polygon.nearestPoint(apv.centre), apv.centre) <= panoramaReach(spec))
      near.push_back({glm::distance(home.polygon.centroid(), apv.centre), number});
  std::ranges::stable_sort(near, std::ranges::greater{}, &Free::distance);
  if (near.size() > kMostPanoramas) near.erase(near.begin(), near.end() - std::ptrdiff_t(kMostPanoramas));
  for (const Free& free : near)
    covers.push_back(freeCover(free.number, spec.freeApvs.at(free.number), home.id, cameras));
  return covers;
}

Layout::Nearest Layout::nearestRegion(const glm::dvec2& point) const {
  if (const std::optional<int> at = regionAt(point)) return {*at, point};
  Nearest nearest{-1, point};
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return nearest;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const ConvexPolygon& polygon = regions[r].polygon;
    // No corner is farther from another than the sum of the edges between them.
    const double most = double(polygon.size()) * glm::distance(polygon.corners[0], polygon.corners[1]);
    if (glm::distance(point, polygon.corners[0]) - 0.5 * most > best) continue;
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
  require(lattice.has_value(), "a checked configuration has a lattice");
  const Result<std::vector<CellId>> cells = placedCells(spec, *lattice);
  if (!cells) return tl::unexpected(cells.error());
  Layout layout;
  layout.spec = spec;
  layout.cameras = latticeCameras(*lattice, *cells, spec);
  addFreeCameras(spec, *lattice, layout.cameras);
  std::ranges::sort(layout.cameras, {}, &LayoutCamera::id);
  layout.regions.reserve(cells->size() + spec.freeApvs.size());
  for (const CellId& id : *cells)
    layout.regions.push_back(makeRegion(*lattice, id, spec.nearBand, layout.cameras));
  for (const auto& [number, apv] : spec.freeApvs)
    if (!apv.traditional()) layout.regions.push_back(freeRegion(number, apv, spec.nearBand, layout.cameras));
  layout.index = std::make_shared<const RegionIndex>(spec, *lattice, layout.regions);
  return layout;
}

LatticeCell cellAt(const LayoutSpec& spec, const glm::dvec2& point) {
  const std::optional<Lattice> lattice = latticeFor(spec);
  if (!lattice) return {};
  const CellId id = lattice->leafAt(point, spec.split);
  return {id, lattice->kindOf(id.slot), lattice->polygonOf(id)};
}

ConvexPolygon cellPolygon(const LayoutSpec& spec, const CellId& id) {
  if (id.slot == kFreeSlot) {
    const auto apv = spec.freeApvs.find(id.i);
    return apv == spec.freeApvs.end() ? ConvexPolygon{} : polygonOf(apv->second);
  }
  const std::optional<Lattice> lattice = latticeFor(spec);
  return lattice ? lattice->polygonOf(id) : ConvexPolygon{};
}

double densityOf(const LayoutSpec& spec, const CellId& id) {
  if (spec.density.empty()) return 1;  // of most layouts: no lattice need be made
  const std::optional<Lattice> lattice = latticeFor(spec);
  return lattice ? densityOf(spec, *lattice, id) : 1;
}

bool isPlaced(const LayoutSpec& spec, const CellId& id) {
  if (id.slot == kFreeSlot) return spec.freeApvs.contains(id.i);
  const std::optional<Lattice> lattice = latticeFor(spec);
  // The address may be of another configuration's lattice.
  const bool exists = lattice && id.slot >= 0 && id.slot < lattice->slots() && id.level >= 0 &&
                      id.level <= (canSplit(spec.configuration) ? kMaxLevel : 0);
  return exists && isPlaced(spec, *lattice, id);
}

std::array<CellId, 4> partsOf(const LayoutSpec& spec, const CellId& id) {
  require(canSplit(spec.configuration), "only regions of e and g have parts");
  return Lattice::of(spec)->childrenOf(id);
}

CellId wholeOf(const LayoutSpec& spec, const CellId& id) {
  require(canSplit(spec.configuration) && id.level > 0, "only parts of e and g belong to a whole");
  return Lattice::of(spec)->parentOf(id);
}

std::vector<LatticeCell> cellsIn(const LayoutSpec& spec, const glm::dvec2& min, const glm::dvec2& max,
                                 int limit) {
  const std::optional<Lattice> lattice = latticeFor(spec);
  std::vector<LatticeCell> cells;
  if (!lattice || limit <= 0 || !(min.x < max.x && min.y < max.y)) return cells;
  if (!std::isfinite(min.x + min.y + max.x + max.y)) return cells;
  const Outline box{{{min, {max.x, min.y}, max, {min.x, max.y}}}};
  for (const CellId& id : cellsOverlapping(box, *lattice, std::size_t(limit)))
    addLeafCells(*lattice, spec.split, id, std::size_t(limit), cells);
  return cells;
}

}  // namespace acentric
