#include "engine/pipeline/project_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <nlohmann/json.hpp>
#include <random>

#include "engine/base/file.h"
#include "engine/base/json_text.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLockBytes = 64 << 10;

/// Field 22 of /proc/N/stat: ticks from the machine's start to the process's. Empty where there is none.
std::string startOf(long process) {
  const auto text = readText(fmt::format("/proc/{}/stat", process), kMostLockBytes);
  if (!text) return {};
  std::size_t at = text->rfind(')');  // the name in parentheses may hold anything
  for (int field = 2; at != std::string::npos && field < 22; ++field) at = text->find(' ', at + 1);
  return at == std::string::npos ? std::string() : text->substr(at + 1, text->find(' ', at + 1) - at - 1);
}

/// What the names of temporaries begin with, without the process that they end with.
std::string thisMachine() {
  const std::string start = temporaryNameStart();
  return start.substr(0, start.rfind(std::to_string(::getpid()) + "-"));
}

std::string userName() {
  const passwd* entry = ::getpwuid(::getuid());
  return entry != nullptr ? entry->pw_name : std::to_string(::getuid());
}

std::string toText(const LockOwner& owner) {
  const Json json = {{"format", "acentric-lock"}, {"host", owner.host},
                     {"user", owner.user},        {"since", owner.since},
                     {"process", owner.process},  {"processStart", owner.processStart},
                     {"machine", owner.machine},  {"token", owner.token}};
  return jsonText(json, 2) + "\n";
}

/// Makes the file unless it is there: of several who try at once, one succeeds.
Status createExclusively(const fs::path& file, const std::string& text) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0)
    return fail(errno == EEXIST ? ErrorKind::invalidArgument : ErrorKind::unreadable,
                std::system_category().message(errno), file.string());
  const bool written = ::write(descriptor, text.data(), text.size()) == ssize_t(text.size());
  ::close(descriptor);
  if (written) return {};
  std::error_code error;
  fs::remove(file, error);
  return fail(ErrorKind::outOfSpace, "cannot be written", file.string());
}

}  // namespace

std::string describe(const LockOwner& owner) {
  return fmt::format("{} on {} since {} (process {})", owner.user, owner.host, owner.since, owner.process);
}

fs::path lockFileFor(const fs::path& projectFile) {
  fs::path file = projectFile;
  file += ".lock";
  return file;
}

Result<LockOwner> readLock(const fs::path& projectFile) {
  const fs::path file = lockFileFor(projectFile);
  const auto text = readText(file, kMostLockBytes);
  if (!text) return tl::unexpected(text.error());
  const Json json = parseJson<Json>(*text).value_or(Json());
  try {
    if (json.at("format") != "acentric-lock") throw std::invalid_argument("another format");
    return LockOwner{json.at("host"),         json.at("user"),    json.at("since"), json.at("process"),
                     json.at("processStart"), json.at("machine"), json.at("token")};
  } catch (const std::exception&) {
    return fail(ErrorKind::malformed, "is no lock that could be read", file.string());
  }
}

bool isStale(const LockOwner& owner) {
  if (owner.machine != thisMachine() || owner.process <= 0) return false;
  if (::kill(pid_t(owner.process), 0) != 0 && errno == ESRCH) return true;
  return startOf(owner.process) != owner.processStart;
}

LockOwner thisOwner() {
  LockOwner owner;
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  owner.host = host.data();
  owner.user = userName();
  owner.since = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr)));
  owner.process = ::getpid();
  owner.processStart = startOf(owner.process);
  owner.machine = thisMachine();
  std::random_device random;
  owner.token = fmt::format("{:08x}{:08x}", random(), random());
  return owner;
}

ProjectLock::Attempt ProjectLock::take(const fs::path& projectFile, bool force, const LockWords& words) {
  const fs::path file = lockFileFor(projectFile);
  const LockOwner owner = thisOwner();
  Attempt attempt;
  Status made = createExclusively(file, toText(owner));
  if (!made && made.error().kind == ErrorKind::invalidArgument) {
    const auto found = readLock(projectFile);
    const bool stale = found && isStale(*found);
    if (found && !stale && !force) {
      attempt.heldBy = *found;
      return attempt;
    }
    if (stale)
      attempt.note = fmt::format("{}: {}", words.stale, describe(*found));
    else if (!found)
      attempt.note = "The lock beside the project was damaged and is replaced: " + file.string();
    made = writeTextAtomically(file, toText(owner));
  }
  if (made)
    attempt.lock = ProjectLock(projectFile, owner);
  else
    attempt.note = std::string(words.without) + " " + made.error().describe();
  return attempt;
}

std::optional<LockOwner> ProjectLock::lostTo() const {
  const auto found = readLock(projectFile_);
  if (!found || found->token == owner_.token) return std::nullopt;
  return *found;
}

void ProjectLock::release() {
  if (projectFile_.empty()) return;
  const auto found = readLock(projectFile_);
  std::error_code error;  // one that is gone is as good as removed
  if (found && found->token == owner_.token) fs::remove(lockFileFor(projectFile_), error);
  projectFile_.clear();
}

ProjectLock::~ProjectLock() { release(); }

ProjectLock::ProjectLock(ProjectLock&& other) noexcept
    : projectFile_(std::exchange(other.projectFile_, {})), owner_(std::move(other.owner_)) {}

ProjectLock& ProjectLock::operator=(ProjectLock&& other) noexcept {
  release();
  projectFile_ = std::exchange(other.projectFile_, {});
  owner_ = std::move(other.owner_);
  return *this;
}

}  // namespace acentric
