#pragma once
/// Bakes and measures one setting of a project after another: the same frames against the same truth.

#include <memory>
#include <optional>
#include <vector>

#include "engine/bake/truth.h"
#include "engine/cli/path_frames.h"
#include "engine/measure/sweep.h"
#include "engine/pipeline/bake_forecast.h"
#include "engine/pipeline/knobs.h"

namespace acentric::cli {

struct SweepRunOptions {
  std::filesystem::path folder;  ///< captures of all settings and pictures go there
  int frames = 8, repeats = 3, truthSamples = 4, crossings = 8;
  /// Only the captures that the frames are painted from are baked, and the surfaces' light. Bytes and seconds
  /// of the project as it is are predicted; those of other settings follow from it as their few captures
  /// compare, by pixels. Loading and flicker are not measured.
  bool viewsOnly = false;
};

class SweepRun {
 public:
  /// Ray-traces the truth of `frames` of the walk, evenly chosen. The walk has one storey, the project as it
  /// is; its captures are taken over, not changed.
  /// `truthBake`: whose numbers of rays the truth is shaded with.
  static Result<std::unique_ptr<SweepRun>> start(PathWalk walk, const BakeSettings& truthBake,
                                                 SweepRunOptions options, const Common& common,
                                                 TaskRunner& runner);

  /// What a setting will take: its bake is estimated unless it is there.
  struct Prospect {
    std::optional<OpenProject> open;  ///< none: it cannot be measured
    std::string whyNot;
    double bakeSeconds = 0;                        ///< of all its captures and its light, as foretold
    double missingSeconds = 0;                     ///< of what is not there yet
    std::optional<BakeForecast> forecast = {};     ///< of what is not there yet, if anything is not
    std::string bakeKey = {};                      ///< SweepPoint::bakeKey
    std::optional<std::vector<int>> cameras = {};  ///< that are baked; none: all of them
  };
  /// `known`: points of the sweep so far; what is known of a bake need not be foretold again.
  Result<Prospect> foretell(const SweepSetting& setting, const Sweep& known);
  /// Bakes what is missing, measures, writes the pictures of the worst frame. A setting that fails in a way
  /// of its own (no OpenGL) is skipped with the reason.
  ///
  /// Other work on the machine must not decide which setting is the quicker: its frames take turns with those
  /// of a reference, the project as it is (by `list` if it is drawn by OpenGL), and times are scaled by what
  /// that took meanwhile against Sweep::referenceMs; where that is 0, not at all.
  Result<SweepPoint> measure(const SweepSetting& setting, const Prospect& prospect, const Sweep& known);

  /// Careful arithmetic against less, on the frames of the project as it is, which is baked.
  Result<Numerics> numerics();

  /// Of captures, by how long those took that were baked; 0: none was yet.
  double secondsPerPixel() const { return secondsPerPixel_; }
  /// Of all pixels of captures, those that frames are painted from, as they were measured last.
  double share() const { return share_; }
  /// The median frame of the reference, as the last setting was measured.
  double referenceMs() const { return referenceMs_; }

 private:
  SweepRun(PathWalk walk, SweepRunOptions options, const Common& common, TaskRunner& runner)
      : walk_(std::move(walk)),
        views_(evenly(walk_.views, options.frames)),
        options_(std::move(options)),
        common_(common),
        runner_(runner) {
    common_.walkMegabytes = double(common.walkBytes()) / 2e6;  // a setting and the reference share it
  }
  Status adopt(const OpenProject& open);
  void foretellViews(Prospect& prospect) const;
  /// Captures that the frames are painted from.
  struct ViewsShare {
    double bytes = 0, pixels = 0;
    double allPixels = 0;  ///< of all captures
  };
  ViewsShare shareOf(const OpenProject& open) const;
  std::vector<int> camerasOfViews(const OpenProject& open) const;
  Result<BakeForecast> forecastAll(const OpenProject& open) const;
  Status bakeViews(const Prospect& prospect, const Sweep& known, SweepPoint& point);
  Status bake(const Prospect& prospect, const Sweep& known, SweepPoint& point);
  Status measureFrames(const OpenProject& open, double referenceMs, SweepPoint& point);
  Status measureLoading(const OpenProject& open, SweepPoint& point) const;
  Status measureErrors(FrameMaker& maker, SweepPoint& point, std::vector<ColourImage>& pictures) const;
  Status measureTimes(FrameMaker& maker, const std::vector<ColourImage>& pictures, double referenceMs,
                      SweepPoint& point);
  Status openReference();
  Status measureFlicker(const OpenProject& open, FrameMaker& maker, SweepPoint& point) const;
  Status outsideOf(const Layout& layout) const;
  Status writePictures(const ColourImage& worst, SweepPoint& point) const;
  Status goOn(std::size_t done, std::size_t total, const char* what) const;

  PathWalk walk_;  ///< the project as it is, as if its file lay in the folder
  std::vector<PerspectiveView> views_;
  std::vector<TruthFrame> truth_;
  SweepRunOptions options_;
  Common common_;
  TaskRunner& runner_;
  std::optional<CaptureStore> store_, original_;
  std::unique_ptr<FrameMaker> reference_;
  double referenceMs_ = 0;
  double lightSeconds_ = 0;  ///< that the surfaces' light took
  double share_ = 1;
  double secondsPerPixel_ = 0;  ///< of captures that were baked; 0: not known yet
  std::string now_;             ///< the setting that is being measured, for progress
};

}  // namespace acentric::cli
