#pragma once
/// A walk whose captures come and go while it is being walked: read in the background, what is nearest to the
/// eye first (residency.h), within a limit of memory. Frames are drawn from the newest snapshot, which is
/// complete in itself and never changes; to take it nobody waits for the disk, nor for planning.
///
/// Where a capture is not in memory its coarse rendition stands in: the preview of the store or, where memory
/// does not hold all captures and there is no preview, one made of the capture when it was read. Coarse
/// renditions have up to a quarter of the memory. A capture that cannot be read is told of once, and its
/// coarse one stays.
///
/// The limit is for captures ready to be drawn; where those of the eye's region alone take more, they are
/// loaded all the same, and the statistics say so. A frame in the making keeps what was evicted meanwhile for
/// a moment more. Beside that each thread that reads a capture takes about three times its size, and local
/// geometry, which stays, what the scene's triangles call for.

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/base/memory_budget.h"
#include "engine/pipeline/residency.h"
#include "engine/pipeline/walk_source.h"

namespace acentric {

/// Half of the machine's memory.
std::size_t usualWalkMemory();

struct WalkStreamOptions {
  std::size_t memoryBytes = usualWalkMemory();
  /// That read what the eye's region needs; one more reads ahead, and gives way to all others. 0 = none:
  /// nothing is read but by `complete`.
  int threads = 1;
  Whereabouts where;      ///< at first
  bool panoramas = true;  ///< read those that fill what a cover leaves open too
  /// Called from another thread whenever there is a new snapshot.
  std::function<void()> wake;
};

struct WalkStreamStats {
  std::size_t limitBytes = 0;
  std::size_t bytes = 0;        ///< of captures in memory, evicted ones too while a frame still uses them
  std::size_t peakBytes = 0;    ///< the most there were
  std::size_t beyondLimit = 0;  ///< that the captures of the eye's region alone take above the limit
  int full = 0, coarse = 0;     ///< cameras that are in memory as they are, and that something stands in for
  int loads = 0, coarseLoads = 0, evictions = 0;
};

class WalkStream {
 public:
  WalkStream(WalkStart start, WalkStreamOptions options);
  /// Waits for what is being read, no longer.
  ~WalkStream();
  WalkStream(const WalkStream&) = delete;
  WalkStream& operator=(const WalkStream&) = delete;

  /// Where the eye is now. Cheap: to be called with each frame.
  void go(const Whereabouts& where);
  /// The newest snapshot. Its warnings are those of the start; later ones are `takeWarnings`.
  std::shared_ptr<const LoadedWalk> walk() const;
  /// What could not be read since the last call, each told once.
  std::vector<std::string> takeWarnings();
  /// Is there still something to be read for where the eye is?
  bool busy() const;
  WalkStreamStats stats() const;

  /// What is in memory now, for a stream that takes its place.
  struct Held {
    std::vector<std::shared_ptr<const DisplayCapture>> full, coarse;  ///< by camera
    std::vector<std::shared_ptr<const LocalGeometry>> local;          ///< by region
  };
  Held held() const;

  /// Reads what is missing of these in full, on the runner's threads, and returns when the newest snapshot
  /// has it: whoever holds an older one holds what is evicted, too. Only of a stream without threads of its
  /// own. Fails only when stopped.
  Status complete(std::span<const int> cameras, std::span<const int> regions, TaskRunner& runner,
                  const Progress& progress = {}, const std::stop_token& stop = {});

 private:
  using CapturePtr = std::shared_ptr<const DisplayCapture>;
  using WalkPtr = std::shared_ptr<const LoadedWalk>;
  struct Tier {
    std::vector<std::size_t> bytes;  ///< that each takes or is expected to; 0 = not to be had
    std::vector<Residence> residence;
    std::vector<std::uint64_t> lastUse;
    std::vector<CapturePtr> captures;
    std::vector<char> measured;          ///< `bytes` is no longer a guess
    std::vector<char> made;              ///< not from a file
    std::vector<std::size_t> madeBytes;  ///< what it took when it was made last
  };
  struct Task {
    enum class What { full, coarse, local, sketch } what = What::full;
    int camera = -1;
    bool standIn = false;      ///< make a coarse rendition of the full one
    std::vector<int> regions;  ///< of `local`, as many as are read before the next snapshot; nearest first
  };
  struct Read {
    CapturePtr full, coarse;
    std::vector<LocalPart> locals;  ///< of the first regions
    std::optional<Error> error;
  };

  /// What is needed now has threads of its own: reading it must not wait for the processor as long as what is
  /// read ahead may.
  enum class Duty { needed, ahead };
  void loaderLoop(Duty duty, std::uint64_t& idleAt, const std::stop_token& stop);
  std::optional<Task> next(Duty duty);
  std::optional<Task> nextSketch() const;
  std::vector<int> nextLocals(double within) const;
  ResidencyPlan plan(Detail detail, std::span<const double> distance, std::size_t mostSteps) const;
  void evict(Detail detail, std::span<const int> cameras);
  void drop(Detail detail, int camera);
  void begin(const Task& task);
  Read read(const Task& task, const std::stop_token& stop) const;
  void finish(const Task& task, Read read);
  void insert(Detail detail, int camera, CapturePtr capture, bool made);
  void insertLocal(int region, LocalPart part);
  void follow();
  void guessBytes();
  void show(int camera);
  void publish();
  bool clearUnused();
  void waitForRoom(const Task& task, const std::stop_token& stop);
  Tier& tier(Detail detail) { return tiers_[detail == Detail::full ? 1 : 0]; }
  const Tier& tier(Detail detail) const { return tiers_[detail == Detail::full ? 1 : 0]; }
  std::size_t taken(Detail detail) const;
  std::size_t limitOf(Detail detail) const;

  const std::shared_ptr<const WalkSource> source_;
  const WalkStreamOptions options_;
  const RegionNeeds needs_;
  const std::shared_ptr<MemoryBudget> held_;

  // What the loaders work on. No frame ever waits for this one.
  mutable std::mutex state_;
  LoadedWalk now_;
  Tier tiers_[2];
  std::vector<Residence> locals_;
  std::vector<std::string> warnings_;
  WalkDistances distances_;
  std::uint64_t uses_ = 0;
  double bytesPerStored_ = 1.5;  ///< in memory for each on disk: a guess until the first was read
  std::size_t readStored_ = 0, readBytes_ = 0;
  bool allFit_ = true;
  std::size_t coarseBytes_ = 0;  ///< kept free for coarse renditions where not all captures fit
  WalkStreamStats counts_;
  std::vector<WalkPtr> retired_;  ///< snapshots that a frame may still use: not for it to clear away

  mutable std::mutex published_;  // held for as long as it takes to copy a pointer
  WalkPtr snapshot_;

  mutable std::mutex wake_;  // the same
  std::condition_variable_any woken_;
  Whereabouts where_;                  // as the loaders were told
  std::uint64_t calls_ = 1;            ///< one for each thing that may give loaders something to do
  std::vector<std::uint64_t> idleAt_;  ///< the last call at which each loader found nothing to do

  std::vector<std::jthread> loaders_;  // last: they are joined first
};

}  // namespace acentric
