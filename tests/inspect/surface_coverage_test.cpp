#include "engine/inspect/surface_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/scene/instances.h"
#include "engine/scene/triangle_normal.h"
#include "tests/inspect/little_world.h"

namespace acentric {
namespace {
using test::Box;
using test::BoxTracer;
using test::emptyRoom;
using test::furnishedRoom;
using test::heldSlowly;
using test::World;

TEST(CaptureReach, HoldsWhatTheMarchOfTheBakeWouldKeep) {
  for (const int maxLayers : {2, 1}) {
    const World world(furnishedRoom(), Configuration::b);
    const CaptureReach reach = world.reach(maxLayers);
    const SurfacePoints points(world.scene);
    int held = 0, checked = 0;
    for (std::uint64_t n = 0; n < 400; ++n) {
      const glm::dvec3 point = points.at(n).position;
      for (std::size_t c = 0; c < world.columns.size(); c += 3) {
        const bool expected = heldSlowly(world, int(c), point, maxLayers);
        EXPECT_EQ(reach.holds(int(c), point), expected) << "point " << n << " camera " << c;
        held += expected ? 1 : 0;
        ++checked;
      }
    }
    EXPECT_GT(held, checked / 20);
    EXPECT_LT(held, checked * 19 / 20);
  }
}

/// Keeps what lies on one side of a plane across x.
class KeepsBeyond final : public CaptureSight {
 public:
  explicit KeepsBeyond(double x) : x_(x) {}
  bool keeps(int, std::size_t, const glm::dvec3& point, const OpaqueHit&, const glm::dvec3&) const override {
    return point.x > x_;
  }
  bool keepsSky(int, std::size_t, const glm::dvec3&) const override { return false; }
  double rightBehind(int) const override { return 2e-3; }

