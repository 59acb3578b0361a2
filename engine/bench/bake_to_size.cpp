#include "engine/bench/bake_to_size.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace acentric {
namespace {

/// Cameras of some of what is baked together, evenly chosen.
std::vector<int> partOf(std::size_t cameras, std::size_t together) {
  const std::size_t sets = cameras / together, chosen = (sets + kSizingPart - 1) / kSizingPart;
  std::vector<int> part;
  for (std::size_t n = 0; n < chosen; ++n)
    for (std::size_t k = 0; k < together; ++k)
      part.push_back(int((2 * n + 1) * sets / (2 * chosen) * together + k));
  return part;
}

class Sizing {
 public:
  Sizing(const Workplace& at, const std::string& name, const CaptureBake& captures, CaptureStore store)
      : at_(at), name_(name), captures_(captures), store_(std::move(store)) {}

  /// What an earlier run of the same left.
  struct Earlier {
    BakeNote note;       ///< else a new one, with the project's samples per degree
    bool known = false;  ///< it left a note
    bool whole = false;  ///< and all that it baked is still there
  };
  Result<Earlier> lookUp(std::optional<double> target, double tolerance) const {
    const double own = at_.open.project.bake.samplesPerDegree;
    const auto first = captures_.at(own);
    if (!first) return tl::unexpected(first.error());
    Hasher made;
    made.text("representation").text(name_).value(target.value_or(0)).value(tolerance);
    for (const ContentKey& key : captures_.keys(*first)) made.value(key.high).value(key.low);
    Earlier earlier{{made.finish(), own, 0}};
    const auto note = readNote(at_, name_, earlier.note.key);
    if (!note) return earlier;
    const auto open = captures_.at(note->samplesPerDegree);
    if (!open) return tl::unexpected(open.error());
    const auto keys = captures_.keys(*open);
    return Earlier{*note, true,
                   std::ranges::all_of(keys, [&](const ContentKey& key) { return store_.has(key); })};
  }

  Result<SizedCaptures> run(std::optional<double> target, double tolerance) {
    auto earlier = lookUp(target, tolerance);
    if (!earlier) return tl::unexpected(earlier.error());
    auto& [note, known, reused] = *earlier;
    if (!known && target) {
      const auto fitted = fitResolution(
          note.samplesPerDegree, *target, tolerance, [&](double s) { return bytesOfPart(s); },
          [&](double s) { return bytesOfAll(s); });
      if (!fitted) return tl::unexpected(fitted.error());
      note.samplesPerDegree = *fitted;
    }
    if (!reused) {
      // What a try baked already counts with the time that it took.
      if (const auto bytes = bytesOfAll(note.samplesPerDegree); !bytes) return tl::unexpected(bytes.error());
      note.seconds = seconds_[note.samplesPerDegree];
    }
    auto open = captures_.at(note.samplesPerDegree);
    if (!open) return tl::unexpected(open.error());
    open->keys = captures_.keys(*open);
    const auto bytes = packedBytes(store_, open->keys);
    if (!bytes) return tl::unexpected(bytes.error());
    SizedCaptures sized{std::move(*open), store_, {}};
    sized.cost.samplesPerDegree = note.samplesPerDegree;
    sized.cost.cameras = int(sized.open.keys.size());
    sized.cost.captureBytes = *bytes;
    sized.cost.bakeSeconds = note.seconds;
    sized.cost.reused = reused;
    if (Status written = writeNote(at_, name_, note); !written) return tl::unexpected(written.error());
    return sized;
  }

 private:
  Result<double> bytesOf(const OpenProject& open, const std::vector<int>& cameras, double& seconds) {
    const auto took = captures_.bake(open, cameras, store_);
    if (!took) return tl::unexpected(took.error());
    seconds += *took;
    const auto all = captures_.keys(open);
    std::vector<ContentKey> keys;
    for (const int camera : cameras) keys.push_back(all[std::size_t(camera)]);
    const auto bytes = packedBytes(store_, keys);
    if (!bytes) return tl::unexpected(bytes.error());
    return double(*bytes);
  }
  Result<double> bytesOfPart(double samplesPerDegree) {
    const auto open = captures_.at(samplesPerDegree);
    if (!open) return tl::unexpected(open.error());
    const auto part = partOf(open->keys.size(), captures_.together);
    double seconds = 0;
    const auto bytes = bytesOf(*open, part, seconds);
    if (!bytes) return bytes;
    return *bytes * double(open->keys.size()) / double(part.size());
  }
  Result<double> bytesOfAll(double samplesPerDegree) {
    const auto open = captures_.at(samplesPerDegree);
    if (!open) return tl::unexpected(open.error());
    // Nothing of earlier tries: the time is that of all.
    if (!seconds_.contains(samplesPerDegree)) store_.prune(captures_.keep);
    std::vector<int> all(open->keys.size());
    std::iota(all.begin(), all.end(), 0);
    return bytesOf(*open, all, seconds_[samplesPerDegree]);
  }

  const Workplace& at_;
  const std::string& name_;
  const CaptureBake& captures_;
  CaptureStore store_;
  std::map<double, double> seconds_;  ///< of whole bakes, by samples per degree
};

}  // namespace

CaptureBake plainBake(const Workplace& at, std::function<Result<OpenProject>(double)> open) {
  CaptureBake bake;
  bake.at = std::move(open);
  bake.bake = [&at](const OpenProject& project, const std::vector<int>& cameras,
                    const CaptureStore& store) -> Result<double> {
    BakeRequest request;
    request.cameras = cameras;
    request.surfaceLight = false;
    const auto report = bakeProject(project, request, store, at.runner, at.progress, at.stop);
    if (!report) return tl::unexpected(report.error());
    return report->captures.seconds;
  };
  bake.keys = [](const OpenProject& project) { return project.keys; };
  return bake;
}

Result<bool> isBakedToSize(const Workplace& at, const std::string& name, const CaptureBake& captures,
                           std::optional<double> target, double tolerance) {
  const auto folder = captureFolderFor(at.fileOf(name));
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return false;  // asking makes none
  auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  const auto earlier = Sizing(at, name, captures, std::move(*store)).lookUp(target, tolerance);
  if (!earlier) return tl::unexpected(earlier.error());
  return earlier->whole;
}

Result<SizedCaptures> bakeToSize(const Workplace& at, const std::string& name, const CaptureBake& captures,
                                 std::optional<double> target, double tolerance) {
  if (target && !(*target > 0))
    return fail(ErrorKind::invalidArgument, "the bytes to be taken are less than what must be there anyway",
                name);
  auto store = openCaptures(at.fileOf(name));
  if (!store) return tl::unexpected(store.error());
  return Sizing(at, name, captures, std::move(*store)).run(target, tolerance);
}

}  // namespace acentric
