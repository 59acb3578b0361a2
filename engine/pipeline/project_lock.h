#pragma once
/// An advisory lock beside a project, so that two editors on one project notice each other
/// ("gallery.acentric.json.lock"), and two bakes (bake_guard.h): JSON with host, process, user and time. It
/// never blocks: who finds one decides. A lock of a process on this machine that is gone, or one that cannot
/// be read, is taken over.

#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/result.h"

namespace acentric {

struct LockOwner {
  std::string host;
  std::string user;
  std::string since;  ///< local time, "2026-03-01 14:05"
  long process = 0;
  std::string processStart;  ///< tells a process from a later one of the same number
  std::string machine;       ///< where process numbers have one meaning (engine/base/file.h)
  std::string token;         ///< of this very lock
  bool operator==(const LockOwner&) const = default;
};
/// "ann on host a.example since 2026-03-01 14:05 (process 812)"
std::string describe(const LockOwner& owner);

/// How a lock's finds are told.
struct LockWords {
  const char* stale = "The last editor on this project ended without closing it";
  const char* without = "Other editors will not notice that the project is open here.";
};

std::filesystem::path lockFileFor(const std::filesystem::path& projectFile);
/// Malformed: it is there, but says nothing. notFound: there is none.
Result<LockOwner> readLock(const std::filesystem::path& projectFile);
/// Of this machine, and its process is gone.
bool isStale(const LockOwner& owner);
/// What this process writes in a lock.
LockOwner thisOwner();

/// A lock that is held; removed with this, unless somebody has taken it over meanwhile.
class ProjectLock {
 public:
  struct Attempt;
  /// `force`: whoever holds it.
  static Attempt take(const std::filesystem::path& projectFile, bool force, const LockWords& words = {});
  ~ProjectLock();
  ProjectLock(ProjectLock&& other) noexcept;
  ProjectLock& operator=(ProjectLock&& other) noexcept;

  /// Who has taken it over, if anybody.
  std::optional<LockOwner> lostTo() const;

 private:
  ProjectLock(std::filesystem::path projectFile, LockOwner owner)
      : projectFile_(std::move(projectFile)), owner_(std::move(owner)) {}
  void release();

  std::filesystem::path projectFile_;  ///< empty: moved from
  LockOwner owner_;
};

struct ProjectLock::Attempt {
  std::optional<ProjectLock> lock;
  std::optional<LockOwner> heldBy;  ///< another living process, or one of another machine
  std::string note;                 ///< for the user: what was found, or why there is no lock; may be empty
};

}  // namespace acentric