 private:
  double x_;
};

TEST(CaptureReach, SurfacesThatPruningDropsAreNotHeldAndUseUpNoLayers) {
  const World world(
      {{{-9, -9, -0.2}, {29, 9, 0}}, {{16, -9, 0}, {16.2, 9, 2.5}}, {{20, -9, 0}, {20.2, 9, 3}}},
      Configuration::b);
  const KeepsBeyond sight(18);
  const CaptureReach all(world.layout, world.columns, 1, world.tracer);
  const CaptureReach pruned(world.layout, world.columns, 1, world.tracer, &sight);
  int cameras = 0;
  for (std::size_t c = 0; c < world.columns.size(); ++c) {
    const glm::dvec3& centre = world.columns[c].centreOfProjection;
    const auto ahead = [&](double x) { return glm::dvec3(x, centre.y, centre.z); };
    if (!all.holds(int(c), ahead(16))) continue;
    ++cameras;
    EXPECT_FALSE(pruned.holds(int(c), ahead(16))) << "no test eye sees it";
    EXPECT_FALSE(all.holds(int(c), ahead(20))) << "the one layer is the screen's";
    EXPECT_TRUE(pruned.holds(int(c), ahead(20))) << "the layer is still free";
    EXPECT_FALSE(pruned.holdsSky(int(c), glm::normalize(glm::dvec3(-1, 0.1, 0.2))));
  }
  EXPECT_GT(cameras, 3);
}

TEST(CaptureReach, HoldsTheSkyWhereNothingIsBeyondTheRegions) {
  const World world({{{-9, -9, -0.2}, {9, 9, 0}}, {{8, -9, 0}, {8.2, 9, 3}}}, Configuration::b);
  const CaptureReach reach = world.reach(1);
  for (std::size_t c = 0; c < world.columns.size(); ++c) {
    const double elevation = std::atan2(3 - world.layout.eyeZ(), 8 - world.columns[c].centreOfProjection.x);
    const auto towards = [&](double up) { return glm::dvec3(std::cos(up), 0, std::sin(up)); };
    EXPECT_TRUE(reach.holdsSky(int(c), towards(elevation + 0.05))) << "over the wall";
    EXPECT_FALSE(reach.holdsSky(int(c), towards(0.01))) << "through the wall";
    EXPECT_TRUE(reach.holdsSky(int(c), towards(radians(86)))) << "above the camera's rows";
    EXPECT_TRUE(reach.holdsSky(int(c), glm::dvec3(-1, 0, 0)));
  }
}

TEST(StandingEyes, LieWithinTheirRegionsAndTheOutline) {
  LayoutSpec spec;
  spec.cellSize = 1.5;
  spec.outline.loops = {{{0, 0}, {5, 0}, {5, 3}, {0, 3}}, {{2, 1}, {3, 1}, {3, 2}, {2, 2}}};
  spec.added = {{-4, 0, 0}};
  const Layout layout = buildLayout(spec).value();
  const auto eyes = standingEyes(layout, {9, 0.4, 0.1});
  ASSERT_EQ(eyes.size(), layout.regions.size());
  std::size_t placed = 0;
  for (std::size_t r = 0; r < eyes.size(); ++r) {
    const Region& region = layout.regions[r];
    for (const glm::dvec3& eye : eyes[r]) {
      EXPECT_TRUE(region.polygon.contains(glm::dvec2(eye)));
      EXPECT_TRUE(spec.outline.contains(glm::dvec2(eye)) || spec.added.contains(region.id));
      EXPECT_GE(eye.z, layout.eyeZ() - 0.4);
      EXPECT_LE(eye.z, layout.eyeZ() + 0.1);
    }
    placed += eyes[r].size() == 9 ? 1 : 0;
  }
  EXPECT_GT(placed, eyes.size() / 2);
  EXPECT_EQ(eyes[std::size_t(*layout.findRegion({-4, 0, 0}))].size(), 9u);
}

TEST(StandingEyes, OfTooManyRegionsStandInAFairSampleOfThem) {
  LayoutSpec spec;
  spec.cellSize = 0.5;
  spec.outline.loops = {{{0, 0}, {20, 0}, {20, 20}, {0, 20}}};
  const Layout layout = buildLayout(spec).value();
  const auto eyes = standingEyes(layout, {2, 0, 0, 300});
  ASSERT_GT(layout.regions.size(), 1200u);
  std::size_t regions = 0, rings = 0, left = 0, allRings = 0;
  for (std::size_t r = 0; r < eyes.size(); ++r) {
    const bool ring = layout.regions[r].kind == RegionKind::ring;
    allRings += ring ? 1 : 0;
    if (eyes[r].empty()) continue;
    ++regions;
    rings += ring ? 1 : 0;
    left += layout.regions[r].polygon.centroid().x < 10 ? 1 : 0;
  }
  EXPECT_NEAR(double(regions), 300, 10);
  EXPECT_NEAR(double(rings) / double(regions), double(allRings) / double(eyes.size()), 0.05);
  EXPECT_NEAR(double(left) / double(regions), 0.5, 0.06);
}

TEST(SurfacePoints, AreSpreadByArea) {
  const ScenePtr scene = test::sceneOf({{{0, 0, 0}, {1, 1, 1}}, {{5, 0, 0}, {8, 2, 1}}});
  const SurfacePoints points(scene);
  EXPECT_NEAR(points.area(), 6 + 2 * (6 + 3 + 2), 1e-5);
  for (const int count : {100, 2000}) {
    int onFirst = 0, up = 0;
    for (int n = 0; n < count; ++n) {
      const SurfacePoint point = points.at(std::uint64_t(n));
      onFirst += point.mesh == 0 ? 1 : 0;
      up += point.normal.z > 0.5 ? 1 : 0;
      const Box box = point.mesh == 0 ? Box{{0, 0, 0}, {1, 1, 1}} : Box{{5, 0, 0}, {8, 2, 1}};
      const glm::dvec3 off = glm::min(glm::abs(point.position - box.min), glm::abs(point.position - box.max));
      EXPECT_NEAR(std::min(off.x, std::min(off.y, off.z)), 0, 1e-6) << "on a side of the box";
    }
    EXPECT_NEAR(double(onFirst) / count, 6.0 / 28, 2.5 / count + 0.01);
    EXPECT_NEAR(double(up) / count, 7.0 / 28, 2.5 / count + 0.01);
  }
}

/// One as it is modelled, one doubled, one stretched and mirrored, and a mesh.
TEST(SurfacePoints, AreSpreadByAreaOverInstancesToo) {
  auto scene = std::make_shared<Scene>(*test::sceneOf({{{0, 0, 0}, {1, 1, 1}}, {{5, 0, 0}, {8, 2, 1}}}));
  scene->prototypes.push_back(std::move(scene->meshes.back()));
  scene->meshes.pop_back();
  scene->instances = {{0, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, 30}}},
                      {0, {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 0, 60}}},
                      {0, {{-1, 0, 0}, {0, 3, 0}, {0, 0, 5}, {0, 0, 90}}}};
  const Scene flat = flattened(*scene);
  const SurfacePoints points(scene), reference(std::make_shared<const Scene>(flat));
  EXPECT_NEAR(points.area(), reference.area(), 1e-5 * reference.area());
  constexpr int kCount = 4000;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> met, expected;  // by placed mesh and triangle
  for (std::uint64_t n = 0; n < kCount; ++n) {
    const SurfacePoint point = points.at(n), other = reference.at(n);
    ++met[{point.mesh, point.triangle}], ++expected[{other.mesh, other.triangle}];
    const Mesh& mesh = flat.meshes[point.mesh];
    const glm::dvec3 corner(mesh.positions[mesh.triangles[point.triangle].x]);
    EXPECT_NEAR(glm::dot(point.normal, point.position - corner), 0, 1e-4) << "in its triangle's plane";
    EXPECT_LT(glm::distance(point.normal, glm::dvec3(triangleNormal(mesh, point.triangle))), 1e-4);
  }
  for (const auto& [triangle, count] : expected)
    EXPECT_NEAR(met[triangle], count, 4 * std::sqrt(double(count)) + 3)
        << triangle.first << " " << triangle.second;
}

