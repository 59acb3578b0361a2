#include "engine/pipeline/walk_stream.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <new>

#include "engine/base/contract.h"
#include "engine/base/physical_memory.h"
#include "engine/base/priority.h"
#include "engine/base/stopwatch.h"
#include "engine/geometry/conventions.h"
#include "engine/image/coarse_capture.h"
#include "engine/pipeline/counted_capture.h"

namespace acentric {
namespace {

/// A frame in the making gives back what was evicted meanwhile; a loader waits for it no longer than this.
constexpr auto kLongestFrame = std::chrono::milliseconds(100);
/// How often snapshots that frames no longer use are looked for.
constexpr auto kSweep = std::chrono::milliseconds(30);
/// Of reading local geometry, which is often quick, until it is shown.
constexpr double kBatchSeconds = 0.05;

/// Is it far enough from where the loaders last looked to look again?
bool moved(const Whereabouts& from, const Whereabouts& to, double cellSize) {
  const double turned = std::abs(std::remainder(to.yawRadians - from.yawRadians, kTwoPi));
  const auto heading = [](const glm::dvec2& v) { return v == glm::dvec2(0) ? v : glm::normalize(v); };
  return glm::distance(from.eye, to.eye) > 0.02 * cellSize || turned > radians(10.0) ||
         glm::distance(heading(from.velocity), heading(to.velocity)) > 0.3;
}

}  // namespace

std::size_t usualWalkMemory() { return physicalMemory() / 2; }

WalkStream::WalkStream(WalkStart start, WalkStreamOptions options)
    : source_(std::move(start.source)),
      options_(std::move(options)),
      needs_(regionNeeds(*start.walk.walk.layout, options_.panoramas)),
      held_(start.walk.captureMemory),
      now_(std::move(start.walk)),
      where_(options_.where) {
  const std::size_t cameras = now_.walk.captures.size();
  for (Tier& t : tiers_) {
    t.bytes.assign(cameras, 0);
    t.residence.assign(cameras, Residence::absent);
    t.lastUse.assign(cameras, 0);
    t.captures.resize(cameras);
    t.measured.assign(cameras, 0);
    t.made.assign(cameras, 0);
    t.madeBytes.assign(cameras, 0);
  }
  guessBytes();
  for (std::size_t c = 0; c < cameras; ++c)
    if (now_.walk.captures[c]) insert(Detail::full, int(c), now_.walk.captures[c], false);
  guessBytes();
  for (std::size_t c = 0; c < start.coarse.size(); ++c)
    if (start.coarse[c] && !(allFit_ && now_.walk.captures[c]))
      insert(Detail::coarse, int(c), std::move(start.coarse[c]),
             source_->storedBytes(int(c), Detail::coarse) == 0);
  locals_.assign(now_.walk.local.size(), Residence::absent);
  for (std::size_t r = 0; r < locals_.size(); ++r)
    if (now_.walk.local[r]) locals_[r] = Residence::resident;
  snapshot_ = std::make_shared<const LoadedWalk>(now_);
  follow();
  const std::size_t loaders = options_.threads > 0 ? std::size_t(options_.threads) + 1 : 0;
  idleAt_.assign(loaders, 0);
  for (std::size_t i = 0; i < loaders; ++i)
    loaders_.emplace_back([this, i, loaders](const std::stop_token& stop) {
      loaderLoop(i + 1 < loaders ? Duty::needed : Duty::ahead, idleAt_[i], stop);
    });
}

WalkStream::~WalkStream() {
  for (auto& loader : loaders_) loader.request_stop();
  loaders_.clear();
}

void WalkStream::go(const Whereabouts& where) {
  {
    const std::lock_guard lock(wake_);
    if (!moved(where_, where, now_.walk.layout->spec.cellSize)) return;
    where_ = where;
    ++calls_;
  }
  woken_.notify_all();
}

std::shared_ptr<const LoadedWalk> WalkStream::walk() const {
  const std::lock_guard lock(published_);
  return snapshot_;
}

std::vector<std::string> WalkStream::takeWarnings() {
  const std::lock_guard lock(state_);
  return std::exchange(warnings_, {});
}

bool WalkStream::busy() const {
  const std::lock_guard lock(wake_);
  return std::ranges::any_of(idleAt_, [this](std::uint64_t call) { return call != calls_; });
}

WalkStreamStats WalkStream::stats() const {
  const std::lock_guard lock(state_);
  WalkStreamStats stats = counts_;
  stats.limitBytes = options_.memoryBytes;
  stats.bytes = held_->held();
  stats.peakBytes = held_->peak();
  for (std::size_t c = 0; c < now_.walk.captures.size(); ++c)
    if (now_.walk.captures[c]) ++(now_.standsIn[c] ? stats.coarse : stats.full);
  return stats;
}

WalkStream::Held WalkStream::held() const {
  const std::lock_guard lock(state_);
  return {tier(Detail::full).captures, tier(Detail::coarse).captures, now_.walk.local};
}

// The loaders
// ------------------------------------------------------------------------------------------------------------

void WalkStream::loaderLoop(Duty duty, std::uint64_t& idleAt, const std::stop_token& stop) {
  if (duty == Duty::ahead) lowerThreadPriority();  // frames come first
  while (!stop.stop_requested()) {
    std::uint64_t seen = 0;
    {
      const std::lock_guard lock(wake_);
      seen = calls_;
    }
    clearUnused();
    bool retired = false;
    std::optional<Task> task;
    {
      const std::lock_guard lock(state_);
      task = next(duty);
      retired = !retired_.empty();
    }
    if (task) {
      waitForRoom(*task, stop);
      Read result = read(*task, stop);
      if (stop.stop_requested()) return;
      finish(*task, std::move(result));
      continue;
    }
    std::unique_lock lock(wake_);
    idleAt = seen;
    const auto called = [&] { return calls_ != seen; };
    while (!stop.stop_requested() && !called()) {
      if (!retired) {
        (void)woken_.wait(lock, stop, called);
      } else if (!woken_.wait_for(lock, stop, kSweep, called)) {
        lock.unlock();
        retired = clearUnused();
        lock.lock();
      }
    }
  }
}

/// Evicted captures are gone when the frames that use them are done.
void WalkStream::waitForRoom(const Task& task, const std::stop_token& stop) {
  if (task.what != Task::What::full) return;
  const auto until = std::chrono::steady_clock::now() + kLongestFrame;
  while (!stop.stop_requested() && std::chrono::steady_clock::now() < until) {
    clearUnused();
    {
      const std::lock_guard lock(state_);
      const std::size_t held = held_->held();
      if (held + tier(Detail::full).bytes[std::size_t(task.camera)] <= options_.memoryBytes) return;
      std::size_t known = 0;
      for (const Tier& t : tiers_)
        for (std::size_t c = 0; c < t.bytes.size(); ++c)
          if (t.captures[c]) known += t.bytes[c];
      if (held <= known) return;  // nothing is on its way out
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

WalkStream::Read WalkStream::read(const Task& task, const std::stop_token& stop) const {
  Read result;
  if (task.what == Task::What::local) {
    const Stopwatch watch;
    for (std::size_t r = 0; r < task.regions.size() && (r == 0 || watch.seconds() < kBatchSeconds); ++r)
      result.locals.push_back(source_->local(task.regions[r], stop));
    return result;
  }
  const Detail detail = task.what == Task::What::coarse ? Detail::coarse : Detail::full;
  const auto capture = source_->capture(task.camera, detail);
  if (!capture) {
    result.error = capture.error();
    return result;
  }
  try {
    const auto prepared = [&](const Capture& from) {
      return counted(std::make_shared<const DisplayCapture>(prepareForDisplay(from, now_.walk.exposure)),
                     held_);
    };
    if (task.what == Task::What::coarse) result.coarse = prepared(*capture);
    if (task.what == Task::What::full) result.full = prepared(*capture);
    if (task.standIn) result.coarse = prepared(coarsened(*capture, kCoarseFactor));
  } catch (const std::bad_alloc&) {
    result = {};
    result.error = Error{ErrorKind::outOfSpace,
                         "not enough memory for a capture: give the walk a lower limit of memory", "walk"};
  }
  return result;
}

void WalkStream::finish(const Task& task, Read result) {
  {
    const std::lock_guard lock(state_);
    const auto i = std::size_t(task.camera);
    if (task.what == Task::What::local) {
      for (std::size_t r = 0; r < task.regions.size(); ++r)
        insertLocal(task.regions[r], r < result.locals.size() ? std::move(result.locals[r]) : LocalPart());
    } else if (result.error) {
      // It is not asked for again.
      warnings_.push_back(result.error->describe());
      const bool coarse = task.what == Task::What::coarse;
      Tier& asked = tier(coarse ? Detail::coarse : Detail::full);
      asked.bytes[i] = 0;
      asked.measured[i] = 1;
      asked.residence[i] = Residence::absent;
      if (task.what == Task::What::sketch) tier(Detail::coarse).residence[i] = Residence::absent;
      if (!coarse) ++now_.missing;
    } else {
      if (result.coarse)
        insert(Detail::coarse, task.camera, std::move(result.coarse), task.what != Task::What::coarse);
      if (result.full) {
        insert(Detail::full, task.camera, std::move(result.full), false);
        if (allFit_ && tier(Detail::coarse).captures[i])
          drop(Detail::coarse, task.camera);  // not needed again
      }
      ++(task.what == Task::What::full ? counts_.loads : counts_.coarseLoads);
      guessBytes();
    }
    if (options_.threads > 0) publish();
  }
  {
    const std::lock_guard lock(wake_);
    ++calls_;
  }
  woken_.notify_all();
}

/// Without geometry: it was not read, and is asked for again.
void WalkStream::insertLocal(int region, LocalPart part) {
  const auto r = std::size_t(region);
  locals_[r] = part.geometry ? Residence::resident : Residence::absent;
  now_.walk.local[r] = std::move(part.geometry);
  if (part.simplified) {
    now_.simplified.push_back(*part.simplified);
    std::ranges::sort(now_.simplified, {}, &LoadedWalk::Simplified::region);
  }
  std::ranges::move(part.warnings, std::back_inserter(warnings_));
}

void WalkStream::publish() {
  auto next = std::make_shared<const LoadedWalk>(now_);
  {
    const std::lock_guard lock(published_);
    std::swap(snapshot_, next);
  }
  retired_.push_back(std::move(next));
  if (options_.wake) options_.wake();
}

bool WalkStream::clearUnused() {
  std::vector<WalkPtr> cleared;  // when the lock is given back
  const std::lock_guard lock(state_);
  const auto unused = std::partition(retired_.begin(), retired_.end(),
                                     [](const WalkPtr& walk) { return walk.use_count() > 1; });
  std::move(unused, retired_.end(), std::back_inserter(cleared));
  retired_.erase(unused, retired_.end());
  return !retired_.empty();
}

// Without threads
// ------------------------------------------------------------------------------------------------------------

Status WalkStream::complete(std::span<const int> cameras, std::span<const int> regions, TaskRunner& runner,
                            const Progress& progress, const std::stop_token& stop) {
  require(options_.threads == 0, "a stream that reads ahead is not told what to read");
  std::vector<double> distance(now_.walk.captures.size(), std::numeric_limits<double>::infinity());
  for (const int camera : cameras) {
    distance[std::size_t(camera)] = -1;
    for (Tier& t : tiers_) t.lastUse[std::size_t(camera)] = ++uses_;
  }
  const auto evictions = counts_.evictions;
  std::vector<Task> tasks;
  const auto takeSteps = [&](Detail detail) {
    const ResidencyPlan planned = plan(detail, distance, std::numeric_limits<std::size_t>::max());
    evict(detail, planned.evict);
    for (const ResidencyPlan::Step& step : planned.steps) {
      evict(detail, step.evict);
      tasks.push_back({detail == Detail::full ? Task::What::full : Task::What::coarse, step.load, false, {}});
    }
    return planned.beyondLimit;
  };
  counts_.beyondLimit = takeSteps(Detail::full);
  for (const int region : regions)
    if (locals_[std::size_t(region)] == Residence::absent)
      tasks.push_back({Task::What::local, -1, false, {region}});
  std::mutex counting;
  double done = 0;
  const auto run = [&] {
    if (tasks.empty()) return;
    {  // what was evicted goes before more is read
      const std::lock_guard lock(published_);
      snapshot_.reset();
    }
    retired_.clear();
    runner.parallelFor(tasks.size(), [&](std::size_t n) {
      if (stop.stop_requested()) return;
      finish(tasks[n], read(tasks[n], stop));
      const std::lock_guard lock(counting);
      if (progress) progress({++done, double(tasks.size()), "loading captures"});
    });
    tasks.clear();
  };
  run();
  for (std::size_t c = 0; c < distance.size(); ++c)  // for coarse ones only where nothing else is to be had
    if (now_.walk.captures[c] != nullptr || tier(Detail::full).bytes[c] > 0)
      distance[c] = std::numeric_limits<double>::infinity();
  takeSteps(Detail::coarse);
  run();
  if (snapshot_ == nullptr || counts_.evictions != evictions) publish();  // else all was there
  retired_.clear();
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "loading was cancelled", "walk");
  return {};
}

}  // namespace acentric
