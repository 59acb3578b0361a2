#pragma once
/// Keeps bakes of one project apart, and a bake to the model that it began with.
///
/// A bake of all cameras holds a lock beside the project (project_lock.h). Shares of a bake (shards, or the
/// surfaces' light by itself) may run side by side, on any machines, and the same share twice: each only
/// leaves a lock of its own, so that a bake of all notices them, and they notice it.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/file_stamp.h"
#include "engine/base/result.h"
#include "engine/pipeline/project.h"
#include "engine/pipeline/shard.h"
#include "engine/scene/import.h"

namespace acentric {

/// What of a project one process bakes.
struct BakePart {
  enum class Kind { all, cameras, light, shard };
  Kind kind = Kind::all;
  Shard shard;  ///< of `shard`
  bool exclusive() const { return kind == Kind::all || kind == Kind::cameras; }
};

struct BakeGuardOptions {
  BakePart part;
  /// Of whoever bakes all of the project: that bake ends before it stores its next capture. Shares that are
  /// being baked go on beside this bake, to the same bytes.
  bool takeOver = false;
  /// Ends the message that another process bakes the project.
  std::string wayOut = "wait until it has ended, or bake in its place with --take-over";
};

/// Threads may share it. Its locks go with it.
class BakeGuard {
 public:
  /// Fails if another living process bakes the project, or one of another machine that may be alive; the
  /// message names it. Where no lock can be written the bake goes on without: see note().
  static Result<BakeGuard> begin(const std::filesystem::path& projectFile, const BakeGuardOptions& options);
  ~BakeGuard();
  BakeGuard(BakeGuard&&) noexcept;
  BakeGuard& operator=(BakeGuard&&) noexcept;

  /// From now on check() looks at these files too.
  void watch(const std::vector<FileStamp>& files);
  /// May the bake go on? Not once another process has taken it over, or a file of the model has changed.
  /// Cheap: reads contents only where size or time differ.
  Status check() const;
  /// What was found that the user should know; may be empty.
  const std::string& note() const;

 private:
  struct State;
  explicit BakeGuard(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The files of a project's model as they are now, read whole. One that was written to since `began`, before
/// the model was imported, counts as changed ever after: nobody knows what of it was imported.
std::vector<FileStamp> modelFiles(const std::filesystem::path& projectFile, const Project& project,
                                  const ImportHost& host, std::filesystem::file_time_type began);

}  // namespace acentric
