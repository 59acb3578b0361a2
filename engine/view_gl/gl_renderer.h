#pragma once
/// The contract of view/render.h on OpenGL (core 4.3). Needs only a current context; captures stay resident
/// as buffers. Draws the pieces of the same ViewPlan as patches, front to back, then local geometry with a
/// depth test.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/task_runner.h"
#include "engine/geometry/perspective_view.h"
#include "engine/view/frame.h"
#include "engine/view/view_settings.h"
#include "engine/view/walk_scene.h"

namespace acentric {

struct GlRendererOptions {
  /// Does a frame wait until all that it lacks is on the graphics card? Otherwise no frame does: captures are
  /// sent piece by piece. Until a capture is there its camera shows what it had
  /// before (the coarse copy, say) or, without that, counts as missing.
  bool waitForCaptures = true;
  TaskRunner* runner = nullptr;  ///< plans patches; outlives the renderer; null: this thread
  std::size_t bytesPerFrame = std::size_t(32) << 20;  ///< sent at most by a frame that does not wait
  /// It sends no longer than this, or than a tenth of what the frame before it took; a megabyte always.
  double secondsPerFrame = 0.004;
};

class GlRenderer {
 public:
  /// With the context current, as in every call and for destruction. Compiles the shaders that every walk
  /// needs; the others when first used.
  static Result<std::unique_ptr<GlRenderer>> create(const GlRendererOptions& options = {});
  ~GlRenderer();
  GlRenderer(const GlRenderer&) = delete;
  GlRenderer& operator=(const GlRenderer&) = delete;

  /// Draws into the renderer's own framebuffer (view.width x view.height). Sends what this view needs and is
  /// not resident yet, or a piece of it; drops what is gone from `scene`. The context's state is left as it
  /// was, whatever it was. Fails where settings or captures ask for other than patches. Waits until all is
  /// drawn, so that the times in the statistics are true; samplesDrawn counts those submitted.
  Result<FrameStats> draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings);
  /// Sends a piece of what frames lacked, as each draw does. True if a picture drawn now would show something
  /// that the last could not.
  Result<bool> receive();
  /// Is there more for receive() to do at once?
  bool anyToReceive() const;
  /// For when other renderers draw: what is on its way is given up until the next draw.
  void stopSending();
  /// Seconds from the first to the last command of the last draw by the graphics card's own clock; 0 before
  /// it.
  double cardSeconds() const;
  /// Colour texture of the last draw, row 0 at the bottom (OpenGL), for showing in a window.
  unsigned colourTexture() const;
  /// Reads the last draw back, with sources; slow.
  Frame readBack() const;
  /// Shader variants compiled so far, one line each: files, then the effects compiled in.
  std::vector<std::string> variants() const;

 private:
  struct Impl;
  explicit GlRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A surfaceless EGL context made current on this thread while it lives, for programs without a window: on a
/// graphics card where there is one, else on a software driver.
class HeadlessContext {
 public:
  static Result<std::unique_ptr<HeadlessContext>> create();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;
  std::string description() const;  ///< renderer and version strings

 private:
  HeadlessContext() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace acentric
