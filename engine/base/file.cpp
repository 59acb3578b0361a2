#include "engine/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "engine/base/hash.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

ErrorKind kindOfErrno(int code) {
  if (code == ENOENT) return ErrorKind::notFound;
  if (code == ENOSPC || code == EDQUOT) return ErrorKind::outOfSpace;
  return ErrorKind::unreadable;
}

tl::unexpected<Error> failErrno(const char* what, const fs::path& path) {
  const int code = errno;
  return fail(kindOfErrno(code), fmt::format("{}: {}", what, std::strerror(code)), path.string());
}

/// The system would take the name for what comes before the NUL: another file.
Status checkName(const fs::path& path) {
  if (path.native().find('\0') == std::string::npos) return {};
  return fail(ErrorKind::invalidArgument, "holds a NUL character, which no file name does", path.string());
}

template <class Container>
Result<Container> readWhole(const fs::path& path, std::size_t maxBytes) {
  if (Status sound = checkName(path); !sound) return tl::unexpected(sound.error());
  std::error_code error;
  if (fs::is_directory(path, error))
    return fail(ErrorKind::unreadable, "is a folder, not a file", path.string());
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return failErrno("cannot be opened for reading", path);
  Container out;
  char buffer[1 << 16];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, file.get())) {
    if (out.size() + got > maxBytes)
      return fail(ErrorKind::tooLarge, fmt::format("is larger than the limit of {} MiB", maxBytes >> 20),
                  path.string());
    const std::size_t old = out.size();
    out.resize(old + got);
    std::memcpy(out.data() + old, buffer, got);
  }
  if (std::ferror(file.get())) return failErrno("reading failed", path);
  return out;
}

/// Between two of these a writer looks whether it is to stop.
constexpr std::size_t kPieceBytes = 4 << 20;

/// Writes pieces and has the disk keep up with all but the last, so that no flush at the end takes long.
class PieceWriter {
 public:
  PieceWriter(std::FILE* file, const std::stop_token& stop) : file_(file), stop_(stop) {}

  /// False with errno, or when stopped.
  bool write(std::span<const std::byte> bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      if (stop_.stop_requested()) return false;
      const std::size_t size = std::min(bytes.size() - at, kPieceBytes);
      if (std::fwrite(bytes.data() + at, 1, size, file_) != size) return false;
      at += size;
      unsent_ += size;
      if (unsent_ >= kPieceBytes && !send()) return false;
    }
    return true;
  }

 private:
  bool send() {
    if (std::fflush(file_) != 0) return false;
    // Hints alone: where a file system does not know them, the flush at the end does all.
    const int descriptor = ::fileno(file_);
    (void)::sync_file_range(descriptor, sent_, off_t(unsent_), SYNC_FILE_RANGE_WRITE);
    constexpr unsigned kWait =
        SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE | SYNC_FILE_RANGE_WAIT_AFTER;
    if (sent_ > before_) (void)::sync_file_range(descriptor, before_, sent_ - before_, kWait);
    before_ = sent_;
    sent_ += off_t(unsent_);
    unsent_ = 0;
    return true;
  }

  std::FILE* file_;
  const std::stop_token& stop_;
  std::size_t unsent_ = 0;
  off_t before_ = 0, sent_ = 0;  ///< where the piece that the disk writes began, and ended
};

Status flushToDisk(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) return failErrno("cannot be opened to flush it to disk", path);
  const int result = ::fsync(descriptor);
  ::close(descriptor);
  if (result != 0 && errno != EINVAL) return failErrno("flushing to disk failed", path);
  return {};
}

fs::path temporaryFor(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  return path.parent_path() /
         fmt::format("{}{}{}", temporaryNameStart(), counter++, path.extension().string());
}

/// Where process numbers have one meaning: a host, and there a namespace of processes (a container's).
std::string machineTag() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  std::error_code none;
  const fs::path processes = fs::read_symlink("/proc/self/ns/pid", none);
  return fmt::format("{:08x}", Hasher().text(host).text(processes.string()).finish().low & 0xffffffff);
}

constexpr auto kForsaken = std::chrono::hours(24);  ///< since the last write

