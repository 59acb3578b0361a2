#include "editor/overlays/scene_layers.h"

#include <algorithm>
#include <cmath>

#include "editor/overlays/bake_signs.h"
#include "editor/tools/scene_hits.h"
#include "engine/bake/bake.h"
#include "ui/colour.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr float kHidden = 0.16F;      ///< opacity of what lies behind surfaces
constexpr double kFrustum = 0.42;     ///< length of the sectors' frusta, in cells
constexpr double kSteepest = 0.7;     ///< elevation that a frustum is drawn with, radians
constexpr double kArcRadians = 0.18;  ///< of a step along a frustum's far side
constexpr double kWalkCone = 0.8;     ///< length of the eye's view, in cells

ui::Colour stateOf(const SceneContents& contents, std::size_t region) {
  const bool known = contents.captures && region < contents.captures->regions.size();
  return colourOf(known ? contents.captures->regions[region] : BakeState::missing);
}

ui::Colour cameraState(const SceneContents& contents, int camera) {
  const auto c = std::size_t(camera);
  const bool baked =
      contents.captures && c < contents.captures->cameras.size() && contents.captures->cameras[c];
  return colourOf(baked ? BakeState::baked : BakeState::missing);
}

/// Appends to shapes. Heights are those of one layout.
class Drawing {
 public:
  Drawing(const OpenProject& open, ui::SpaceShapes& shapes)
      : open_(open), layout_(*open.layout), shapes_(shapes), floor_(latticeHeight(layout_)) {}

  void polygon(const ConvexPolygon& polygon, const ui::Colour& inside, const ui::Colour& border,
               float pixels) {
    fill(polygon, inside);
    loop(polygon.corners, border, pixels);
  }
  void fill(const ConvexPolygon& polygon, const ui::Colour& colour) {
    const auto& corners = polygon.corners;
    for (std::size_t k = 2; k < corners.size(); ++k)
      shapes_.faces.push_back(
          {{onFloor(corners[0]), onFloor(corners[k - 1]), onFloor(corners[k])}, colour.packed()});
  }
  void loop(const std::vector<glm::dvec2>& corners, const ui::Colour& colour, float pixels) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      line(onFloor(corners[k]), onFloor(corners[(k + 1) % corners.size()]), colour, pixels);
  }
  void line(const glm::dvec3& from, const glm::dvec3& to, const ui::Colour& colour, float pixels) {
    shapes_.lines.push_back({from, to, colour.packed(), pixels});
  }
  void dot(const glm::dvec3& at, const ui::Colour& colour, float pixels) {
    line(at, at, palette::backdrop.withOpacity(0.85F), pixels + 2.5F);
    line(at, at, colour, pixels);
  }
  /// What a camera's sector holds, up to a length.
  void frustum(int camera, double length, const ui::Colour& colour, float pixels) {
    const LayoutCamera& of = layout_.cameras[std::size_t(camera)];
    const ColumnCamera columns = columnCameraFor(of, layout_, open_.scene->bounds, open_.project.bake);
    const glm::dvec3 apex = columns.centreOfProjection;
    const double top = std::min(columns.topElevation, kSteepest);
    const double bottom = std::max(columns.bottomElevation, -kSteepest);
    const int steps = std::max(1, int(std::ceil(of.fovRadians / kArcRadians)));
    const auto corner = [&](int step, double elevation) {
      const glm::dvec2 way = directionOf(of.lowAzimuth + of.fovRadians * step / steps);
      return apex + length * glm::dvec3(way, std::tan(elevation));
    };
    for (const int side : {0, steps}) {
      line(apex, corner(side, top), colour, pixels);
      line(apex, corner(side, bottom), colour, pixels);
      line(corner(side, bottom), corner(side, top), colour, pixels);
    }
    for (int step = 0; step < steps; ++step)
      for (const double elevation : {top, bottom})
        line(corner(step, elevation), corner(step + 1, elevation), colour, pixels);
  }
  glm::dvec3 onFloor(const glm::dvec2& place) const { return {place, floor_}; }
  glm::dvec3 atEye(const glm::dvec2& place) const { return {place, layout_.eyeZ()}; }

 private:
  const OpenProject& open_;
  const Layout& layout_;
  ui::SpaceShapes& shapes_;
  double floor_;
};

void addCells(Drawing& drawing, const SceneContents& contents) {
  const std::vector<Region>& regions = contents.open->layout->regions;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    const bool ring = region.kind == RegionKind::ring;
    drawing.fill(region.polygon, stateOf(contents, r).withOpacity(ring ? 0.30F : 0.05F));
    drawing.loop(region.polygon.corners, palette::backdrop.withOpacity(0.45F), ring ? 3.4F : 2.2F);
  }
  // Over all their dark rims: what sets them off from a bright floor.
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const bool ring = regions[r].kind == RegionKind::ring;
    drawing.loop(regions[r].polygon.corners, stateOf(contents, r).withOpacity(ring ? 0.95F : 0.7F),
                 ring ? 1.8F : 1.0F);
  }
  for (const auto& loop : contents.open->layout->spec.outline.loops)
    drawing.loop(loop, palette::text.withOpacity(0.75F), 1.8F);
  for (const CellId& cell : contents.selection)
    if (const auto region = contents.open->layout->findRegion(cell))
      drawing.polygon(regions[std::size_t(*region)].polygon, palette::accent.withOpacity(0.28F),
                      palette::accent, 2.6F);
}

