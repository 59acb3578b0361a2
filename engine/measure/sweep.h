#pragma once
/// What accuracy costs: settings of a project, each with how far its frames are from the truth and what they
/// cost, on one path and one machine.

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/measure/goals.h"
#include "engine/measure/numerics.h"
#include "engine/measure/pareto.h"
#include "engine/measure/statistics.h"

namespace acentric {

/// What a sweep calls things, so that a value can be given for each: "reconstruction", "splat".
struct KnobChoice {
  std::string knob, value;
  auto operator<=>(const KnobChoice&) const = default;
};
/// What differs from the project, each knob at most once, in the order of the table of knobs
/// (pipeline/knobs.h). Empty: the project as it is.
using SweepSetting = std::vector<KnobChoice>;
/// "reconstruction splat, layers 2"; "as it is".
std::string textOf(const SweepSetting& setting);

/// Errors are spread over the frames (flicker: over the changes of region), costs over the repeats.
enum class Measure {
  psnr,         ///< dB
  ssim,         ///< 0..1
  msSsim,       ///< 0..1
  depthError,   ///< depthErrorOf; not of OpenGL's frames
  holeShare,    ///< of the pixels
  flicker,      ///< share of pixels that visibly change where the eye changes region
  bakeSeconds,  ///< of all captures and light; SweepPoint::bakeEstimated
  bytes,        ///< on disk
  loadMs,       ///< from nothing to the first frame
  frameMs,      ///< the median frame
  frameP99Ms,   ///< the frame that 99 % are not slower than
};
inline constexpr std::size_t kMeasures = 11;

struct MeasureInfo {
  Measure measure;
  const char* name;   ///< camelCase, in files
  const char* label;  ///< for people
  const char* unit;   ///< of what people see; may be empty
  double shown = 1;   ///< by what a value is multiplied for them
  int digits = 1;     ///< that they see after the point
  bool error = false;
  bool moreIsBetter = false;
};
/// In order of the enumeration.
const std::array<MeasureInfo, kMeasures>& measures();
inline const MeasureInfo& infoOf(Measure measure) { return measures()[std::size_t(measure)]; }

struct SweepPoint {
  SweepSetting setting;
  std::string skipped;  ///< why it was not measured; empty = it was
  std::array<Spread, kMeasures> values;
  bool bakeEstimated = false;  ///< some or all captures were there already: seconds as foretold
  std::string bakeKey;         ///< of settings with the same captures the same
  int changedFrames = 0;       ///< that a repeat drew differently
  int worstFrame = 0;          ///< of the least MS-SSIM
  double measureSeconds = 0;   ///< that loading, drawing and comparing took
  std::string commit;          ///< of the program that measured it
  std::string pictures;        ///< the worst frame's: PICTURES.png and PICTURES-difference.png

  bool measured() const { return skipped.empty(); }
  const Spread& operator[](Measure m) const { return values[std::size_t(m)]; }
  Spread& operator[](Measure m) { return values[std::size_t(m)]; }
};

/// Error, milliseconds of a frame, bytes: what settings are chosen by. Less is better, all above 0.
Objectives objectivesOf(const SweepPoint& point);

GoalFigures figuresOf(const SweepPoint& point);

struct SweepPreset {
  std::string name;  ///< fast, balanced, accurate, proposal
  SweepSetting setting;
};

struct Sweep {
  std::string project, scene, path, version, processor;
  std::string commit;  ///< of the program that wrote it last
  int threads = 0;
  int width = 0, height = 0, frames = 0, repeats = 0, truthSamples = 0;
  /// The median frame of what every setting's frames took turns with (SweepRun); times are scaled to it.
  double referenceMs = 0;
  std::string fingerprint;         ///< of all that results may be compared within
  std::vector<SweepPoint> points;  ///< the project as it is first
  std::string truthPictures;       ///< folder of the truth of each frame, relative
  Numerics numerics;               ///< of the project as it is; empty = not measured
  /// What was looked for. Then only captures that the frames are painted from were baked: bytes and bake are
  /// extrapolated from these by their pixels.
  std::optional<Goals> goals;

  /// Nothing where there is none.
  const SweepPoint* find(const SweepSetting& setting) const;
  SweepPoint* find(const SweepSetting& setting);
};

/// Indices into Sweep::points, by objectivesOf.
std::vector<std::size_t> frontOf(const Sweep& sweep);

/// Of those that were measured the one that keeps the goals best (scoreOf); null where none was.
const SweepPoint* proposalOf(const Sweep& sweep, const Goals& goals);

/// Chosen from the front: `fast` has the quickest frames of those with at most three times the least error,
/// `balanced` is nearest of these to having the least error and the quickest frame and fewest bytes at once
/// (each by the share of the way from its least to its largest, the last two by their logarithms), `accurate`
/// has the least error; `proposal`, where there are goals, keeps these best. None where nothing was measured.
std::vector<SweepPreset> presetsOf(const Sweep& sweep);

/// Stable order of keys; ends with a line feed.
std::string toJson(const Sweep& sweep);
/// `where` names the file in messages.
Result<Sweep> parseSweep(const std::string& json, const std::string& where);
/// The presets in a sweep's file.
Result<std::vector<SweepPreset>> parsePresets(const std::string& json, const std::string& where);
/// One line a point; medians, and smallest and largest of what has a spread.
std::string toCsv(const Sweep& sweep);

}  // namespace acentric
