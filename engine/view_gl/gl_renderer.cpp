#include "engine/view_gl/gl_renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "engine/base/contract.h"
#include "engine/view/view_plan.h"
#include "engine/view_gl/background_pass.h"
#include "engine/view_gl/fill_pass.h"
#include "engine/view_gl/frame_target.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/gl_program.h"
#include "engine/view_gl/gl_state.h"
#include "engine/view_gl/live_captures.h"
#include "engine/view_gl/local_pass.h"
#include "engine/view_gl/patch_pass.h"

namespace acentric {
namespace {

/// Captures beyond this leave graphics memory, those unused for longest first.
constexpr std::size_t kCaptureBudgetBytes = std::size_t(2) << 30;

/// How far colours spread into a hole, as in view/render.cpp: where images are not loaded yet the gap must
/// stay visible.
constexpr int kFillReach = 4096;
constexpr int kFillReachWhileLoading = 8;

using Clock = std::chrono::steady_clock;

/// Seconds since `start`, after the work submitted so far is done: statistics are of drawing, not of
/// queueing.
double secondsOfDrawing(Clock::time_point start) {
  glFinish();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// By the card's clock; waits for the second.
double secondsBetween(const GlQuery& first, const GlQuery& second) {
  GLuint64 begin = 0, end = 0;
  glGetQueryObjectui64v(first.name(), GL_QUERY_RESULT, &begin);
  glGetQueryObjectui64v(second.name(), GL_QUERY_RESULT, &end);
  return end > begin ? 1e-9 * double(end - begin) : 0;
}

}  // namespace

struct GlRenderer::Impl {
  explicit Impl(const GlRendererOptions& options)
      : waits(options.waitForCaptures),
        bytesPerFrame(options.bytesPerFrame),
        secondsPerFrame(options.secondsPerFrame),
        runner(options.runner != nullptr ? *options.runner : own) {}

  const bool waits;
  const std::size_t bytesPerFrame;
  const double secondsPerFrame;
  TaskRunner own;  // this thread alone
  ProgramCache programs;
  CaptureResidency captures;
  TaskRunner& runner;
  LiveCaptures live{captures, kCaptureBudgetBytes};
  FrameTarget target;
  LocalResidency locals;
  TextureCache textures;
  BackgroundPass background{programs, captures};
  PatchPass patchPass{programs, captures, runner};
  LocalPass localPass{programs, textures};
  FillPass fillPass{programs};
  FrameStats stats;
  GlQuery begun = GlQuery::make(), done = GlQuery::make();  // the card's clock
  double cardSeconds = 0;

