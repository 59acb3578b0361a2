#pragma once
/// Preview pictures (engine/bake/preview.h) of a camera that moves, traced on a thread of their own so that
/// they never hold up the window: of fewer pixels while it moves and at first, whole once it rests. A whole
/// picture is given up as soon as another is wanted. All but the tracing belongs to the main thread.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "editor/session/adaptive_resolution.h"
#include "engine/bake/preview.h"

namespace acentric::editor {

/// A capture camera with its columns: as many as the whole picture has pixels.
struct PreviewCapture {
  LayoutCamera camera;
  ColumnCamera columns;
};

struct PreviewWanted {
  PreviewTracerPtr tracer;
  std::variant<PerspectiveView, PreviewCapture> camera;  ///< of the whole picture
  double cutHeight = kNoCut;                             ///< of views; world z, metres
};
/// Do they show the same, with the same number of pixels?
bool same(const PreviewWanted& a, const PreviewWanted& b);
/// With `scale` times as many pixels each way, at least 1.
PreviewWanted scaled(const PreviewWanted& wanted, double scale);

struct PreviewShown {
  PreviewWanted whole;   ///< what was wanted
  PreviewWanted traced;  ///< what the picture is of
  double scale = 1;
  double seconds = 0;  ///< that it took
  PreviewPicture picture;
};

class PreviewStream {
 public:
  static constexpr double kFirstScale = 0.25;
  static constexpr double kFirstWait = 0.02;  ///< seconds that a frame may wait for the first picture

  /// `wake` is called from the tracing thread when a picture is ready.
  PreviewStream(int threads, std::function<void()> wake);
  ~PreviewStream();
  PreviewStream(const PreviewStream&) = delete;
  PreviewStream& operator=(const PreviewStream&) = delete;

  /// Asks for what is still to be traced of it. Called each frame.
  void want(const PreviewWanted& wanted);
  /// Takes over what was traced; true if there is something new.
  bool take();
  /// The same, after waiting for what is being traced, no longer than so many seconds.
  bool takeWithin(double seconds);
  /// The newest picture; null until there is one.
  const PreviewShown* shown() const { return shown_ ? &*shown_ : nullptr; }
  /// Something is being traced or waits for it.
  bool busy() const { return asked_.has_value(); }
  void clear();

 private:
  struct Asked {
    PreviewWanted whole;
    double scale = 1;
    std::stop_source stop;
  };
  std::optional<double> nextScale(const PreviewWanted& wanted) const;
  void ask(const PreviewWanted& wanted, double scale);
  void loop(const std::stop_token& stop);

  std::optional<PreviewShown> shown_;
  std::optional<Asked> asked_;  // and not yet taken
  AdaptiveResolution resolution_;

  int threads_;
  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::condition_variable ready_;
  std::optional<Asked> waiting_;
  std::optional<PreviewShown> finished_;  // its picture is empty where it was given up
  std::jthread thread_;
};

}  // namespace acentric::editor
