#include <fmt/format.h>

#include <limits>

#include "engine/bake/surface_light_bake.h"
#include "engine/base/stopwatch.h"
#include "engine/bench/make_representation.h"

namespace acentric {
namespace {

constexpr double kAnyError = 10;  ///< metres: the budget alone ends the simplification

class MeshView final : public RepresentationView {
 public:
  MeshView(const OpenProject& open, std::shared_ptr<const LocalGeometry> mesh)
      : settings_(open.project.view) {
    auto layout = std::make_shared<Layout>();
    layout->spec.nearBand = std::numeric_limits<double>::infinity();  // the sky is behind everything
    walk_.scene = open.scene, walk_.plan = open.plan, walk_.exposure = open.project.exposure;
    walk_.layout = std::move(layout);
    walk_.local = {std::move(mesh)};
    plan_.region = 0;
    settings_.renderer = Renderer::list;
    settings_.localGeometry = true, settings_.fillHoles = false;
  }
  Result<Frame> render(const PerspectiveView& view, TaskRunner& runner, FrameMemory& memory) const override {
    auto frame = renderPlan(walk_, view, settings_, plan_, runner, memory);
    if (frame)
      for (PixelSource& source : frame->source.pixels)
        if (source == kSourceBackground) source = kSourceHole;
    return frame;
  }

 private:
  WalkScene walk_;
  ViewPlan plan_;
  ViewSettings settings_;
};

/// Of all the scene's triangles.
Result<SurfaceLight> lightOf(const Workplace& at) {
  const OpenProject& open = at.open;
  const std::size_t triangles = open.scene->firstTriangles().back();
  const glm::vec3 eye(glm::dvec3(open.project.spawn().position, open.layout->eyeZ()));
  return bakeSurfaceLight(*open.rays, *open.drawn, std::vector<LightSides>(triangles, LightSides::front),
                          std::vector<glm::vec3>(triangles, eye), open.project.bake, at.runner, at.progress,
                          at.stop);
}

std::string descriptionOf(const SimplifyReport& report) {
  std::string text = fmt::format("all polygons, {} simplified to {}, at most {:.3f} m apart", report.before,
                                 report.after, report.maxError);
  if (report.loosenedFrom > 0) text += fmt::format("; below {} borders had to move", report.loosenedFrom);
  if (report.piecesLeftOut > 0)
    text += fmt::format(", and the {} smallest pieces ({} triangles) were left out", report.piecesLeftOut,
                        report.trianglesLeftOut);
  return text;
}

ConvexPolygon roundThe(const Scene& scene) {
  glm::dvec2 low(scene.bounds.min), high(scene.bounds.max);
  const glm::dvec2 room = 0.01 * (high - low) + 1e-3;
  low -= room, high += room;
  return {{low, {high.x, low.y}, high, {low.x, high.y}}};
}

ContentKey keyOf(const OpenProject& open, std::size_t mostTriangles) {
  Hasher hasher;
  hasher.text("whole mesh, to its budget").value(open.surfaceLightKey.high).value(open.surfaceLightKey.low);
  hasher.value(std::uint64_t(mostTriangles)).value(open.project.bake.surfaceTexel);
  return hasher.finish();
}

/// Without cameras; its only region draws all of the scene.
Layout everywhere(const OpenProject& open) {
  Layout layout;
  layout.spec = open.layout->spec;
  Region region;
  region.polygon = region.grown = roundThe(*open.scene);
  layout.regions = {std::move(region)};
  return layout;
}

/// A mesh of all polygons has light on each: instances have none of their own.
Status checkWithoutInstances(const Scene& scene) {
  if (scene.instances.empty()) return {};
  return fail(ErrorKind::unsupported,
              fmt::format("a mesh of all polygons cannot be made of a scene with {} instances; compare the "
                          "other representations alone (--only)",
                          scene.instances.size()),
              scene.name);
}

}  // namespace

Result<RepresentationBake> bakeOfMesh(const Workplace& at, const std::string& name,
                                      std::size_t mostTriangles) {
  if (Status whole = checkWithoutInstances(*at.open.scene); !whole) return tl::unexpected(whole.error());
  RepresentationBake bake{at.open};
  bake.open.file = at.fileOf(name);
  bake.open.layout = std::make_shared<const Layout>(everywhere(at.open));
  bake.open.keys.clear();
  bake.light = true;
  const ContentKey key = keyOf(at.open, mostTriangles);
  const auto folder = captureFolderFor(bake.open.file);
  std::error_code error;
  if (!readNote(at, name, key) || !std::filesystem::is_directory(folder, error)) return bake;
  const auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  bake.light = !store->hasSimplified(key) || !store->hasSurfaceLight(at.open.surfaceLightKey);
  return bake;
}

Result<Representation> makeMesh(const Workplace& at, const std::string& name, std::size_t mostTriangles) {
  const OpenProject& open = at.open;
  if (Status whole = checkWithoutInstances(*open.scene); !whole) return tl::unexpected(whole.error());
  const auto store = openCaptures(at.fileOf(name));
  if (!store) return tl::unexpected(store.error());
  const BakeSettings& bake = open.project.bake;
  BakeNote note{keyOf(open, mostTriangles), 0, 0};
  const ContentKey lightKey = open.surfaceLightKey;
  const auto known = readNote(at, name, note.key);
  const bool reused = known && store->hasSimplified(note.key) && store->hasSurfaceLight(lightKey);
  const ConvexPolygon whole = roundThe(*open.scene);
  if (reused) {
    note = *known;
  } else {
    const Stopwatch watch;
    const auto light = lightOf(at);
    if (!light) return tl::unexpected(light.error());
    const auto simplified = simplify(*open.scene, clipToPolygon(*open.scene, whole),
                                     {mostTriangles, kAnyError, bake.surfaceTexel, true}, at.stop);
    if (!simplified) return tl::unexpected(simplified.error());
    note.seconds = watch.seconds();
    if (Status put = store->putSurfaceLight(lightKey, *light, at.stop); !put)
      return tl::unexpected(put.error());
    if (Status put = store->putSimplified(note.key, *simplified); !put) return tl::unexpected(put.error());
    if (Status put = writeNote(at, name, note); !put) return tl::unexpected(put.error());
  }
  const auto light = store->getSurfaceLight(lightKey);
  if (!light) return tl::unexpected(light.error());
  const auto simplified = store->getSimplified(note.key);
  if (!simplified) return tl::unexpected(simplified.error());
  if (Status sound = simplified->check(*open.scene); !sound) return tl::unexpected(sound.error());
  auto mesh =
      std::make_shared<const LocalGeometry>(localGeometryOf(*simplified, *open.scene, whole, &*light));

  Representation made;
  made.name = name;
  made.description = descriptionOf(simplified->report);
  made.cost.triangles = mesh->triangles.size();
  std::uint64_t vertices = 0;
  for (const Mesh& part : mesh->meshes(*open.scene)) vertices += part.positions.size();
  made.cost.meshBytes = meshBytes(vertices, mesh->triangles.size());
  if (mesh->surfaces) made.cost.lightBytes = mesh->surfaces->light.light.size() * sizeof(HalfColour);
  made.cost.bakeSeconds = note.seconds;
  made.cost.reused = reused;
  made.view = std::make_unique<const MeshView>(open, std::move(mesh));
  return made;
}

}  // namespace acentric
