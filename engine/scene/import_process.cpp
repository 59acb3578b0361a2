#include "engine/scene/import_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "engine/base/program_file.h"
#include "engine/base/spawn.h"
#include "engine/scene/importer_protocol.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMilliseconds = 10;
constexpr std::size_t kMaxLine = std::size_t(1) << 16;

/// Owns a child process: killed and reaped at the latest when this goes.
class Child {
 public:
  Child(pid_t pid, int output) : pid_(pid), output_(output) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    kill();
    ::close(output_);
  }

  int output() const { return output_; }

  /// Exit status once it has ended.
  std::optional<int> ended() {
    if (!status_) {
      int status = 0;
      const pid_t got = ::waitpid(pid_, &status, WNOHANG);
      if (got == pid_) status_ = status;
      if (got < 0 && errno == ECHILD) status_ = 0;  // reaped by someone else: judge by what it wrote
    }
    return status_;
  }

  void kill() {
    if (ended()) return;
    ::kill(pid_, SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    status_ = status;
  }

  /// Bytes in memory now; 0 when unknown.
  std::size_t residentBytes() const {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        std::fopen(fmt::format("/proc/{}/statm", pid_).c_str(), "r"), &std::fclose);
    unsigned long total = 0, resident = 0;
    if (!file || std::fscanf(file.get(), "%lu %lu", &total, &resident) != 2) return 0;
    return std::size_t(resident) * std::size_t(::sysconf(_SC_PAGESIZE));
  }

 private:
  pid_t pid_;
  int output_;
  std::optional<int> status_;
};

Result<std::unique_ptr<Child>> spawn(const std::vector<std::string>& arguments) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    return fail(ErrorKind::internal, fmt::format("no pipe: {}", std::strerror(errno)));
  const auto process = spawnProgram(arguments, {ends[1], {}});
  ::close(ends[1]);
  if (!process) {
    ::close(ends[0]);
    return tl::unexpected(process.error());
  }
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return std::make_unique<Child>(*process, ends[0]);
}

/// Cuts the child's output into lines and keeps the last word.
class Listener {
 public:
  explicit Listener(const Progress& progress) : progress_(progress) {}

  /// False when the child has closed its end.
  bool read(int descriptor) {
    char buffer[4096];
    for (;;) {
      const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
      if (got == 0) return false;
      if (got < 0) return errno == EAGAIN || errno == EINTR;
      for (ssize_t i = 0; i < got; ++i) {
        if (buffer[i] == '\n') {
          take();
        } else if (line_.size() < kMaxLine) {
          line_ += buffer[i];
        }
      }
    }
  }

  std::optional<Error> error;
  bool written = false;

 private:
  void take() {
    const ImporterLine parsed = parseImporterLine(line_);
    line_.clear();
    if (parsed.kind == ImporterLine::Kind::error) error = parsed.error;
    if (parsed.kind == ImporterLine::Kind::written) written = true;
    if (parsed.kind == ImporterLine::Kind::progress && progress_) progress_(parsed.progress);
  }

  const Progress& progress_;
  std::string line_;
};

tl::unexpected<Error> tooMuchMemory(const ImportHost& host, const std::string& where) {
  return fail(ErrorKind::outOfSpace,
              fmt::format("needs more memory than the limit of {} MiB; the file is damaged, or raise "
                          "the limit with --import-memory",
                          host.memoryLimitBytes >> 20),
              where);
}

Status verdict(int status, const Listener& heard, const ImportHost& host, const std::string& where) {
  if (WIFSIGNALED(status))
    return fail(ErrorKind::malformed,
                fmt::format("the importer crashed (signal {}) while reading it: the file is probably damaged",
                            WTERMSIG(status)),
                where);
  if (heard.error) {
    if (heard.error->kind == ErrorKind::outOfSpace && heard.error->where == where)
      return tooMuchMemory(host, where);
    return tl::unexpected(*heard.error);
  }
  if (WEXITSTATUS(status) != 0 || !heard.written)
    return fail(
        ErrorKind::malformed,
        fmt::format("the importer gave up (exit code {}) while reading it: the file is probably damaged",
                    WEXITSTATUS(status)),
        where);
  return {};
}

}  // namespace

Result<fs::path> importerProgram(const ImportHost& host) {
  fs::path program = host.importer;
  if (program.empty()) program = programFile("acentric-importer");
  if (::access(program.c_str(), X_OK) != 0)
    return fail(ErrorKind::notFound,
                "the importer program is missing or cannot be run; install it beside this program",
                program.string());
  return program;
}

Status runImporter(const fs::path& program, const fs::path& model, const ImportOptions& options,
                   const fs::path& output, const ImportHost& host, const Progress& progress,
                   std::stop_token stop) {
  const std::string where = model.string();
  const auto child = spawn({program.string(), model.string(), optionsToJson(options), output.string(),
                            std::to_string(host.memoryLimitBytes), std::to_string(host.timeLimitSeconds),
                            std::to_string(::getpid())});
  if (!child) return tl::unexpected(child.error());
  Listener listener(progress);
  const auto start = Clock::now();
  bool open = true;
  for (;;) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "the import was cancelled", where);
    if (std::chrono::duration<double>(Clock::now() - start).count() > host.timeLimitSeconds)
      return fail(ErrorKind::timeout,
                  fmt::format("reading it took longer than the limit of {:g} s: give it more time with "
                              "--import-seconds, or simplify or split the model",
                              host.timeLimitSeconds),
                  where);
    if ((*child)->residentBytes() > host.memoryLimitBytes) return tooMuchMemory(host, where);
    pollfd wait{(*child)->output(), POLLIN, 0};
    ::poll(&wait, open ? 1 : 0, kPollMilliseconds);
    if (open) open = listener.read((*child)->output());
    if (const auto status = (*child)->ended()) {
      if (open) listener.read((*child)->output());
      return verdict(*status, listener, host, where);
    }
  }
}

}  // namespace acentric
