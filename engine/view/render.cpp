#include "engine/view/render.h"

#include <algorithm>
#include <new>
#include <set>

#include "engine/base/contract.h"
#include "engine/base/stopwatch.h"
#include "engine/view/background.h"
#include "engine/view/captured_background.h"
#include "engine/view/develop.h"
#include "engine/view/hole_fill.h"
#include "engine/view/kernels.h"
#include "engine/view/local_raster.h"
#include "engine/view/view_plan.h"
#include "engine/view/warp.h"

namespace acentric {
namespace {

/// How far colours spread into a hole. Where images are not loaded yet the gap must stay visible as one.
constexpr int kFillRings = 4096;
constexpr int kFillRingsWhileLoading = 8;

/// More than one: some strips hold more than others.
constexpr int kStripsPerThread = 2;

/// By slot of the canvas.
std::vector<PixelSource> sourcesOf(const ViewPlan& plan) {
  std::vector<PixelSource> sources{kSourceHole, kSourceBackground};
  for (const PieceDraw& piece : plan.backgrounds) sources.push_back(sourceOfCamera(piece.camera));
  for (const PieceDraw& piece : plan.pieces) sources.push_back(sourceOfCamera(piece.camera));
  for (const PieceDraw& piece : plan.reflections) sources.push_back(sourceOfCamera(piece.camera));
  return sources;
}

Frame draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
           const ViewPlan& plan, TaskRunner& runner) {
  Frame frame;
  frame.colour = ColourImage(view.width, view.height, Rgba8(0));
  frame.source = Image<PixelSource>(view.width, view.height, kSourceHole);
  FloatImage inverseZDepth(view.width, view.height, 0.0f);
  FrameStats& stats = frame.stats;

  const Stopwatch warpTime;
  std::set<int> images;
  bool blended = false;
  for (const PieceDraw& piece : plan.pieces) {
    images.insert(piece.camera);
    blended = blended || scene.captures[static_cast<std::size_t>(piece.camera)]->blended;
  }
  for (const PieceDraw& piece : plan.backgrounds) images.insert(piece.camera);
  WarpOptions options;
  const Kernels& kernels =
      settings.renderer == Renderer::scalar ? supportedKernels().front() : supportedKernels().back();
  options.project = kernels.project;
  options.cull = settings.renderer != Renderer::scalar;
  options.depthTest = settings.renderer == Renderer::zbuffer;
  options.strips = kStripsPerThread * runner.threads();
  Canvas canvas = makeCanvas(view, blended, !plan.reflections.empty(),
                             settings.reconstruction == Reconstruction::filtered);
  if (const BackgroundLimits limits = backgroundLimits(scene, view.eye); showsBackground(limits, view))
    paintBackground(scene, view, limits, kBackgroundSlot, canvas, runner);
  paintCapturedBackground(scene, view, plan, canvas, runner);
  const WarpCounts counts = warpPieces(scene, view, settings, plan, options, canvas, runner);
  develop(canvas, sourcesOf(plan), kernels.filter, frame, inverseZDepth, runner);
  stats.images = static_cast<int>(images.size());
  stats.missingImages = plan.missingImages;
  stats.samplesRead = counts.samplesRead;
  stats.samplesDrawn = counts.samplesDrawn;
  stats.warpSeconds = warpTime.seconds();

  const std::size_t region = static_cast<std::size_t>(plan.region);
  const LocalGeometry* local = region < scene.local.size() ? scene.local[region].get() : nullptr;
  const bool drawLocal = settings.localGeometry && local != nullptr && scene.scene != nullptr;
  const auto fill = [&] {
    if (!settings.fillHoles) return;
    const Stopwatch fillTime;
    fillHoles(frame, inverseZDepth, plan.missingImages > 0 ? kFillRingsWhileLoading : kFillRings);
    stats.fillSeconds = fillTime.seconds();
  };
  if (!drawLocal) {
    fill();
    return frame;
  }
  const Stopwatch localTime;
  const LocalShading shading(scene, *local);
  const LocalRaster raster(*local, shading, view, runner);
  raster.drawOpaque(frame, inverseZDepth, runner);
  fill();  // after the opaque geometry, which closes most holes, and before glass, which needs something
           // behind it
  if (raster.hasClear()) raster.drawClear(frame, inverseZDepth, runner);
  stats.localTriangles = raster.triangleCount();
  stats.localSeconds = localTime.seconds() - stats.fillSeconds;
  return frame;
}

}  // namespace

Result<Frame> renderFrame(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                          TaskRunner& runner) {
  const Stopwatch total;
  if (settings.renderer == Renderer::gl)
    return fail(ErrorKind::unsupported,
                "the OpenGL renderer needs a window or a headless context: use GlRenderer", "view settings");
  try {
    const auto plan = planView(scene, view, settings);
    if (!plan) return tl::unexpected(plan.error());
    Frame frame = draw(scene, view, settings, *plan, runner);
    frame.stats.totalSeconds = total.seconds();
    return frame;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for a picture of this size: ask for a smaller one",
                "view");
  }
}

}  // namespace acentric
