#pragma once
/// What a bake will take, said before it begins wherever one is begun: cameras, seconds, bytes, memory. What
/// is on disk already is left out.

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

/// Their numbers.
std::vector<int> allCamerasOf(const Layout& layout);

/// Of their captures together.
double pixelsOf(const OpenProject& open, std::span<const int> cameras);

/// What a bench bakes to measure it: more than once perhaps, and not to stay.
struct TrialBake {
  enum class Kept { onDisk, inMemory, letGo };

  int bakes = 1;                           ///< of all the share's cameras, one after the other
  double times = 1;                        ///< that these take as long as one, gathering light apart
  bool gathers = true;                     ///< else the light it sees was gathered for the share before it
  std::optional<double> packedBytes = {};  ///< its resolution is chosen so that its packs take so many
  Kept kept = Kept::onDisk;
};

/// What a bake has before it, of one storey.
struct BakeShare {
  const OpenProject* open = nullptr;
  std::vector<int> cameras;  ///< that are not on disk
  bool light = false;        ///< the surfaces' own is to be baked
  double previews = 0;       ///< that come before captures, in pixels over those of the captures
  std::optional<TrialBake> trial = {};
  bool any() const { return !cameras.empty() || light; }
};
/// As far as the names of files tell.
BakeShare missingOf(const OpenProject& open, const BakeRequest& request);
/// The same in a store of its own.
BakeShare missingOf(const OpenProject& open, const BakeRequest& request, const CaptureStore& store);

struct BakeForecastOptions {
  /// Takes some seconds, and may be wrong by half as much again; else as exact as estimateProjectBake().
  bool brief = true;
  bool glance = false;  ///< with brief: of fewer probes still, twice as wrong
  /// With brief: no further share is looked at after so many seconds, and those that are left are taken to be
  /// like those before. The first, then the largest come first.
  double enoughSeconds = std::numeric_limits<double>::infinity();
  static constexpr double kUsuallyEnough = 5;      ///< seconds, where the first view waits
  double effort = 1;                               ///< of all shares together, where it is not brief
  std::size_t memoryBytes = MemoryBudget::kUsual;  ///< as for the bake
};

struct BakeForecast {
  int cameras = 0;  ///< to be baked, in all of a bench's bakes
  int bakes = 0;    ///< of a bench; 0 = one that stays
  int lights = 0;   ///< storeys whose surfaces' light is to be baked
  int threads = 1;
  double captureSeconds = 0, lightSeconds = 0;  ///< with these threads, nothing else being done
  double captureBytes = 0, lightBytes = 0;      ///< on disk
  double packedBytes = 0;                       ///< of the captures, without previews
  double relativeError = 0;     ///< one standard deviation of the seconds, as far as the probes tell
  std::size_t memoryBytes = 0;  ///< at most, of captures until they are written; the scene comes on top
  double probeSeconds = 0;      ///< that the forecast itself took
  double seconds() const { return captureSeconds + lightSeconds; }
  double bytes() const { return captureBytes + lightBytes; }
  bool nothing() const { return cameras == 0 && lights == 0; }
  /// Of as many other cameras like these; light of surfaces in proportion.
  BakeForecast ofSoManyCameras(int others) const;
  /// What comes after it, with the same threads.
  BakeForecast& operator+=(const BakeForecast& next);
};
/// Is told what a bench's bakes will take, all of them together, before the first of them begins.
using BakeTeller = std::function<void(const BakeForecast&)>;

/// Bakes a little of each share to know. Nothing of it stays on disk.
Result<BakeForecast> forecastBake(std::span<const BakeShare> shares, const BakeForecastOptions& options,
                                  TaskRunner& runner, const Progress& progress = {},
                                  std::stop_token stop = {});

/// "12 cameras and light on surfaces to bake: about 1.3 min with 2 threads, 85.0 MB on disk, at most 1610.6
/// MB of memory besides the scene"; of a bench "48 cameras in 6 bakes to bake: ...". One line for a person.
std::string describe(const BakeForecast& forecast);

}  // namespace acentric
