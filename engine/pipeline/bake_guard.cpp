#include "engine/pipeline/bake_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/project_lock.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockExtension = ".lock";
constexpr LockWords kWords{"The last bake of this project ended before it had finished",
                           "Other bakes of this project will not notice this one."};

/// Locks are beside the project: NAME.bake.lock of a bake of all cameras, NAME.bake-cameras.lock while it
/// leaves the light to others, NAME.bake-light.lock and NAME.bake-2-of-8.lock of shares.
fs::path locked(const fs::path& projectFile, const std::string& what) {
  fs::path file = projectFile;
  file += ".bake" + what;
  return file;
}
std::string nameOf(const BakePart& part) {
  if (part.kind == BakePart::Kind::light) return "-light";
  if (part.kind == BakePart::Kind::cameras) return "-cameras";
  return part.kind == BakePart::Kind::all ? ""
                                          : fmt::format("-{}-of-{}", part.shard.number, part.shard.count);
}

/// The locks of every bake of a project: what each is of, as in its name.
std::vector<std::string> locksBeside(const fs::path& projectFile) {
  const std::string start = projectFile.filename().string() + ".bake";
  std::vector<std::string> found;
  std::error_code error;
  const fs::path folder = projectFile.has_parent_path() ? projectFile.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (name.extension() == kLockExtension && name.string().starts_with(start))
      found.push_back(name.stem().string().substr(start.size()));
  }
  std::ranges::sort(found);
  return found;
}

bool compatible(const std::string& mine, const std::string& theirs) {
  const auto exclusive = [](const std::string& name) { return name.empty() || name == "-cameras"; };
  if (!exclusive(mine) && !exclusive(theirs)) return true;
  return (mine == "-cameras" && theirs == "-light") || (mine == "-light" && theirs == "-cameras");
}

std::string lockedWords(const std::string& lock) {
  if (lock.empty() || lock == "-cameras") return "is being baked";
  if (lock == "-light") return "has the light on its surfaces baked";
  std::string share = lock.substr(1);
  if (const auto of = share.find("-of-"); of != std::string::npos) share.replace(of, 4, "/");
  return "has its share " + share + " baked";
}

}  // namespace

struct BakeGuard::State {
  fs::path projectFile;
  std::optional<ProjectLock> lock;
  bool exclusive = true;
  std::string note;
  mutable std::mutex mutex;
  mutable std::vector<FileStamp> model;  ///< looks are renewed where only the time differs
};

BakeGuard::BakeGuard(std::unique_ptr<State> state) : state_(std::move(state)) {}
BakeGuard::~BakeGuard() = default;
BakeGuard::BakeGuard(BakeGuard&&) noexcept = default;
BakeGuard& BakeGuard::operator=(BakeGuard&&) noexcept = default;

Result<BakeGuard> BakeGuard::begin(const fs::path& projectFile, const BakeGuardOptions& options) {
  const std::string mine = nameOf(options.part);
  const auto refused = [&](const std::string& lock, const LockOwner& owner) {
    return fail(ErrorKind::unreadable,
                fmt::format("{} by {}; {}", lockedWords(lock), describe(owner), options.wayOut),
                projectFile.string());
  };
  auto state = std::make_unique<State>();
  state->projectFile = projectFile;
  state->exclusive = options.part.exclusive();
  // The same share may be baked twice at once: its lock is then the newer one's.
  auto attempt = ProjectLock::take(locked(projectFile, mine), options.takeOver || !state->exclusive, kWords);
  if (attempt.heldBy) return refused(mine, *attempt.heldBy);
  state->lock = std::move(attempt.lock);
  state->note = std::move(attempt.note);
  for (const std::string& other : locksBeside(projectFile)) {
    if (other == mine || compatible(mine, other)) continue;
    const auto owner = readLock(locked(projectFile, other));
    if (owner && !isStale(*owner)) {
      if (!options.takeOver) return refused(other, *owner);
      if (!state->exclusive) continue;
    }
    // Of a process that is gone, or taken over.
    std::error_code ignored;
    fs::remove(lockFileFor(locked(projectFile, other)), ignored);
  }
  return BakeGuard(std::move(state));
}

void BakeGuard::watch(const std::vector<FileStamp>& files) {
  const std::lock_guard lock(state_->mutex);
  state_->model = files;
}

Status BakeGuard::check() const {
  const std::lock_guard guard(state_->mutex);
  if (state_->exclusive && state_->lock)
    if (const auto other = state_->lock->lostTo())
      return fail(
          ErrorKind::invalidArgument,
          fmt::format("the bake was taken over by {}; what it had finished is kept", describe(*other)),
          state_->projectFile.string());
  for (FileStamp& file : state_->model) {
    const FileLook now = lookAt(file.file);
    if (now == file.look) continue;
    if (differs(file))
      return fail(
          ErrorKind::invalidArgument,
          "the model changed while it was baked: the captures that were finished are kept, but are of "
          "the model as it was; bake again",
          file.file.string());
    file.look = now;
  }
  return {};
}

const std::string& BakeGuard::note() const { return state_->note; }

std::vector<FileStamp> modelFiles(const fs::path& projectFile, const Project& project, const ImportHost& host,
                                  fs::file_time_type began) {
  const fs::path model = sceneFileOf(projectFile, project);
  std::vector<fs::path> names = importedFiles(model, project.import, host);
  if (names.empty()) names.push_back(model);
  std::vector<FileStamp> stamps;
  for (const fs::path& name : names) {
    stamps.push_back(stampOf(name));
    FileStamp& stamp = stamps.back();
    if (stamp.look.exists && stamp.look.modified >= began) stamp = {name, {}, {}};
  }
  return stamps;
}

}  // namespace acentric