TEST(SurfaceCoverage, OfAnEmptyRoomMissesNothing) {
  for (const Configuration configuration : {Configuration::b, Configuration::e, Configuration::f}) {
    const World world(emptyRoom(), configuration);
    SurfaceCoverageOptions options;
    options.points = 400;
    options.eyes.perRegion = 4;
    TaskRunner runner(1);
    const auto coverage = measureSurfaceCoverage(world.scene, world.reach(), options, runner);
    ASSERT_TRUE(coverage) << coverage.error().describe();
    EXPECT_TRUE((*coverage)->complete);
    EXPECT_EQ((*coverage)->points.size(), 400u);
    const CoverageSummary& all = (*coverage)->all;
    EXPECT_GT(all.seen, 100u);
    EXPECT_EQ(all.ofClass[std::size_t(SurfaceClass::neverSampled)], 0u);
    EXPECT_EQ(all.eyesMissing, 0u);
    for (const PointCoverage& point : (*coverage)->points)
      EXPECT_EQ(point.surfaceClass == SurfaceClass::unseen, point.eyesSeeing == 0);
  }
}

TEST(SurfaceCoverage, AgreesWithAskingEveryRegionEyeAndCoverOneByOne) {
  for (const bool everyCover : {true, false}) {
    const World world(furnishedRoom(), Configuration::b);
    const CaptureReach reach = world.reach(1);
    SurfaceCoverageOptions options;
    options.everyCover = everyCover;
    options.eyes = {5, 0.3, 0.1};
    const SurfaceJudge judge(reach, options);
    const SurfacePoints points(world.scene);
    std::map<SurfaceClass, int> seen;
    int missed = 0;
    for (std::uint64_t n = 0; n < 500; ++n) {
      const SurfacePoint point = points.at(n);
      const glm::dvec2 place(point.position);
      std::vector<std::uint32_t> seenFrom, missedFrom;
      std::uint32_t eyesSeeing = 0, eyesMissing = 0;
      for (std::uint32_t r = 0; r < world.layout.regions.size(); ++r) {
        const Region& region = world.layout.regions[r];
        bool sees = false, misses = false;
        for (const glm::dvec3& eye : judge.eyes()[r]) {
          const glm::dvec3 way = point.position - eye;
          const double distance = glm::length(way);
          if (world.tracer.trace(eye, way / distance, 0, distance * (1 - 6e-5)).found()) continue;
          sees = true;
          ++eyesSeeing;
          if (region.grown.containsClosed(place)) continue;
          bool held = false;
          for (const Cover& cover : region.covers) {
            const Hand facing = preferredHand(region, glm::dvec2(eye), std::atan2(way.y, way.x));
            if (!everyCover && region.covers.size() > 1 && cover.hand != facing) continue;
            for (const Piece& piece : cover.pieces)
              held = held ||
                     (piece.holds(place) && heldSlowly(world, piece.camera, point.position, 1, piece.role));
          }
          if (!held) misses = true, ++eyesMissing;
        }
        if (sees) seenFrom.push_back(r);
        if (misses) missedFrom.push_back(r);
      }
      const PointCoverage found = judge.judge(point);
      EXPECT_EQ(found.seenFrom, seenFrom) << n;
      EXPECT_EQ(found.missedFrom, missedFrom) << n;
      EXPECT_EQ(found.eyesSeeing, eyesSeeing);
      EXPECT_EQ(found.eyesMissing, eyesMissing);
      missed += missedFrom.empty() ? 0 : 1;
      ++seen[found.surfaceClass];
      if (found.camera < 0) continue;
      EXPECT_GT(found.samplesPerMetre, 0);
      EXPECT_GT(found.pixelsPerMetre, 0);
      EXPECT_TRUE(reach.holds(found.camera, point.position));
      EXPECT_FALSE(world.layout.regions[std::size_t(found.nearestRegion)].grown.containsClosed(place));
    }
    EXPECT_GT(missed, 5) << "the furniture hides something from some camera";
    EXPECT_GT(seen[SurfaceClass::unseen], 5);
    EXPECT_GT(seen[SurfaceClass::under] + seen[SurfaceClass::fine] + seen[SurfaceClass::over], 50);
  }
}

