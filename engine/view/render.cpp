#include "engine/view/render.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <optional>
#include <span>

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

/// More than one: some strips hold more than others. Not many more: samples near the borders are read twice.
constexpr int kStripsPerThread = 2;
/// Of patches: narrow enough for what is known of a strip's pixels to stay in the cache.
constexpr int kPatchStripsPerThread = 12;

bool isReference(const ViewSettings& settings) {
  return settings.renderer == Renderer::scalar || settings.renderer == Renderer::precise;
}

const Kernels& kernelsFor(const ViewSettings& settings) {
  return isReference(settings) ? supportedKernels().front() : supportedKernels().back();
}

/// Borders of strips that take equal time, if every column of the picture takes what it took the last time;
/// else of equal width.
std::vector<int> stripBorders(int width, std::size_t strips, const StripTimes& last) {
  std::vector<int> borders(strips + 1, width);
  const bool known = last.seconds.size() == strips && last.borders.back() == width;
  const double all = std::accumulate(last.seconds.begin(), last.seconds.end(), 0.0);
  double before = 0;  // seconds left of strip `own` of the last frame
  for (std::size_t s = 0, own = 0; s < strips; ++s) {
    const double share = static_cast<double>(s) / static_cast<double>(strips);
    double border = share * width;
    if (known && all > 0) {
      while (own + 1 < strips && before + last.seconds[own] < share * all) before += last.seconds[own++];
      const double inside = last.seconds[own] > 0 ? (share * all - before) / last.seconds[own] : 0;
      border = last.borders[own] + inside * (last.borders[own + 1] - last.borders[own]);
    }
    const int least = s == 0 ? 0 : borders[s - 1] + 1;
    borders[s] = std::clamp(static_cast<int>(border), least, width - static_cast<int>(strips - s));
  }
  return borders;
}

/// By slot of the canvas.
std::vector<PixelSource> sourcesOf(const ViewPlan& plan) {
  std::vector<PixelSource> sources{kSourceHole, kSourceBackground};
  for (const PieceDraw& piece : plan.backgrounds) sources.push_back(sourceOfCamera(piece.camera));
  for (const PieceDraw& piece : plan.pieces) sources.push_back(sourceOfCamera(piece.camera));
  for (const PieceDraw& piece : plan.reflections) sources.push_back(sourceOfCamera(piece.camera));
  return sources;
}

template <class T>
void resize(Image<T>& image, const PerspectiveView& view) {
  image.width = view.width, image.height = view.height;
  image.pixels.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
}

/// Everything but local geometry, strip by strip; every pixel of the frame and of the depths is written.
WarpCounts drawCaptures(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                        const ViewPlan& plan, const CoverImage* cover,
                        std::span<const std::uint8_t> coverMirrors, TaskRunner& runner, FrameMemory& memory,
                        Frame& frame) {
  const Kernels& kernels = kernelsFor(settings);
  WarpOptions options;
  options.depthTest = settings.renderer == Renderer::zbuffer;
  options.precise = settings.renderer == Renderer::precise;
  options.cover = cover;
  options.coverMirrors = coverMirrors;
  const BackgroundLimits limits = backgroundLimits(scene, view.eye);
  std::optional<SkyTable> sky;
  if (showsBackground(limits, view)) sky.emplace(backgroundSky(scene), scene.exposure);
  const CapturedBackground background(scene, plan);
  const std::vector<PixelSource> sources = sourcesOf(plan);

  const bool patches = drawsPatches(scene, plan, settings);
  const int perThread = patches ? kPatchStripsPerThread : kStripsPerThread;
  const auto strips = static_cast<std::size_t>(std::min(perThread * runner.threads(), view.width));
  const PatchPlan patchPlan = patches ? planPatches(scene, view, plan, runner) : PatchPlan();
  const int beside = pixelsReadBeside(plan);
  if (memory.canvases.size() < strips) memory.canvases.resize(strips);
  if (memory.patchCanvases.size() < strips && patches) memory.patchCanvases.resize(strips);
  const std::vector<int> borders = stripBorders(view.width, strips, memory.strips);
  std::vector<WarpCounts> counts(strips);
  std::vector<double> seconds(strips);
  runner.parallelFor(strips, [&](std::size_t strip) {
    const Stopwatch time;
    const int x0 = borders[strip], x1 = borders[strip + 1];
    Canvas& canvas = memory.canvases[strip];
    clearCanvas(scene, view, plan, std::max(x0 - beside, 0), std::min(x1 + beside, view.width), canvas);
    if (sky) paintBackground(*sky, view, limits, kBackgroundSlot, canvas);
    background.paint(view, canvas);
    counts[strip] = patches ? paintPatches(patchPlan, *kernels.patches, cover, coverMirrors, x0, x1,
                                           memory.patchCanvases[strip], canvas)
                            : warpPieces(scene, view, settings, plan, options, x0, x1, canvas);
    develop(canvas, x0, x1, sources, frame, memory.inverseZDepth);
    seconds[strip] = time.seconds();
  });
  memory.strips = {borders, seconds};
  WarpCounts all;
  for (const WarpCounts& c : counts) all += c;
  return all;
}

