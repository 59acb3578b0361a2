#pragma once
/// What accuracy costs in the open project: a sweep of it (`acentric sweep`) or a search for what keeps to
/// goals
/// (`acentric propose`), run in a process of its own so that it can neither stop nor slow the window, and
/// what it has measured, read from its file as that grows — also while somebody else runs it.

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>

#include "editor/session/file_watch.h"
#include "engine/measure/sweep.h"

namespace acentric::editor {

struct SweepRequest {
  int minutes = 10;
  int frames = 8;
  int width = 640, height = 360;
  bool again = false;  ///< what was measured before is forgotten
  Goals goals = {};    ///< of a search for them
  bool operator==(const SweepRequest&) const = default;
};

class SweepWatch {
 public:
  enum class Kind : std::uint8_t { sweep, goals };

  /// `program`: `acentric`; empty = beside the running program.
  explicit SweepWatch(std::filesystem::path program, Kind kind = Kind::sweep);
  /// Ends what it has started.
  ~SweepWatch();
  SweepWatch(const SweepWatch&) = delete;
  SweepWatch& operator=(const SweepWatch&) = delete;

  /// The sweep of that project's file; empty: none. What runs of another project is stopped.
  void watch(const std::filesystem::path& project);
  /// Of the project as it is in its file; a later one goes on where an earlier one ended.
  Status start(const SweepRequest& request);
  /// What is measured is kept.
  void stop();
  bool running() const { return process_ > 0; }
  bool stopping() const { return running() && stopping_; }

  /// Looks at the process, and now and then at the file. True if anything is different.
  bool poll(double now);
  /// Null where nothing was measured yet.
  const std::shared_ptr<const Sweep>& sweep() const { return sweep_; }
  /// Of its files and pictures.
  const std::filesystem::path& folder() const { return folder_; }
  /// Why the last run failed, or the file cannot be read; empty: nothing did.
  const std::string& trouble() const { return runTrouble_.empty() ? fileTrouble_ : runTrouble_; }

 private:
  bool look();
  bool lookAtProcess();
  void forgetProcess();

  std::filesystem::path program_, project_, folder_;
  Kind kind_;
  pid_t process_ = 0;
  bool stopping_ = false;
  double nextLook_ = 0;
  FileLook seen_;
  std::shared_ptr<const Sweep> sweep_;
  std::string runTrouble_, fileTrouble_;
};

}  // namespace acentric::editor
