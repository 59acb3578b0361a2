#pragma once
/// A walk's file that is walked page by page of its index: what is in memory, and what a frame looks at, is
/// that of the page where the eye is, however many regions there are. Captures come and go as in WalkStream,
/// which does this within a page.
///
/// A page tells of its own regions and of those two steps around them. When the eye is in one of these, the
/// next page is read in the background, and takes over what both have; until then frames go on with the page
/// before, which knows all that they need. Nobody waits.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "engine/pipeline/shipped_walk.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric {

struct PagedWalkStats {
  WalkStreamStats captures;  ///< of all pages so far; `full` and `coarse` of the page where the eye is
  WalkPagesStats index;
  int changes = 0;                       ///< of page, by the eye
  double longestChange = 0;              ///< seconds from its notice until the next page is walked
  std::size_t regions = 0, cameras = 0;  ///< of the page
};

class PagedWalk {
 public:
  /// Begins at options.where, which it reads the page of, and the textures. `file`: the walk's, for messages.
  static Result<std::unique_ptr<PagedWalk>> open(std::unique_ptr<WalkPages> pages, std::size_t storey,
                                                 const std::filesystem::path& file, WalkStreamOptions options,
                                                 TaskRunner& runner);
  ~PagedWalk();
  PagedWalk(const PagedWalk&) = delete;
  PagedWalk& operator=(const PagedWalk&) = delete;

  /// As of WalkStream. Cheap: to be called with each frame.
  void go(const Whereabouts& where);
  /// The newest snapshot; its layout is that of a page, and ids number regions and cameras in the storey.
  std::shared_ptr<const LoadedWalk> walk() const;
  std::vector<std::string> takeWarnings();
  bool busy() const;
  PagedWalkStats stats() const;

 private:
  PagedWalk(std::unique_ptr<WalkPages> pages, std::size_t storey, std::filesystem::path file,
            WalkStreamOptions options);
  struct Place {
    BundlePlacePtr place;
    ShippedWalkPtr walk;
    std::shared_ptr<WalkStream> stream;
  };
  void follow(const std::stop_token& stop);
  void look(const Whereabouts& where, const std::stop_token& stop);
  std::vector<BundlePlacePtr> placed(const BundlePlacePtr& place) const;  ///< by storey
  bool isOwn(const glm::dvec2& eye) const;
  Result<Place> enter(const BundlePlacePtr& place, const Whereabouts& where, const std::stop_token& stop);
  void replace(Place next, const Whereabouts& where);
  void warn(std::vector<std::string> warnings);
  std::shared_ptr<WalkStream> stream() const;

  const std::unique_ptr<WalkPages> pages_;
  const std::size_t storey_;
  const std::filesystem::path file_;
  const WalkStreamOptions options_;
  double lookAgain_ = 0;  ///< metres that the eye goes before its region is looked up

  Place at_;  ///< of the thread that follows the eye

  mutable std::mutex published_;  // held for as long as it takes to copy a pointer
  std::shared_ptr<WalkStream> stream_;

  mutable std::mutex wake_;  // the same
  std::condition_variable_any moved_;
  Whereabouts where_;
  glm::dvec2 told_{0};  ///< where the eye was when its thread was told last
  std::uint64_t calls_ = 1, seen_ = 0;

  mutable std::mutex tally_;  // no frame takes it
  PagedWalkStats counts_;     ///< of the pages before
  std::vector<std::string> warnings_;
  std::set<std::string> known_;  ///< warnings that were given

  std::jthread follower_;  // last: it is joined first
};

}  // namespace acentric
