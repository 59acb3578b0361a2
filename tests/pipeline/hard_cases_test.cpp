/// One project at scale 0.001, 1 and 10,000, and 5000 km out: from the numbers of a model file over import,
/// layout and bake to frames of the list renderer. Beside it the naive variant, positions in world-space
/// floats, which must fail.

#include <gtest/gtest.h>

#include "engine/bake/bake.h"
#include "engine/bake/surface_light_bake.h"
#include "engine/pipeline/local_triangles.h"
#include "engine/scene/finish_scene.h"
#include "engine/view/render.h"
#include "tests/bake/memory_sink.h"

namespace acentric {
namespace {

/// Metres to a unit of the model, and where the model lies, metres.
struct Place {
  double scale = 1;
  glm::dvec3 move{0};
};

void addQuad(SourceMesh& mesh, const std::array<glm::dvec3, 4>& corners) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int k = 0; k < 4; ++k) {
    mesh.positions.push_back(corners[std::size_t(k)]);
    mesh.colours.emplace_back(60 + 50 * k, 220 - 60 * k, 90 + 40 * ((k + 1) % 3), 255);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// Six sides, outwards or inwards.
void addBox(SourceMesh& mesh, const glm::dvec3& low, const glm::dvec3& high, bool inwards) {
  const auto corner = [&](int i) {
    return glm::dvec3((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
  };
  constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {3, 2, 6, 7}, {2, 0, 4, 6}, {1, 3, 7, 5}};
  for (const auto& s : kSides)
    if (inwards)
      addQuad(mesh, {corner(s[3]), corner(s[2]), corner(s[1]), corner(s[0])});
    else
      addQuad(mesh, {corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3])});
}

/// A room with a table, a shelf at a wall, a pillar and a lamp, in the file's units.
SourceScene roomOf(const Place& place) {
  SourceScene source;
  source.metresPerUnit = place.scale;
  source.unitSource = "test";
  source.up = UpAxis::z;
  Material matte;
  matte.metallic = 0;
  source.materials.push_back(matte);
  SourceMesh& mesh = source.meshes.emplace_back();
  addBox(mesh, {-3, -2.5, 0}, {4, 3, 2.8}, true);
  addBox(mesh, {0.4, 1.4, 0}, {1.6, 2.1, 0.75}, false);
  addBox(mesh, {3.5, -2, 0.4}, {4, 1, 2}, false);
  addBox(mesh, {-2.4, -1.9, 0}, {-2, -1.5, 2.8}, false);
  addBox(mesh, {0.9, 0.15, 1.3}, {0.95, 0.2, 1.7}, false);  // a rod, a hand's breadth from an eye
  const glm::dvec3 offset = place.move / place.scale;
  for (glm::dvec3& p : mesh.positions) p += offset;
  SourceLight lamp;
  lamp.light.kind = LightKind::point;
  lamp.light.intensity = 40;
  lamp.position = glm::dvec3(0.5, 0.3, 2.5) + offset;
  source.lights.push_back(lamp);
  return source;
}

/// What the designer chose, all lengths scaled, baked and ready to walk through.
struct Walk {
  WalkScene scene;
  double scale = 1;
  glm::dvec3 move{0};  ///< of the project's coordinates