  Result<FrameStats> draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);
  Status drawReady(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);
  SendLimit sendLimit() const { return {bytesPerFrame, std::max(secondsPerFrame, 0.1 * stats.totalSeconds)}; }
  Status drawAll(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                 const ViewSettings& settings);
  /// What captures show, over the background. Returns whether mirrors among the local geometry are marked.
  Result<bool> drawPatches(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                           LocalBuffers* local);
  /// Null: none is to be drawn.
  Result<LocalBuffers*> localOf(const WalkScene& scene, const ViewPlan& plan, const ViewSettings& settings);
  /// Returns whether there are any.
  Result<bool> markLocalMirrors(const WalkScene& scene, const PerspectiveView& view, LocalBuffers* local);
  Status drawAfterBackground(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                             const ViewSettings& settings, LocalBuffers* local, bool mirrorsMarked);
};

Result<FrameStats> GlRenderer::Impl::draw(const WalkScene& scene, const PerspectiveView& view,
                                          const ViewSettings& settings) {
  const Clock::time_point start = Clock::now();
  const GlStateGuard guard;
  forgetGlErrors();
  const SendLimit limit = sendLimit();
  stats = {};
  CaptureSet inScene;
  addTo(inScene, scene.captures);
  captures.begin(inScene);
  const WalkScene* ready = &scene;
  if (!waits) {
    const Result<const WalkScene*> chosen = live.choose(scene, view, settings, limit, stats);
    if (!chosen) return tl::unexpected(chosen.error());
    ready = *chosen;
  }
  CaptureSet kept = inScene;
  live.addKept(kept);
  captures.dropGone(kept);
  locals.dropGone(scene);
  textures.dropGone();
  const Status drawn = drawReady(*ready, view, settings);
  live.end();
  captures.end();
  if (!drawn) return tl::unexpected(drawn.error());
  captures.trim(kCaptureBudgetBytes);
  const Sent sent = captures.takeSent();
  stats.bytesSent = sent.bytes;
  stats.sendSeconds = sent.seconds;
  stats.totalSeconds = secondsOfDrawing(start);
  cardSeconds = secondsBetween(begun, done);
  return stats;
}

Status GlRenderer::Impl::drawReady(const WalkScene& scene, const PerspectiveView& view,
                                   const ViewSettings& settings) {
  if (settings.reconstruction != Reconstruction::patches)
    return fail(
        ErrorKind::invalidArgument,
        fmt::format("OpenGL draws patches, not {}: use a CPU renderer", nameOf(settings.reconstruction)),
        "reconstruction");
  const Result<ViewPlan> plan = planView(scene, view, settings);
  if (!plan) return tl::unexpected(plan.error());
  stats.missingImages = plan->missingImages;
  for (const PieceDraw& piece : plan->pieces)
    if (!scene.captures[std::size_t(piece.camera)]->hasPatches())
      return fail(
          ErrorKind::unsupported,
          "it has no planes of surfaces, and OpenGL draws patches alone: bake it with silhouettes, or use "
          "a CPU renderer",
          captureName(piece.camera, false));
  if (Status sized = target.resize(view.width, view.height); !sized) return sized;
  glQueryCounter(begun.name(), GL_TIMESTAMP);
  if (Status drawn = drawAll(scene, *plan, view, settings); !drawn) return drawn;
  glQueryCounter(done.name(), GL_TIMESTAMP);
  return {};
}

Status GlRenderer::Impl::drawAll(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                                 const ViewSettings& settings) {
  const Result<LocalBuffers*> local = localOf(scene, plan, settings);
  if (!local) return tl::unexpected(local.error());
  target.begin();
  const Clock::time_point start = Clock::now();
  if (Status drawn = background.draw(scene, plan, view, target); !drawn) return drawn;
  const Result<bool> mirrorsMarked = drawPatches(scene, plan, view, *local);
  if (!mirrorsMarked) return tl::unexpected(mirrorsMarked.error());
  stats.warpSeconds = secondsOfDrawing(start);
  return drawAfterBackground(scene, plan, view, settings, *local, *mirrorsMarked);
}

Result<bool> GlRenderer::Impl::drawPatches(const WalkScene& scene, const ViewPlan& plan,
                                           const PerspectiveView& view, LocalBuffers* local) {
  Result<bool> marked = plan.reflections.empty() ? false : markLocalMirrors(scene, view, local);
  if (!marked) return marked;
  if (Status drawn = patchPass.draw(scene, plan, view, *marked, target, stats); !drawn)
    return tl::unexpected(drawn.error());
  return marked;
}

Result<bool> GlRenderer::Impl::markLocalMirrors(const WalkScene& scene, const PerspectiveView& view,
                                                LocalBuffers* local) {
  if (local == nullptr || !local->mirrors || !scene.mirrors) return false;
  if (Status marked = localPass.markMirrors(scene, view, target, *local); !marked)
    return tl::unexpected(marked.error());
  return true;
}

Result<LocalBuffers*> GlRenderer::Impl::localOf(const WalkScene& scene, const ViewPlan& plan,
                                                const ViewSettings& settings) {
  const std::size_t region = std::size_t(plan.region);
  const bool any = settings.localGeometry && region < scene.local.size() && scene.local[region] &&
                   !scene.local[region]->triangles.empty() && scene.scene;
  if (!any) return nullptr;
  const Clock::time_point start = Clock::now();
  Result<LocalBuffers*> local = locals.get(scene, region);
  stats.localSeconds += secondsOfDrawing(start);
  return local;
}

Status GlRenderer::Impl::drawAfterBackground(const WalkScene& scene, const ViewPlan& plan,
                                             const PerspectiveView& view, const ViewSettings& settings,
                                             LocalBuffers* local, bool mirrorsMarked) {
  if (local != nullptr) {
    const Clock::time_point start = Clock::now();
    if (Status drawn = localPass.drawOpaque(scene, view, target, *local, mirrorsMarked); !drawn) return drawn;
    stats.localTriangles = local->triangles;
    stats.localSeconds += secondsOfDrawing(start);
  }
  if (settings.fillHoles) {
    const Clock::time_point start = Clock::now();
    const int reach = plan.missingImages > 0 ? kFillReachWhileLoading : kFillReach;
    if (Status filled = fillPass.draw(target, reach); !filled) return filled;
    stats.fillSeconds = secondsOfDrawing(start);
  }
  if (local != nullptr) {
    const Clock::time_point start = Clock::now();
    if (Status drawn = localPass.drawClear(scene, view, target, *local); !drawn) return drawn;
    stats.localSeconds += secondsOfDrawing(start);
  }
  return {};
}

GlRenderer::GlRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlRenderer::~GlRenderer() = default;

Result<std::unique_ptr<GlRenderer>> GlRenderer::create(const GlRendererOptions& options) {
  const int version = epoxy_gl_version();
  if (version < 43 || !epoxy_is_desktop_gl())
    return fail(ErrorKind::unsupported,
                fmt::format("OpenGL {}.{} is too old, at least 4.3 is needed: use a CPU renderer",
                            version / 10, version % 10),
                "OpenGL");
  if (version < 45 && !epoxy_has_gl_extension("GL_ARB_clip_control"))
    return fail(ErrorKind::unsupported,
                "this OpenGL driver lacks GL_ARB_clip_control (in every driver for OpenGL 4.5): update it or "
                "use a CPU renderer",
                "OpenGL");
  const GlStateGuard guard;
  forgetGlErrors();
  std::unique_ptr<GlRenderer> renderer(new GlRenderer(std::make_unique<Impl>(options)));
  // The variant that every walk needs: a driver that refuses our shaders says so now, not in the first frame.
  const Result<GlProgram*> program = renderer->impl_->programs.get("patch_tile.vert", "patches.frag", {});
  if (!program) return tl::unexpected(program.error());
  if (Status made = checkGl("starting"); !made) return tl::unexpected(made.error());
  return renderer;
}

Result<FrameStats> GlRenderer::draw(const WalkScene& scene, const PerspectiveView& view,
                                    const ViewSettings& settings) {
  try {
    return impl_->draw(scene, view, settings);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to hand this view to OpenGL: use smaller captures",
                "view");
  }
}

Result<bool> GlRenderer::receive() {
  const GlStateGuard guard;
  forgetGlErrors();
  SendLimit limit = impl_->sendLimit();
  return impl_->live.receive(limit);
}

bool GlRenderer::anyToReceive() const { return impl_->captures.anyToReceive(); }

void GlRenderer::stopSending() {
  impl_->captures.stop();
  impl_->live.clear();
}

double GlRenderer::cardSeconds() const { return impl_->cardSeconds; }

unsigned GlRenderer::colourTexture() const { return impl_->target.colourCodes(); }

Frame GlRenderer::readBack() const {
  const GlStateGuard guard;
  Frame frame = impl_->target.read();
  frame.stats = impl_->stats;
  return frame;
}

std::vector<std::string> GlRenderer::variants() const { return impl_->programs.variants(); }

}  // namespace acentric