bool isStale(const fs::directory_entry& entry, const std::string& machine) {
  std::error_code error;
  const auto written = entry.last_write_time(error);
  if (!error && fs::file_time_type::clock::now() - written > kForsaken) return true;
  const std::string name = entry.path().filename().string();
  const std::string ours = fmt::format("{}{}-", kTemporaryPrefix, machine);
  int process = 0;
  if (!name.starts_with(ours)) return false;
  std::from_chars(name.data() + ours.size(), name.data() + name.size(), process);
  return process <= 0 || (::kill(process, 0) != 0 && errno != EPERM);
}

}  // namespace

Result<std::vector<std::byte>> readFile(const fs::path& path, std::size_t maxBytes) {
  return readWhole<std::vector<std::byte>>(path, maxBytes);
}

Result<std::string> readText(const fs::path& path, std::size_t maxBytes) {
  return readWhole<std::string>(path, maxBytes);
}

Status replaceFileAtomically(const fs::path& path, const std::function<Status(const fs::path&)>& write) {
  if (Status sound = checkName(path); !sound) return sound;
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  fs::create_directories(folder, error);
  if (error) return fail(ErrorKind::unreadable, "folder cannot be made: " + error.message(), folder.string());
  const fs::path temporary = temporaryFor(path);
  const auto attempt = [&]() -> Status {
    if (auto written = write(temporary); !written) return written;
    if (auto flushed = flushToDisk(temporary, O_RDONLY); !flushed) return flushed;
    if (::rename(temporary.c_str(), path.c_str()) != 0) {
      if (errno == EISDIR)
        return fail(ErrorKind::unreadable, "cannot be put in place: a folder has this name; move it away",
                    path.string());
      return failErrno("cannot be put in place", path);
    }
    return flushToDisk(folder, O_RDONLY | O_DIRECTORY);
  };
  Status result = attempt();
  if (!result) fs::remove(temporary, error);
  return result;
}

Status writeFileAtomically(const fs::path& path, std::span<const std::span<const std::byte>> parts,
                           const std::stop_token& stop) {
  return replaceFileAtomically(path, [&](const fs::path& temporary) -> Status {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(temporary.c_str(), "wb"), &std::fclose);
    if (!file) return failErrno("cannot be opened for writing", path);
    PieceWriter writer(file.get(), stop);
    bool written = true;
    for (const auto& part : parts) written = written && writer.write(part);
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "writing was stopped", path.string());
    if (!written || std::fflush(file.get()) != 0) return failErrno("writing failed", path);
    return {};
  });
}

Status writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes,
                           const std::stop_token& stop) {
  return writeFileAtomically(path, std::span(&bytes, 1), stop);
}

Status writeTextAtomically(const fs::path& path, std::string_view text) {
  return writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::string temporaryNameStart() {
  return fmt::format("{}{}-{}-", kTemporaryPrefix, machineTag(), ::getpid());
}

int removeStaleTemporaries(const fs::path& folder) {
  int removed = 0;
  std::error_code error;
  const std::string machine = machineTag();
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::error_code removeError;
    if (entry.path().filename().string().starts_with(kTemporaryPrefix) && isStale(entry, machine) &&
        fs::remove_all(entry.path(), removeError) > 0 && !removeError)
      ++removed;
  }
  return removed;
}

Status checkWritable(const fs::path& folder) {
  const fs::path trial = temporaryFor(folder / "trial");
  const int file = ::open(trial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return failErrno("nothing can be written there", folder);
  ::close(file);
  ::unlink(trial.c_str());
  return {};
}

Result<std::uint64_t> freeSpace(const fs::path& path) {
  std::error_code error;
  fs::path there = fs::absolute(path, error);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  const fs::space_info space = fs::space(there, error);
  if (error)
    return fail(ErrorKind::unreadable, "has no known free space: " + error.message(), there.string());
  return space.available;
}

fs::path userCacheFolder() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg == '/') return fs::path(xdg) / "acentric";
  if (const char* home = std::getenv("HOME"); home && *home == '/')
    return fs::path(home) / ".cache" / "acentric";
  return fs::temp_directory_path() / "acentric-cache";
}

}  // namespace acentric