TEST(SurfaceCoverage, ShowsEvenBeginningsOfWhatItEndsWith) {
  const World world(furnishedRoom(), Configuration::b);
  SurfaceCoverageOptions options;
  options.points = 600;
  options.eyes.perRegion = 3;
  options.firstSeconds = options.laterSeconds = 0;
  std::vector<SurfaceCoveragePtr> shown;
  TaskRunner runner(1), alone;
  const CaptureReach reach = world.reach();
  const auto final = measureSurfaceCoverage(world.scene, reach, options, runner,
                                            [&](const SurfaceCoveragePtr& s) { shown.push_back(s); });
  const auto again = measureSurfaceCoverage(world.scene, reach, options, alone);
  ASSERT_TRUE(final && again);
  ASSERT_GE(shown.size(), 2u);
  EXPECT_EQ(shown.back(), *final);
  EXPECT_TRUE(shown.back()->complete);
  for (std::size_t s = 0; s < shown.size(); ++s) {
    EXPECT_GT(shown[s]->points.size(), s > 0 ? shown[s - 1]->points.size() : 0);
    EXPECT_EQ(shown[s]->all.points, shown[s]->points.size());
    for (std::size_t k = 0; k < shown[s]->points.size(); ++k)
      EXPECT_EQ(shown[s]->points[k].surfaceClass, (*again)->points[k].surfaceClass);
  }
  // Sums over meshes, materials, regions and bins are sums over points.
  const SurfaceCoverage& c = **final;
  std::uint64_t byMesh = 0, byMaterial = 0, seen = 0, missed = 0, pairs = 0, misses = 0, sampled = 0;
  for (const CoverageSummary& summary : c.byMesh) byMesh += summary.points;
  for (const CoverageSummary& summary : c.byMaterial) byMaterial += summary.points;
  for (const std::uint64_t n : c.seenByRegion) seen += n;
  for (const std::uint64_t n : c.missedByRegion) missed += n;
  for (const std::uint64_t n : c.byRatio) sampled += n;
  for (const PointCoverage& point : c.points)
    pairs += point.seenFrom.size(), misses += point.missedFrom.size();
  EXPECT_EQ(byMesh, 600u);
  EXPECT_EQ(byMaterial, 600u);
  EXPECT_EQ(seen, pairs);
  EXPECT_EQ(missed, misses);
  double shares = 0;
  for (int k = 1; k < kSurfaceClasses; ++k) shares += c.all.share(SurfaceClass(k));
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_EQ(sampled, c.all.ofClass[3] + c.all.ofClass[4] + c.all.ofClass[5]);
}

TEST(SurfaceCoverage, StopsAndRefuses) {
  const World world(emptyRoom(), Configuration::b);
  TaskRunner runner;
  std::stop_source source;
  SurfaceCoverageOptions options;
  options.points = 100000;
  options.firstSeconds = 0;
  const auto stopped = measureSurfaceCoverage(
      world.scene, world.reach(), options, runner, [&](const SurfaceCoveragePtr&) { source.request_stop(); },
      source.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  options.points = 0;
  EXPECT_FALSE(measureSurfaceCoverage(world.scene, world.reach(), options, runner));
  options.points = 10, options.focalPixels = NAN;
  EXPECT_FALSE(measureSurfaceCoverage(world.scene, world.reach(), options, runner));
  options.focalPixels = 100, options.eyes.lower = -1;
  EXPECT_FALSE(measureSurfaceCoverage(world.scene, world.reach(), options, runner));
  const auto nothing =
      measureSurfaceCoverage(std::make_shared<Scene>(), world.reach(), SurfaceCoverageOptions{}, runner);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, ErrorKind::notFound);
}

TEST(SurfaceCoverage, CountsSamplesPerPixelInHalfOctaves) {
  EXPECT_EQ(ratioBin(0), 0);
  EXPECT_EQ(ratioBin(NAN), 0);
  EXPECT_EQ(ratioBin(1e300), kRatioBins - 1);
  EXPECT_EQ(ratioBin(std::numeric_limits<double>::infinity()), kRatioBins - 1);
  for (int bin = 1; bin < kRatioBins; ++bin) {
    EXPECT_EQ(ratioBin(ratioBinStart(bin) * 1.001), bin);
    EXPECT_EQ(ratioBin(ratioBinStart(bin) * 0.999), bin - 1);
  }
  EXPECT_NEAR(ratioBinStart(1), 0.125, 1e-12);
  EXPECT_NEAR(ratioBinStart(kRatioBins - 1), 5.65685, 1e-5);
}

}  // namespace
}  // namespace acentric