Frame draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
           const ViewPlan& plan, TaskRunner& runner, FrameMemory& memory) {
  Frame frame = std::move(memory.frame);
  resize(frame.colour, view);
  resize(frame.source, view);
  resize(memory.inverseZDepth, view);
  FloatImage& inverseZDepth = memory.inverseZDepth;
  frame.stats = {};
  FrameStats& stats = frame.stats;

  // What local geometry covers need not be drawn from captures.
  const std::size_t region = static_cast<std::size_t>(plan.region);
  const LocalGeometry* local = region < scene.local.size() ? scene.local[region].get() : nullptr;
  const bool drawLocal = settings.localGeometry && local != nullptr && scene.scene != nullptr;
  const Stopwatch localTime;
  std::optional<LocalShading> shading;
  std::optional<LocalRaster> raster;
  if (drawLocal) {
    shading.emplace(scene, *local);
    raster.emplace(*local, *shading, view, runner);
    raster->findOpaque(kernelsFor(settings).coverRow, memory.cover, runner);
    if (scene.mirrors && !plan.reflections.empty()) raster->findMirrors(*scene.mirrors);
    stats.localSeconds = localTime.seconds();
  }

  const Stopwatch warpTime;
  const WarpCounts counts = drawCaptures(
      scene, view, settings, plan, drawLocal ? &memory.cover : nullptr,
      raster ? std::span(raster->mirrors()) : std::span<const std::uint8_t>(), runner, memory, frame);
  stats.images = imagesOf(plan);
  stats.missingImages = plan.missingImages;
  stats.samplesRead = counts.samplesRead;
  stats.samplesDrawn = counts.samplesDrawn;
  stats.warpSeconds = warpTime.seconds();

  const Stopwatch drawTime;
  if (raster) raster->drawOpaque(memory.cover, kernelsFor(settings).shadeRun, frame, inverseZDepth, runner);
  if (settings.fillHoles) {  // after the opaque geometry, which closes most holes, and before glass, which
                             // needs something behind it
    const Stopwatch fillTime;
    fillHoles(frame, inverseZDepth, plan.missingImages > 0 ? kFillRingsWhileLoading : kFillRings, runner);
    stats.fillSeconds = fillTime.seconds();
  }
  if (raster) {
    if (raster->hasClear()) raster->drawClear(kernelsFor(settings).blendRow, frame, inverseZDepth, runner);
    stats.localTriangles = raster->triangleCount();
    stats.localSeconds += drawTime.seconds() - stats.fillSeconds;
  }
  return frame;
}

tl::unexpected<Error> tooLarge() {
  return fail(ErrorKind::outOfSpace, "not enough memory for a picture of this size: ask for a smaller one",
              "view");
}

}  // namespace

Result<Frame> renderFrame(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                          TaskRunner& runner) {
  FrameMemory memory;
  return renderFrame(scene, view, settings, runner, memory);
}

Result<Frame> renderFrame(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                          TaskRunner& runner, FrameMemory& memory) {
  const Stopwatch total;
  try {
    const auto plan = planView(scene, view, settings);
    if (!plan) return tl::unexpected(plan.error());
    const double planSeconds = total.seconds();
    auto frame = renderPlan(scene, view, settings, *plan, runner, memory);
    if (!frame) return frame;
    frame->stats.planSeconds = planSeconds;
    frame->stats.totalSeconds = total.seconds();
    return frame;
  } catch (const std::bad_alloc&) {
    return tooLarge();
  }
}

Result<Frame> renderPlan(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                         const ViewPlan& plan, TaskRunner& runner, FrameMemory& memory) {
  const Stopwatch total;
  if (onOpenGl(settings.renderer))
    return fail(ErrorKind::unsupported,
                "the OpenGL renderer needs a window or a headless context: use GlRenderer", "view settings");
  try {
    Frame frame = draw(scene, view, settings, plan, runner, memory);
    frame.stats.totalSeconds = total.seconds();
    return frame;
  } catch (const std::bad_alloc&) {
    return tooLarge();
  }
}

}  // namespace acentric
