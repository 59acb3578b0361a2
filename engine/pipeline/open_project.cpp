#include <fmt/format.h>

#include <algorithm>

#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/start_view.h"
#include "engine/pipeline/walk_ground.h"
#include "engine/scene/instances.h"
#include "engine/scene/local_geometry.h"

namespace acentric {
namespace {

/// With a key of its own: as meshes mirrors and lamps are such, and then are seen by all.
ScenePtr withWhole(const Scene& imported, const NearInstances& near) {
  auto scene = std::make_shared<Scene>(withPlaced(imported, near.whole));
  const ContentKey which =
      Hasher().text("near instances").array(std::span<const std::uint32_t>(near.whole)).finish();
  Hasher geometry;
  for (const ContentKey& key : {scene->parts.geometry, which}) geometry.value(key.high).value(key.low);
  scene->parts.geometry = geometry.finish();
  scene->key = keyOf(scene->parts);
  return scene;
}

/// Of the scene without those that were placed whole.
std::shared_ptr<const InstanceExcerpts> renumbered(const NearInstances& near) {
  if (near.whole.empty()) return near.excerpts;
  InstanceExcerpts excerpts = *near.excerpts;
  for (InstanceExcerpt& excerpt : excerpts)
    excerpt.instance -=
        std::uint32_t(std::ranges::lower_bound(near.whole, excerpt.instance) - near.whole.begin());
  return std::make_shared<const InstanceExcerpts>(std::move(excerpts));
}

/// Of the storey laid out alike, of the same number at best; null: none is.
std::shared_ptr<const Layout> layoutIn(const OpenProject* former, const LayoutSpec& spec,
                                       std::size_t number) {
  if (!former) return nullptr;
  const auto alike = [&](std::size_t s) {
    return s < former->layouts.size() && former->layouts[s] && former->project.storeys[s].layout == spec;
  };
  if (alike(number)) return former->layouts[number];
  for (std::size_t s = 0; s < former->layouts.size(); ++s)
    if (alike(s)) return former->layouts[s];
  return nullptr;
}

/// All storeys; fails where the current one cannot be. Others say so when they are opened.
Status layOut(const OpenProject* former, OpenProject& open) {
  const std::vector<Storey>& storeys = open.project.storeys;
  for (std::size_t s = 0; s < storeys.size(); ++s) {
    open.layouts.push_back(layoutIn(former, storeys[s].layout, s));
    if (open.layouts.back()) continue;
    auto layout = buildLayout(storeys[s].layout);
    if (layout)
      open.layouts.back() = std::make_shared<const Layout>(std::move(*layout));
    else if (int(s) == open.project.storey)
      return tl::unexpected(layout.error());
  }
  open.layout = open.layouts[std::size_t(open.project.storey)];
  open.ground = former && former->layouts == open.layouts
                    ? former->ground
                    : std::make_shared<const StoreyGround>(open.layouts);
  return {};
}

/// What is near any storey, so that all storeys share one scene.
void placeNear(const OpenProject* former, OpenProject& open) {
  const bool sameModel = former && former->imported == open.imported && former->drawn;
  const auto alike = [](const Storey& a, const Storey& b) { return a.layout == b.layout; };
  const auto& storeys = open.project.storeys;
  if (sameModel &&
      (open.imported->instances.empty() || std::ranges::equal(former->project.storeys, storeys, alike))) {
    open.near = former->near, open.scene = former->scene, open.drawn = former->drawn;
    return;
  }
  open.scene = open.imported;
  if (!open.imported->instances.empty()) {
    std::vector<Layout> layouts;
    for (const auto& layout : open.layouts)
      if (layout) layouts.push_back(*layout);  // else said when that storey is opened
    open.near = findNearInstances(*open.imported, layouts);
  }
  if (sameModel && former->near == open.near) {
    open.scene = former->scene, open.drawn = former->drawn;
    return;
  }
  if (!open.near.whole.empty() && !open.near.tooMany())
    open.scene = sameModel && former->near.whole == open.near.whole ? former->scene
                                                                    : withWhole(*open.imported, open.near);
  open.drawn = open.near.excerpts ? std::make_shared<const DrawnScene>(open.scene, renumbered(open.near))
                                  : std::make_shared<const DrawnScene>(open.scene);
}

/// `given`: instead of what the model file has.
Result<OpenProject> openWith(const OpenProject* former, const std::filesystem::path& file,
                             const Project& project, const ImportHost& host, const Progress& progress,
                             std::stop_token stop, const ScenePtr& given = nullptr) {
  if (Status sound = project.check(); !sound) return tl::unexpected(sound.error());
  OpenProject open;
  open.file = file;
  open.project = project;

  if (former && former->project.scene == project.scene && former->project.import == project.import) {
    open.imported = former->imported ? former->imported : former->scene;
  } else if (given) {
    open.imported = given;
  } else {
    auto scene = importScene(sceneFileOf(file, project), project.import, host, progress, stop);
    if (!scene) return tl::unexpected(scene.error());
    open.imported = *scene;
  }
  if (Status laid = layOut(former, open); !laid) return tl::unexpected(laid.error());
  placeNear(former, open);
  const bool sameRays = former && former->scene == open.scene && former->project.effects == project.effects;
  open.plan = sameRays ? former->plan : planEffects(*open.scene, project.effects);
  if (sameRays) {
    open.rays = former->rays;
    open.mirrors = former->mirrors;
  } else {
    if (progress) progress({0, 0, "preparing rays"});
    auto rays = RayScene::build(open.scene, open.plan);
    if (!rays) return tl::unexpected(rays.error());
    open.rays = *rays;
    open.mirrors = flatMirrorsOf(*open.scene, open.plan);
  }
  open.keys = captureKeys(*open.scene, open.plan, project.bake, *open.layout);
  open.surfaceLightKey = keyOf(surfaceLightKeyParts(open));
  return open;
}

/// Storeys that keep no start begin where those of a new project would.
Result<OpenProject> withStarts(Result<OpenProject> open) {
  if (!open) return open;
  for (std::size_t s = 0; s < open->project.storeys.size(); ++s) {
    Storey& storey = open->project.storeys[s];
    if (storey.spawn.stored) continue;
    const auto& layout = open->layouts[s];
    if (!layout || layout->regions.empty()) continue;
    storey.spawn = chooseStart(*layout, *open->rays);
    storey.spawn.stored = false;
  }
  return open;
}

/// Nothing, as far as the layout reaches.
ScenePtr emptyScene(const std::filesystem::path& model, const LayoutSpec& spec) {
  auto scene = std::make_shared<Scene>();
  scene->name = model.stem().string();
  const auto layout = buildLayout(spec);
  const auto add = [&](const glm::dvec2& place) {
    scene->bounds.add(glm::vec3(place, spec.floorHeight));
    scene->bounds.add(glm::vec3(place, spec.floorHeight + 2 * spec.eyeHeight));
  };
  add(spec.latticeOrigin);
  if (layout)
    for (const Region& region : layout->regions)
      for (const glm::dvec2& corner : region.polygon.corners) add(corner);
  scene->parts = partsOf(*scene);
  scene->key = keyOf(*scene);
  return scene;
}

}  // namespace

std::filesystem::path sceneFileOf(const std::filesystem::path& projectFile, const Project& project) {
  return (projectFile.parent_path() / project.scene).lexically_normal();
}

KeyParts captureKeyParts(const OpenProject& open, int camera) {
  const LayoutCamera& at = open.layout->cameras[std::size_t(camera)];
  return captureKeyParts(*open.scene, open.plan, open.project.bake, at,
                         columnCameraFor(at, *open.layout, open.scene->bounds, open.project.bake));
}

KeyParts surfaceLightKeyParts(const OpenProject& open) {
  const BakeSettings& bake = open.project.bake;
  Hasher settings, regions;
  settings.value(bake.ambientRays).value(bake.ambientRadius).value(bake.surfaceTexel);
  if (open.plan.on(Effect::diffuseInterreflection)) settings.value(bake.bounces);
  if (open.plan.on(Effect::softShadows)) settings.value(bake.shadowRays);
  for (const Region& region : open.layout->regions)
    regions.array(std::span<const glm::dvec2>(region.grown.corners));
  KeyParts parts = sceneKeyParts("surface light 8", *open.scene, open.plan);
  parts.push_back({"settings", settings.finish()});
  parts.push_back({"place", Hasher().value(open.layout->eyeZ()).finish()});
  parts.push_back({"regions", regions.finish()});
  // Light is numbered through what is drawn, of which there is more for each of these.
  if (open.near.any()) parts.push_back({"instances", open.near.key});
  return parts;
}

Result<OpenProject> openProject(const std::filesystem::path& file, const ImportHost& host,
                                const Progress& progress, std::stop_token stop) {
  const auto project = loadProject(file);
  if (!project) return tl::unexpected(project.error());
  return withStarts(openWith(nullptr, file, *project, host, progress, stop));
}

Result<OpenProject> openUnsaved(const std::filesystem::path& file, const Project& project,
                                const ImportHost& host, const Progress& progress, std::stop_token stop) {
  return withStarts(openWith(nullptr, file, project, host, progress, stop));
}

Result<OpenProject> reopenProject(const OpenProject& former, const Project& project, const ImportHost& host,
                                  const Progress& progress, std::stop_token stop) {
  return openWith(&former, former.file, project, host, progress, stop);
}

Result<OpenProject> openWithoutModel(const std::filesystem::path& file, const Project& project,
                                     const ImportHost& host, const Progress& progress, std::stop_token stop) {
  const std::filesystem::path model = sceneFileOf(file, project);
  ScenePtr scene = lastImported(model, project.import, host);
  if (!scene) scene = emptyScene(model, project.layout());
  return openWith(nullptr, file, project, host, progress, stop, scene);
}

}  // namespace acentric
