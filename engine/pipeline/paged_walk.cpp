#include "engine/pipeline/paged_walk.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "engine/base/stopwatch.h"

namespace acentric {
namespace {

/// Of a cell: so far the eye goes before its region is looked up.
constexpr double kLookAgain = 0.02;

template <class Thing>
std::map<int, std::size_t> byNumber(const std::vector<Thing>& things) {
  std::map<int, std::size_t> places;
  for (std::size_t i = 0; i < things.size(); ++i) places.emplace(things[i].id.i, i);
  return places;
}

/// What the page before has in memory and this one has too.
struct TakenOver {
  int dropped = 0;  ///< captures of the page before that this one has not
};
TakenOver takeOver(const LoadedWalk& from, WalkStream::Held held, WalkStart& start) {
  TakenOver taken;
  LoadedWalk& to = start.walk;
  to.captureMemory = from.captureMemory;
  start.coarse.resize(to.walk.captures.size());
  const auto cameras = byNumber(to.walk.layout->cameras), regions = byNumber(to.walk.layout->regions);
  for (std::size_t c = 0; c < held.full.size(); ++c) {
    const auto found = cameras.find(from.walk.layout->cameras[c].id.i);
    if (found == cameras.end()) {
      taken.dropped += (held.full[c] ? 1 : 0) + (held.coarse[c] ? 1 : 0);
      continue;
    }
    to.walk.captures[found->second] = std::move(held.full[c]);
    start.coarse[found->second] = std::move(held.coarse[c]);
  }
  for (std::size_t r = 0; r < held.local.size(); ++r)
    if (const auto found = regions.find(from.walk.layout->regions[r].id.i); found != regions.end())
      to.walk.local[found->second] = std::move(held.local[r]);
  return taken;
}

void add(WalkStreamStats& sum, const WalkStreamStats& counts) {
  sum.loads += counts.loads, sum.coarseLoads += counts.coarseLoads, sum.evictions += counts.evictions;
  sum.beyondLimit = std::max(sum.beyondLimit, counts.beyondLimit);
}

}  // namespace

PagedWalk::PagedWalk(std::unique_ptr<WalkPages> pages, std::size_t storey, std::filesystem::path file,
                     WalkStreamOptions options)
    : pages_(std::move(pages)),
      storey_(storey),
      file_(std::move(file)),
      options_(std::move(options)),
      where_(options_.where),
      told_(options_.where.eye) {}

Result<std::unique_ptr<PagedWalk>> PagedWalk::open(std::unique_ptr<WalkPages> pages, std::size_t storey,
                                                   const std::filesystem::path& file,
                                                   WalkStreamOptions options, TaskRunner& runner) {
  std::unique_ptr<PagedWalk> walk(new PagedWalk(std::move(pages), storey, file, std::move(options)));
  const auto place = walk->pages_->placeAt(storey, walk->where_.eye);
  if (!place) return tl::unexpected(place.error());
  auto shipped = shippedPlace(**place, file, nullptr, runner);
  if (!shipped) return tl::unexpected(shipped.error());
  walk->warnings_ = (*shipped)->warnings;
  WalkStreamOptions streaming = walk->options_;
  auto stream = std::make_shared<WalkStream>(startWalk(*shipped, int(storey), nullptr), std::move(streaming));
  walk->at_ = {*place, std::move(*shipped), std::move(stream)};
  PagedWalk& self = *walk;
  walk->follower_ = std::jthread([&self](const std::stop_token& stop) { self.follow(stop); });
  return walk;
}

PagedWalk::~PagedWalk() {
  follower_.request_stop();
  moved_.notify_all();
}

std::shared_ptr<WalkStream> PagedWalk::stream() const {
  const std::lock_guard lock(mutex_);
  return at_.stream;
}

void PagedWalk::go(const Whereabouts& where) {
  bool look = false;
  {
    const std::lock_guard lock(mutex_);
    at_.stream->go(where);
    where_ = where;
    look = glm::distance(where.eye, told_) > kLookAgain * at_.walk->layouts[storey_]->spec.cellSize;
    if (look) told_ = where.eye, ++calls_;
  }
  if (look) moved_.notify_all();
}

std::shared_ptr<const LoadedWalk> PagedWalk::walk() const {
  const std::lock_guard lock(mutex_);
  return at_.stream->walk();
}

std::vector<std::string> PagedWalk::takeWarnings() {
  auto fresh = stream()->takeWarnings();
  const std::lock_guard lock(mutex_);
  std::ranges::move(fresh, std::back_inserter(warnings_));
  std::vector<std::string> told;
  for (std::string& warning : warnings_)  // what is damaged is damaged in each page that has it
    if (known_.insert(warning).second) told.push_back(std::move(warning));
  warnings_.clear();
  return told;
}

bool PagedWalk::busy() const {
  std::shared_ptr<WalkStream> stream;
  {
    const std::lock_guard lock(mutex_);
    if (seen_ != calls_) return true;
    stream = at_.stream;
  }
  return stream->busy();
}

PagedWalkStats PagedWalk::stats() const {
  PagedWalkStats stats;
  std::shared_ptr<WalkStream> stream;
  {
    const std::lock_guard lock(mutex_);
    stream = at_.stream;
    stats.captures = before_;
    stats.changes = changes_, stats.longestChange = longestChange_;
    stats.regions = at_.place->regions.size(), stats.cameras = at_.place->cameras.size();
  }
  WalkStreamStats now = stream->stats();
  add(now, stats.captures);
  stats.captures = now;
  stats.index = pages_->stats();
  return stats;
}

// The thread that follows the eye
// ------------------------------------------------------------------------------------------------------------

bool PagedWalk::isOwn(const Place& at, const glm::dvec2& eye) const {
  const Layout& layout = *at.walk->layouts[storey_];
  const auto region = layout.regionAt(eye);
  return region && at.place->own[std::size_t(*region)] != 0;
}

Result<PagedWalk::Place> PagedWalk::enter(const WalkPlacePtr& place, const Place* from,
                                          const Whereabouts& where, const std::stop_token& stop) {
  TaskRunner alone(0);
  auto walk = shippedPlace(*place, file_, from->walk.get(), alone, stop);
  if (!walk) return tl::unexpected(walk.error());
  WalkStart start = startWalk(*walk, int(storey_), nullptr);
  const TakenOver taken = takeOver(*from->stream->walk(), from->stream->held(), start);
  WalkStreamOptions streaming = options_;
  streaming.where = where;
  auto stream = std::make_shared<WalkStream>(std::move(start), std::move(streaming));
  {
    const std::lock_guard lock(mutex_);
    before_.evictions += taken.dropped;
  }
  return Place{place, std::move(*walk), std::move(stream)};
}

/// The stream of the page before ends here, in this thread: it has perhaps a capture to read to its end.
void PagedWalk::replace(Place next) {
  {
    const std::lock_guard lock(mutex_);
    std::swap(at_, next);
    at_.stream->go(where_);
    ++changes_;
  }
  if (options_.wake) options_.wake();
  const WalkStreamStats counts = next.stream->stats();
  auto late = next.stream->takeWarnings();
  while (next.stream.use_count() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  next = {};
  const std::lock_guard lock(mutex_);
  add(before_, counts);
  std::ranges::move(late, std::back_inserter(warnings_));
}

void PagedWalk::follow(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Whereabouts where;
    Place at;
    std::uint64_t calls = 0;
    {
      std::unique_lock lock(mutex_);
      (void)moved_.wait(lock, stop, [&] { return calls_ != seen_; });
      if (stop.stop_requested()) return;
      where = where_, at = at_, calls = calls_;
    }
    if (!isOwn(at, where.eye)) {
      const Stopwatch clock;
      auto place = pages_->placeAt(storey_, where.eye);
      if (place && (*place)->page != at.place->page) {
        auto next = enter(*place, &at, where, stop);
        if (next) {
          at = {};
          replace(std::move(*next));
          const std::lock_guard lock(mutex_);
          longestChange_ = std::max(longestChange_, clock.seconds());
        } else {
          place = tl::unexpected(next.error());
        }
      }
      if (!place && place.error().kind != ErrorKind::cancelled) {
        const std::lock_guard lock(mutex_);
        warnings_.push_back(place.error().describe());
      }
    }
    const std::lock_guard lock(mutex_);
    seen_ = calls;
  }
}

}  // namespace acentric
