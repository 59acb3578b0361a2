#pragma once
/// Renders the walk on a thread of its own, so that a slow frame never holds up the window: the newest
/// request wins.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

struct WalkRequest {
  std::shared_ptr<const LoadedWalk> loaded;
  PerspectiveView view;
  ViewSettings settings;
  double scale = 1;  ///< of the full resolution, for the adaptation
};

/// Does a picture of this view read the very same parts of both? What comes and goes while a walk is loaded
/// is mostly for other places.
bool rendersTheSame(const WalkScene& a, const WalkScene& b, const PerspectiveView& view,
                    const ViewSettings& settings);

struct WalkPicture {
  WalkRequest request;
  Frame frame;          ///< empty if it failed
  std::string problem;  ///< one line for a person, else empty
};

class WalkRenderer {
 public:
  /// `wake` is called from the render thread when a picture is ready.
  WalkRenderer(int threads, std::function<void()> wake);
  ~WalkRenderer();
  WalkRenderer(const WalkRenderer&) = delete;
  WalkRenderer& operator=(const WalkRenderer&) = delete;

  void request(WalkRequest request);
  /// The newest finished picture, once.
  std::optional<WalkPicture> take();
  /// A later picture is made in the memory of a frame that is no longer needed.
  void recycle(Frame frame);
  /// A request is waiting or being rendered.
  bool busy() const;

 private:
  void loop(const std::stop_token& stop);

  int threads_;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<WalkRequest> waiting_;
  std::optional<WalkPicture> finished_;
  Frame spare_;
  bool rendering_ = false;
  std::jthread thread_;
};

}  // namespace acentric::editor
