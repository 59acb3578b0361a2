#pragma once
/// Reads parts of a bundle on threads of its own, so that whoever draws frames never waits for a file.

#include <compare>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <variant>

#include "engine/export/bundle_model.h"

namespace acentric {

struct LoadJob {
  bool model = false;  ///< to be drawn by others; else what BundlePlayer keeps
  bool region = false;
  std::size_t storey = 0, number = 0;  ///< of the camera or region, in the storey
  Loaded detail = Loaded::full;        ///< of a capture
  int texturePixels = 0;               ///< of a model
  auto operator<=>(const LoadJob&) const = default;
};

using LoadedPart = std::variant<CapturePtr, ReadRegion, DrawModel>;

struct Arrival {
  LoadJob job;
  Result<LoadedPart> part;
};

/// Used by one thread.
class BackgroundLoader {
 public:
  /// Files may be asked from several threads at once. `textures`: how many the bundle has.
  BackgroundLoader(std::size_t textures, int threads);
  /// Waits for what is being read; nothing is asked of the files afterwards.
  ~BackgroundLoader();

  /// These in this order, all of one place, in place of those of the last call that were not begun. What is
  /// being read, or has arrived and was not taken, is not read again.
  void ask(BundlePlacePtr place, std::vector<LoadJob> jobs);
  /// Done once, before what was asked for and not begun, in place of the last such call's where that was not
  /// begun. Nobody is told of it.
  void doAside(std::function<void()> work);
  /// The first that has arrived of those that `chosen` takes.
  std::optional<Arrival> take(const std::function<bool(const LoadJob&)>& chosen);
  /// Jobs that were asked for, and have not been taken.
  std::size_t waiting() const;

 private:
  void work(const std::stop_token& stop);
  Result<LoadedPart> load(const BundlePlacePtr& place, const LoadJob& job, const std::stop_token& stop);
  Images knownImages();
  void remember(const Images& images);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  BundlePlacePtr place_;  ///< of jobs_
  std::deque<LoadJob> jobs_;
  std::function<void()> aside_;
  std::set<LoadJob> begun_;  ///< and not taken
  std::deque<Arrival> arrived_;
  std::vector<std::weak_ptr<const ColourImage>> images_;  ///< by texture: those that someone still has
  std::vector<std::jthread> threads_;
};

}  // namespace acentric
