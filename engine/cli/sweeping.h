#pragma once
/// A sweep under way: what is known of a project's settings, and the files that say so. Shared by the
/// commands that try settings.

#include <filesystem>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/sweep_run.h"

namespace acentric::cli {

class Sweeping {
 public:
  Sweeping(std::filesystem::path folder, Sweep sweep, double budgetMinutes)
      : folder_(std::move(folder)), sweep_(std::move(sweep)), budgetMinutes_(budgetMinutes) {}

  void use(SweepRun& run) { run_ = &run; }
  Sweep& sweep() { return sweep_; }
  const std::filesystem::path& folder() const { return folder_; }
  double secondsLeft() const { return 60 * budgetMinutes_ - watch_.seconds(); }
  /// Is there time to measure one more, whose captures are there?
  bool goesOn() const { return secondsLeft() > measureSeconds_; }
  double measureSeconds() const { return measureSeconds_; }
  int measuredNow() const { return measuredNow_; }

  /// Measured before, or now if `seconds` suffice; else skipped, with the reason.
  Result<const SweepPoint*> measure(const SweepSetting& setting, double seconds);
  Status write() const;
  /// The report too.
  Status writeAll() const;

 private:
  std::filesystem::path folder_;
  Sweep sweep_;
  double budgetMinutes_;
  SweepRun* run_ = nullptr;
  Stopwatch watch_;
  double measureSeconds_ = 0;  ///< that the last point has taken
  int measuredNow_ = 0;
};

/// What a sweep says of itself before anything is measured. `walk`: of one storey, the project as it is.
Sweep sweepOf(const PathWalk& walk, const std::filesystem::path& project, const std::filesystem::path& path,
              const BakeSettings& truthBake, const SweepRunOptions& options, const TaskRunner& runner);

/// What an earlier call has measured, if it may be gone on with.
Result<Sweep> resume(Sweep sweep, const std::filesystem::path& folder, bool again);

/// Of names as `--knobs` takes them.
Result<std::vector<KnobRange>> rangesOf(const std::vector<std::string>& names, const Project& project);

/// The truth is one for all settings: it has as many rays as the best of them.
BakeSettings truthBakeOf(const Project& project, const std::vector<KnobRange>& ranges);

/// A table of all that was measured, and of what is worth having.
Report reportOf(const Sweep& sweep, int measuredNow);
/// A point as a line of it.
std::string lineOf(const SweepPoint& point);

/// Gone on with by the same command, and says so; else the status.
Status withWayOn(const Status& done, const std::filesystem::path& folder);

}  // namespace acentric::cli
