#include <epoxy/gl.h>

#include <cstring>

#include "engine/measure/compare.h"
#include "engine/view_gl/mesh_buffers.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::differingShare;
using test::differingSources;
using test::onCpu;

/// Of a picture of points, or of points and meshes, against splats that follow the surface with a depth
/// buffer: as gl_mesh_test.cpp has it for meshes alone.
constexpr double kMostColours = 0.03, kMostSources = 0.02, kLeastPsnr = 28;

class GlMeshBackground : public test::WithGl {
 protected:
  GlMeshBackground() {
    views_.rise = 0.3, views_.pitch = 0.4;
    views_.width = 321, views_.height = 199;
    settings_.renderer = Renderer::glMesh;
    settings_.reconstruction = Reconstruction::surface;
    settings_.fillHoles = false;
    layout_ = test::layoutAroundOrigin(Configuration::b);
    region_ = *layout_->regionAt({0.1, 0.05});
  }
  void SetUp() override {
    WithGl::SetUp();
    if (!renderer_) return;
    live_ = liveRenderer();
    ASSERT_TRUE(live_);
  }
  /// Whose points are there at once: only meshes are awaited.
  static std::unique_ptr<GlRenderer> liveRenderer(int threads = 1) {
    auto live = GlRenderer::create({.waitForCaptures = false,
                                    .backgroundThreads = threads,
                                    .bytesPerFrame = std::size_t(1) << 30,
                                    .secondsPerFrame = 60});
    EXPECT_TRUE(live) << live.error().describe();
    return live ? std::move(*live) : nullptr;
  }
  void TearDown() override {
    live_.reset();
    WithGl::TearDown();
  }
  WalkScene boxes(unsigned seed, double perDegree, int layers = 1) const {
    return test::walkScene(test::randomBoxes(seed, 60, 3.4), layout_, region_, perDegree, layers);
  }
  PerspectiveView nextView() { return views_.next(*layout_, region_, 60); }
  Frame live(const WalkScene& scene, const PerspectiveView& view) {
    return test::drawnBy(*live_, scene, view, settings_);
  }
  /// As the editor does: a new frame when there is a mesh to be shown.
  Frame liveWhenReady(const WalkScene& scene, const PerspectiveView& view) {
    Frame frame = live(scene, view);
    for (int i = 0; i < 60'000 && frame.stats.meshesAwaited > 0; ++i) {
      const auto ready = live_->receive();
      EXPECT_TRUE(ready);
      if (*ready)
        frame = live(scene, view);
      else if (!live_->anyToReceive())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(frame.stats.meshesAwaited, 0);
    return frame;
  }
  void expectSame(const Frame& a, const Frame& b) {
    EXPECT_EQ(a.colour.pixels, b.colour.pixels);
    EXPECT_EQ(a.source.pixels, b.source.pixels);
  }
  void expectLikePoints(const Frame& frame, const WalkScene& scene, const PerspectiveView& view) {
    const Frame cpu = onCpu(scene, view, settings_);
    EXPECT_LE(differingShare(cpu.colour, frame.colour), kMostColours);
    EXPECT_LE(differingSources(cpu, frame), kMostSources);
    EXPECT_GE(psnrOf(cpu.colour, frame.colour), kLeastPsnr);
  }

  test::RandomViews views_{11};
  ViewSettings settings_;
  std::shared_ptr<const Layout> layout_;
  int region_ = 0;
  std::unique_ptr<GlRenderer> live_;
};

TEST_F(GlMeshBackground, PointsAreDrawnUntilMeshesAreReadyAndThenThePictureOfThoseWhoWaited) {
  for (const bool glass : {false, true}) {
    test::AnalyticScene surfaces = test::randomBoxes(3, 60, 3.4);
    if (glass) surfaces.boxes.push_back({{3.5, -1, 0.8}, {3.51, 1, 1.9}, {0.1f, 0.2f, 0.6f, 0.4f}});
    const WalkScene scene = test::walkScene(surfaces, layout_, region_, 4, 2);
    for (const Reconstruction reconstruction : {Reconstruction::surface, Reconstruction::filtered}) {
      live_ = liveRenderer();
      settings_.reconstruction = reconstruction;
      PerspectiveView view = nextView();
      if (glass) view.yawRadians = 0, view.pitchRadians = 0;
      ViewSettings points = settings_;
      points.renderer = Renderer::glZbuffer;
      const Frame asPoints = onGl(scene, view, points), waited = onGl(scene, view, settings_);
      EXPECT_EQ(waited.stats.meshesAwaited, 0);
      ASSERT_FALSE(waited.stats.meshes.empty());

      const Frame first = live(scene, view);
      EXPECT_EQ(first.stats.meshesAwaited, int(waited.stats.meshes.size()));
      EXPECT_EQ(first.stats.pointsForMeshes, first.stats.meshesAwaited);
      EXPECT_EQ(first.stats.images, waited.stats.images);
      EXPECT_EQ(first.stats.meshTriangles, 0u);
      expectSame(first, asPoints);
      EXPECT_NE(first.colour.pixels, waited.colour.pixels) << "points look like meshes";

      const Frame ready = liveWhenReady(scene, view);
      EXPECT_EQ(ready.stats.pointsForMeshes, 0);
      EXPECT_EQ(ready.stats.meshTriangles, waited.stats.meshTriangles);
      EXPECT_EQ(ready.stats.meshSum().triangles, waited.stats.meshSum().triangles);
      EXPECT_EQ(ready.stats.meshSum().bytes, waited.stats.meshSum().bytes);
      expectSame(ready, waited);
    }
  }
}

TEST_F(GlMeshBackground, PointsAndMeshesOfOneFrameFitTogether) {
  const WalkScene scene = boxes(5, 5);
  PerspectiveView view = nextView();
  const double yaw = view.yawRadians;
  int mixed = 0;
  for (int turn = 0; turn < 6; ++turn) {
    view.yawRadians = yaw + turn;
    const Frame frame = live(scene, view);
    mixed += frame.stats.pointsForMeshes > 0 && !frame.stats.meshes.empty() ? 1 : 0;
    EXPECT_EQ(frame.stats.images, onCpu(scene, view, settings_).stats.images);
    expectLikePoints(frame, scene, view);
    liveWhenReady(scene, view);
  }
  EXPECT_GE(mixed, 3) << "all at once were points or meshes";
}

TEST_F(GlMeshBackground, AChangeOfTheErrorKeepsTheOldMeshesUntilTheNewAreReady) {
  const WalkScene scene = boxes(3, 4, 2);
  const PerspectiveView view = nextView();
  const Frame fine = liveWhenReady(scene, view);
  settings_.meshError = 2;
  const Frame still = live(scene, view);
  expectSame(still, fine);
  EXPECT_EQ(still.stats.meshesAwaited, int(still.stats.meshes.size()));
  EXPECT_EQ(still.stats.pointsForMeshes, 0);
  for (const MeshCost& cost : still.stats.meshes) EXPECT_EQ(cost.error, 0.25) << "the error that was used";
  const Frame coarse = liveWhenReady(scene, view);
  expectSame(coarse, onGl(scene, view, settings_));
  EXPECT_NE(coarse.colour.pixels, fine.colour.pixels);

  const auto most = std::ranges::max_element(coarse.stats.meshes, {}, &MeshCost::triangles);
  settings_.maxMeshTriangles = int(most->triangles) * 9 / 10;
  const Frame unlimited = live(scene, view);
  expectSame(unlimited, coarse);
  const Frame limited = liveWhenReady(scene, view);
  expectSame(limited, onGl(scene, view, settings_));
  EXPECT_GT(limited.stats.meshSum().error, 2);
  for (const MeshCost& cost : limited.stats.meshes)
    EXPECT_LE(cost.triangles, std::uint64_t(settings_.maxMeshTriangles));
}

TEST_F(GlMeshBackground, AChangeOfTheErrorWhileBuildingBuildsForTheLastOne) {
  const WalkScene scene = boxes(3, 4, 2);
  const PerspectiveView view = nextView();
  for (const double error : {0.25, 1.0, 0.25, 3.0, 0.5}) {
    settings_.meshError = error;
    const Frame frame = live(scene, view);
    EXPECT_GT(frame.stats.meshesAwaited, 0);
  }
  const Frame ready = liveWhenReady(scene, view);
  for (const MeshCost& cost : ready.stats.meshes) EXPECT_EQ(cost.error, 0.5);
  expectSame(ready, onGl(scene, view, settings_));
}

TEST_F(GlMeshBackground, WhatIsEvictedWhileBuildingIsLetGoOf) {
  WalkScene scene = boxes(5, 6);
  const PerspectiveView view = nextView();
  live(scene, view);
  const WalkScene coarser = boxes(5, 3);
  std::vector<std::weak_ptr<const DisplayCapture>> evicted;
  for (std::size_t i = 0; i < scene.captures.size(); ++i) {
    if (!scene.captures[i]) continue;
    evicted.push_back(scene.captures[i]);
    scene.captures[i] = i % 2 == 0 ? nullptr : coarser.captures[i];
  }
  const Frame first = live(scene, view);
  EXPECT_EQ(first.stats.meshes.size(), 0u) << "meshes of captures that are gone";
  EXPECT_GT(first.stats.missingImages, 0);
  const Frame ready = liveWhenReady(scene, view);
  expectSame(ready, onGl(scene, view, settings_));
  for (const auto& capture : evicted) EXPECT_TRUE(test::isLetGoOf(capture));
}

TEST_F(GlMeshBackground, OtherRenderersEndTheBuilding) {
  const PerspectiveView view = nextView();
  const WalkScene scene = test::onlyInView(boxes(3, 4), view, settings_);
  live(scene, view);
  ViewSettings other = settings_;
  other.renderer = Renderer::gl;
  ASSERT_TRUE(live_->draw(scene, view, other));
  EXPECT_FALSE(live_->anyToReceive());
  EXPECT_EQ(live(scene, view).stats.meshes.size(), 0u);
  live_->stopBuilding();
  EXPECT_FALSE(live_->anyToReceive());
  expectSame(liveWhenReady(scene, view), onGl(scene, view, settings_));
}

TEST_F(GlMeshBackground, IsDestroyedWhileItBuilds) {
  const WalkScene scene = boxes(3, 4);
  for (int i = 0; i < 4; ++i) {
    live(scene, nextView());
    live_ = liveRenderer(2);
  }
  live_.reset();
  for (const auto& capture : scene.captures) EXPECT_LE(capture.use_count(), 1);
}

TEST_F(GlMeshBackground, AMeshIsSentInPieces) {
  const WalkScene scene = boxes(3, 3);
  const auto capture = *std::ranges::find_if(scene.captures, [](const auto& c) { return c != nullptr; });
  const MeshTask task{capture, 0, "capture of camera 0", 2, 0.25, 0, std::size_t(1) << 14};
  TaskRunner runner(0);
  const auto packed = packMesh(*capture, task, runner);
  ASSERT_TRUE(packed);
  ASSERT_GT(packed->chunks.size(), 1u);
  MeshUpload upload(task, *packed);
  std::size_t sent = 0;
  while (!upload.done()) {
    const std::size_t piece = upload.send(1000);
    EXPECT_TRUE(piece == 1000 || upload.done());
    sent += piece;
  }
  MeshBuffers buffers = upload.take();
  EXPECT_EQ(sent, buffers.bytes);
  ASSERT_EQ(buffers.chunks.size(), packed->chunks.size());
  const auto holds = [](const GlBuffer& buffer, const auto& values) {
    std::vector<std::byte> read(values.size() * sizeof values[0]);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, GLsizeiptr(read.size()), read.data());
    return std::memcmp(read.data(), values.data(), read.size()) == 0;
  };
  for (std::size_t i = 0; i < packed->chunks.size(); ++i) {
    EXPECT_TRUE(holds(buffers.chunks[i].patchBuffer, packed->chunks[i].patches));
    EXPECT_TRUE(holds(buffers.chunks[i].texels, packed->chunks[i].texels));
  }
  EXPECT_TRUE(holds(buffers.borders, packed->borders));
}

}  // namespace
}  // namespace acentric
