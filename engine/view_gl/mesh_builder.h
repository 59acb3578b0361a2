#pragma once
/// Builds meshes of captures on a thread of its own, one after the other, so that no frame waits for one. No
/// capture is kept in memory but the one whose mesh is being built.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/view_gl/packed_mesh.h"

namespace acentric {

class MeshBuilder {
 public:
  struct Built {
    MeshTask task;
    Result<PackedMesh> mesh;
  };

  /// On so many threads, of the usual priority: what is drawn waits for it. `wake` is called from another
  /// thread whenever a mesh is built.
  MeshBuilder(int threads, std::function<void()> wake);
  /// What is being built is given up within milliseconds.
  ~MeshBuilder();
  MeshBuilder(const MeshBuilder&) = delete;
  MeshBuilder& operator=(const MeshBuilder&) = delete;

  /// What is to be built, the first first, instead of what was: what has begun goes on.
  void want(std::vector<MeshTask> tasks);
  /// Gives up what is not `useful`, begun and built too.
  void keepOnly(const std::function<bool(const MeshTask&)>& useful);
  /// What is built, once.
  std::vector<Built> takeBuilt();
  bool anyBuilt() const;

 private:
  void loop(const std::stop_token& stop);
  /// The next, with its capture; its `cancel_` is new. Nothing when stopped.
  std::optional<MeshTask> next(const std::stop_token& stop, std::shared_ptr<const DisplayCapture>& capture,
                               std::stop_token& cancelled);

  const int threads_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<MeshTask> waiting_;
  std::optional<MeshTask> running_;
  std::stop_source cancel_;  ///< of running_
  std::vector<Built> built_;
  std::jthread thread_;
};

}  // namespace acentric