/// A dot and a stalk for all cameras at one centre of projection: they follow one another.
void addCameraDots(Drawing& drawing, const SceneContents& contents) {
  const std::vector<LayoutCamera>& cameras = contents.open->layout->cameras;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (c > 0 && cameras[c].position == cameras[c - 1].position) continue;
    const glm::dvec2& place = cameras[c].position;
    const ui::Colour colour = cameraState(contents, int(c));
    drawing.line(drawing.onFloor(place), drawing.atEye(place), colour.withOpacity(0.3F), 1.0F);
    drawing.dot(drawing.atEye(place), colour, 6.0F);
  }
}

std::set<int> camerasOf(const Layout& layout, const std::set<CellId>& cells) {
  std::set<int> cameras;
  for (const CellId& cell : cells)
    if (const auto region = layout.findRegion(cell))
      for (const Cover& cover : layout.regions[std::size_t(*region)].covers)
        for (const Piece& piece : cover.pieces) cameras.insert(piece.camera);
  return cameras;
}

void addFrusta(Drawing& drawing, const SceneContents& contents) {
  const Layout& layout = *contents.open->layout;
  const double length = kFrustum * layout.spec.cellSize;
  const auto add = [&](int camera) {
    drawing.frustum(camera, length, cameraState(contents, camera).withOpacity(0.8F), 1.1F);
  };
  if (contents.allFrusta)
    for (std::size_t c = 0; c < layout.cameras.size(); ++c) add(int(c));
  else
    for (const int camera : camerasOf(layout, contents.selection)) add(camera);
}

void addWalk(Drawing& drawing, const ScenePassing& passing, double length) {
  const WalkPose& pose = passing.walk;
  PerspectiveView view;
  view.eye = pose.eye, view.yawRadians = pose.yawRadians, view.pitchRadians = pose.pitchRadians;
  const glm::dmat3 worldFromView = glm::transpose(view.viewFromWorld());
  const double across = std::tan(0.5 * passing.walkFovRadians), down = across * passing.walkAspect;
  std::array<glm::dvec3, 4> far;
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::dvec3 inView((k == 1 || k == 2) ? across : -across, k >= 2 ? down : -down, 1);
    far[k] = pose.eye + length * (worldFromView * inView);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    drawing.line(pose.eye, far[k], palette::accent, 1.6F);
    drawing.line(far[k], far[(k + 1) % 4], palette::accent, 1.6F);
  }
  drawing.line(drawing.onFloor(glm::dvec2(pose.eye)), pose.eye, palette::accent.withOpacity(0.6F), 1.4F);
  drawing.dot(pose.eye, palette::accent, 11);
  drawing.line(pose.eye, pose.eye, palette::text, 4);
}

void addPick(Drawing& drawing, const Layout& layout, const ScenePassing& passing) {
  const SurfacePoint& point = *passing.picked;
  if (passing.pick)
    for (const CameraSampling& camera : passing.pick->sampling.cameras) {
      if (!camera.held) continue;
      const glm::dvec3 from = drawing.atEye(layout.cameras[std::size_t(camera.camera)].position);
      const ui::Colour colour = camera.hidden ? palette::warning : ui::Colour::hex(0x7fe3ff);
      drawing.line(from, point.position, colour.withOpacity(0.75F), 1.3F);
      drawing.dot(from, colour, 9);
    }
  drawing.dot(point.position, palette::text, 9);
}

}  // namespace

void SceneLayers::update(const SceneContents& contents) {
  if (contents == shown_) return;
  shown_ = contents;
  ui::SpaceShapes shapes;
  Drawing drawing(*contents.open, shapes);
  addCells(drawing, contents);
  addFrusta(drawing, contents);
  if (contents.cameras) addCameraDots(drawing, contents);
  const Layout& layout = *contents.open->layout;
  const glm::dvec2 origin =
      layout.regions.empty() ? layout.spec.latticeOrigin : layout.regions.front().polygon.centroid();
  mesh_.setLasting(shapes, drawing.onFloor(origin));
}

void SceneLayers::updatePassing(const ScenePassing& passing) {
  ui::SpaceShapes shapes;
  const Layout& layout = *shown_.open->layout;
  Drawing drawing(*shown_.open, shapes);
  if (passing.hovered)
    if (const auto region = layout.findRegion(*passing.hovered))
      drawing.polygon(layout.regions[std::size_t(*region)].polygon, palette::text.withOpacity(0.16F),
                      palette::text.withOpacity(0.7F), 1.6F);
  addWalk(drawing, passing, kWalkCone * layout.spec.cellSize);
  if (passing.camera) {
    drawing.frustum(*passing.camera, 2 * kFrustum * layout.spec.cellSize, palette::warning, 2.0F);
    drawing.dot(drawing.atEye(layout.cameras[std::size_t(*passing.camera)].position), palette::warning, 9);
  }
  if (passing.picked) addPick(drawing, layout, passing);
  mesh_.setPassing(shapes);
}

void SceneLayers::draw(ImDrawList& list, const PerspectiveView& view, const glm::dvec2& areaMin,
                       const glm::dvec2& areaSize) {
  const double focal = view.focalPixels();
  mesh_.draw(list,
             {view.eye,
              view.viewFromWorld(),
              {0.5 * view.width / focal, 0.5 * view.height / focal},
              areaMin,
              areaSize},
             kHidden);
}

}  // namespace acentric::editor