  PerspectiveView view(const glm::dvec2& eye, double yaw, double pitch, double fov = 75) const {
    PerspectiveView v;
    v.eye = glm::dvec3(scale * eye + glm::dvec2(move), scene.layout->eyeZ());
    v.yawRadians = radians(yaw), v.pitchRadians = radians(pitch), v.fovRadians = radians(fov);
    v.width = 240, v.height = 160;
    return v;
  }
  Frame frame(const PerspectiveView& v, Renderer renderer = Renderer::list) const {
    ViewSettings settings;
    settings.renderer = renderer;
    TaskRunner runner(0);
    auto made = renderFrame(scene, v, settings, runner);
    EXPECT_TRUE(made) << (made ? "" : made.error().describe());
    return made ? std::move(*made) : Frame{};
  }
};

Walk walkThrough(const ScenePtr& room, const Place& place, const glm::dvec3& move) {
  Walk walk;
  walk.scale = place.scale, walk.move = move;
  const EffectPlan plan = planEffects(*room);
  const auto rays = RayScene::build(room, plan);
  EXPECT_TRUE(rays);

  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = 1.5 * place.scale;
  spec.nearBand = 0.5 * place.scale;
  spec.latticeOrigin = glm::dvec2(move) + place.scale * glm::dvec2(0.25, 0.25);
  spec.floorHeight = move.z;
  spec.eyeHeight = 1.5 * place.scale;
  const auto at = [&](double x, double y) { return glm::dvec2(move) + place.scale * glm::dvec2(x, y); };
  spec.outline.loops = {{at(0, 0), at(1.9, 0), at(1.9, 0.5), at(0, 0.5)}};
  const auto layout = std::make_shared<const Layout>(buildLayout(spec).value());
  EXPECT_EQ(layout->regions.size(), 2u);

  BakeSettings settings;
  settings.samplesPerDegree = 1.5;
  settings.ambientRays = 4;
  settings.ambientRadius = 2 * place.scale;
  settings.surfaceTexel = 0.25 * place.scale;
  settings.eyeRange = 0;  // heights are chosen by place, and would differ from scale to scale
  TaskRunner runner(1);
  test::MemorySink sink;
  std::vector<int> all(layout->cameras.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  const auto baked = bake(**rays, *layout, all, settings, sink, runner);
  EXPECT_TRUE(baked) << (baked ? "" : baked.error().describe());
  for (const ContentKey& key : captureKeys(*room, plan, settings, *layout))
    walk.scene.captures.push_back(
        std::make_shared<const DisplayCapture>(prepareForDisplay(*sink.find(key), 1)));
  const DrawnScene drawn(room);
  const LocalTriangles local = localTrianglesOf(**rays, drawn, *layout, runner);
  auto light = bakeSurfaceLight(**rays, drawn, local.wanted, local.viewer, settings, runner);
  EXPECT_TRUE(light) << (light ? "" : light.error().describe());
  if (light) walk.scene.surfaceLight = std::make_shared<const SurfaceLight>(std::move(*light));
  for (const Region& region : layout->regions)
    walk.scene.local.push_back(std::make_shared<const LocalGeometry>(clipToPolygon(*room, region.grown)));
  walk.scene.scene = room;
  walk.scene.layout = layout;
  walk.scene.plan = plan;
  return walk;
}

Walk walkAt(const Place& place) {
  const auto room = std::make_shared<const Scene>(finishScene(roomOf(place), "room", {}, {}).value());
  return walkThrough(room, place, place.move - room->origin);
}

/// In regions, a hair's breadth beside their border, looking along it, and at a centre of projection.
std::vector<PerspectiveView> hardViews(const Walk& walk) {
  const double border = 1.0, hair = 1e-6;
  std::vector<PerspectiveView> views{walk.view({0.3, 0.2}, 10, 0),
                                     walk.view({0.8, 0.2}, 0, -5),
                                     walk.view({1.6, 0.4}, 200, -20, 100),
                                     walk.view({border - hair, 0.1}, 0, 0),
                                     walk.view({border + hair, 0.1}, 90, -10),
                                     walk.view({border + hair, 0.3}, -90, 5, 120),
                                     walk.view({0.2, 0.4}, 45, -35)};
  PerspectiveView corner = walk.view({0, 0}, 100, 0);
  const glm::dvec2 centre = walk.scene.layout->regions[0].polygon.corners[0];
  if (walk.scene.layout->regionAt(centre)) corner.eye = glm::dvec3(centre, corner.eye.z);
  views.push_back(corner);
  return views;
}

struct Difference {
  double mean = 0;     ///< codes
  double clearly = 0;  ///< share of pixels that differ by more than 24 codes in some channel
};

Difference differenceOf(const Frame& a, const Frame& b) {
  Difference d;
  const double pixels = double(a.colour.pixels.size());
  for (std::size_t n = 0; n < a.colour.pixels.size(); ++n) {
    const glm::ivec4 apart = glm::abs(glm::ivec4(a.colour.pixels[n]) - glm::ivec4(b.colour.pixels[n]));
    d.mean += (apart.x + apart.y + apart.z) / (3 * pixels);
    d.clearly += std::max({apart.x, apart.y, apart.z}) > 24 ? 1 / pixels : 0;
  }
  return d;
}

/// Positions as a program keeps them that knows no project origin.
Walk walkInWorldSpaceFloats(const glm::dvec3& move) {
  Scene room = finishScene(roomOf({}), "room", {}, {}).value();
  for (Mesh& mesh : room.meshes)
    for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) + move);
  for (Light& light : room.lights) light.position = glm::vec3(glm::dvec3(light.position) + move);
  room.bounds = boundsOf(room);
  room.parts = partsOf(room);
  room.key = keyOf(room.parts);
  return walkThrough(std::make_shared<const Scene>(std::move(room)), {}, move);
}

/// Mean difference in codes, and share of pixels that clearly differ, that count as the same picture.
/// Distances are stored in steps of a power of two, which shifts a sample by a twentieth of a sample's
/// spacing at most; and with four rays gathered at a place, a single one that rounding sends past an edge is
/// seen around it.
constexpr double kMeanCodes = 0.2, kClearly = 0.003;

TEST(HardCases, TheSameProjectAtAnyScaleAndPlaceGivesTheSamePictureAndWorldSpaceFloatsDoNot) {
  const Walk reference = walkAt({});
  const std::vector<PerspectiveView> views = hardViews(reference);
  std::vector<Frame> expected;
  for (const PerspectiveView& view : views) expected.push_back(reference.frame(view));
  const glm::dvec3 far(5e6, -5e6, 120);
  double worstMean = 0, worstClearly = 0;
  for (const Place& place : {Place{1e-3, {}}, Place{1e4, {}}, Place{1e-3, far}, Place{1, far},
                             Place{1e4, far}, Place{1e-3, {500, -400, 3}}}) {
    const Walk walk = walkAt(place);
    const std::vector<PerspectiveView> others = hardViews(walk);
    ASSERT_EQ(others.size(), views.size());
    for (std::size_t n = 0; n < views.size(); ++n) {
      const Difference d = differenceOf(expected[n], walk.frame(others[n]));
      EXPECT_LT(d.mean, kMeanCodes) << "view " << n << " at scale " << place.scale << ", moved "
                                    << place.move.x;
      EXPECT_LT(d.clearly, kClearly) << "view " << n << " at scale " << place.scale << ", moved "
                                     << place.move.x;
      worstMean = std::max(worstMean, d.mean), worstClearly = std::max(worstClearly, d.clearly);
    }
  }
  RecordProperty("worstMeanCodes", std::to_string(worstMean));
  RecordProperty("worstClearlyDifferingPercent", std::to_string(100 * worstClearly));

  const Walk naive = walkInWorldSpaceFloats(far);
  const std::vector<PerspectiveView> others = hardViews(naive);
  for (std::size_t n = 0; n < views.size(); ++n)
    EXPECT_GT(differenceOf(expected[n], naive.frame(others[n])).clearly, 100 * kClearly) << "view " << n;
}

}  // namespace
}  // namespace acentric
