#include "editor/session/sweep_watch.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <vector>

#include "editor/session/engine_texts.h"
#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/program_file.h"
#include "engine/base/spawn.h"
#include "engine/pipeline/knobs.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace fs = std::filesystem;
namespace {

constexpr double kLookInterval = 1;  // seconds
constexpr int kNice = 10;
constexpr const char* kLogFile = "last-run.log";

/// What it wrote of a failure.
std::string lastLineOf(const fs::path& log) {
  constexpr std::size_t kMostLog = std::size_t(1) << 20;
  auto text = readText(log, kMostLog);
  if (!text) return {};
  while (!text->empty() && text->back() == '\n') text->pop_back();
  return text->substr(text->find_last_of("\n\r") + 1);
}

}  // namespace

SweepWatch::SweepWatch(fs::path program, Kind kind) : program_(std::move(program)), kind_(kind) {
  if (program_.empty()) program_ = ownProgram().parent_path() / "acentric";
}

SweepWatch::~SweepWatch() { forgetProcess(); }

/// Asked to end, it writes what it knows; what does not end soon is ended.
void SweepWatch::forgetProcess() {
  if (process_ <= 0) return;
  stop();
  constexpr int kPatience = 30;
  for (int i = 0; i < kPatience && running(); ++i) {
    lookAtProcess();
    if (running()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (!running()) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
}

void SweepWatch::watch(const fs::path& project) {
  if (project == project_) return;
  forgetProcess();
  project_ = project;
  folder_ = project.empty()        ? fs::path()
            : kind_ == Kind::sweep ? sweepFolderFor(project)
                                   : goalsFolderFor(project);
  sweep_.reset();
  runTrouble_.clear();
  fileTrouble_.clear();
  seen_ = {};
  nextLook_ = 0;
}

Status SweepWatch::start(const SweepRequest& request) {
  require(!project_.empty() && !running(), "a sweep is of a project's file, one at a time");
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return fail(ErrorKind::unreadable, trf("cannot be made: {}", error.message()), folder_.string());
  std::vector<std::string> words{program_.string(),
                                 kind_ == Kind::sweep ? "sweep" : "propose",
                                 project_.string(),
                                 "--budget-minutes",
                                 std::to_string(request.minutes),
                                 "--frames",
                                 std::to_string(request.frames),
                                 "--size",
                                 fmt::format("{}x{}", request.width, request.height)};
  if (kind_ == Kind::goals) {
    const auto goal = [&words](const char* name, const std::optional<double>& value, double unit) {
      if (value) words.insert(words.end(), {name, fmt::format("{}", *value / unit)});
    };
    goal("--max-mb", request.goals.mostBytes, 1e6);
    goal("--max-ms", request.goals.mostFrameMs, 1);
    goal("--min-psnr", request.goals.leastPsnr, 1);
  }
  if (request.again) words.push_back("--again");
  const auto started = spawnProgram(words, {-1, folder_ / kLogFile});
  if (!started) return tl::unexpected(started.error());
  process_ = *started;
  ::setpriority(PRIO_PROCESS, id_t(process_), kNice);
  stopping_ = false;
  runTrouble_.clear();
  nextLook_ = 0;
  return {};
}

void SweepWatch::stop() {
  if (!running()) return;
  stopping_ = true;
  ::kill(process_, SIGINT);
}

bool SweepWatch::lookAtProcess() {
  if (process_ <= 0) return false;
  int status = 0;
  const pid_t got = ::waitpid(process_, &status, WNOHANG);
  if (got == 0 || (got < 0 && errno == EINTR)) return false;
  process_ = 0;
  if (got > 0 && !stopping_ && !(WIFEXITED(status) && WEXITSTATUS(status) == 0)) {
    const std::string said = lastLineOf(folder_ / kLogFile);
    runTrouble_ = said.empty() ? tr("The measuring ended without a word") : said;
  }
  return true;
}

bool SweepWatch::look() {
  if (folder_.empty()) return false;
  const fs::path file = folder_ / kSweepFile;
  const FileLook now = lookAt(file);
  if (now == seen_) return false;
  seen_ = now;
  const auto text = readText(file);
  fileTrouble_.clear();
  auto parsed = text ? parseSweep(*text, file.string()) : Result<Sweep>(tl::unexpected(text.error()));
  if (parsed) {
    sweep_ = std::make_shared<const Sweep>(std::move(*parsed));
  } else {
    sweep_.reset();
    std::error_code error;
    if (fs::exists(file, error)) fileTrouble_ = engineText(parsed.error());
  }
  return true;
}

bool SweepWatch::poll(double now) {
  const bool ended = lookAtProcess();
  if (!ended && now < nextLook_) return false;
  nextLook_ = now + kLookInterval;
  return look() || ended;
}

}  // namespace acentric::editor
