#include "engine/bench/merged_bake.h"

#include <algorithm>
#include <list>

#include "engine/image/merge_captures.h"
#include "engine/pipeline/bake_plan.h"

namespace acentric {
namespace {

constexpr std::uint32_t kMethodVersion = 1;
constexpr MergeTolerance kTolerance;

/// A merged capture depends on all that were baked before it in its set.
std::vector<ContentKey> mergedKeys(const std::vector<ContentKey>& plain, std::size_t together) {
  std::vector<ContentKey> merged;
  for (std::size_t camera = 0; camera < plain.size(); ++camera) {
    Hasher hasher;
    hasher.text("merged").value(kMethodVersion).value(kTolerance.share);
    for (std::size_t other = camera / together * together; other <= camera; ++other)
      hasher.value(plain[other].high).value(plain[other].low);
    merged.push_back(hasher.finish());
  }
  return merged;
}

/// Takes the captures of one set after the other.
class MergingSink final : public CaptureSink {
 public:
  MergingSink(const CaptureStore& store, const OpenProject& open, std::size_t together)
      : store_(store),
        colourQuality_(open.project.bake.colourQuality),
        plain_(open.keys),
        merged_(mergedKeys(open.keys, together)),
        together_(together) {
    plan_ = planStorey(open);
  }

  bool has(const ContentKey& key) const override {
    const std::size_t first = numberOf(key) / together_ * together_;
    for (std::size_t n = first; n < first + together_; ++n)
      if (!store_.has(merged_[n])) return false;
    return true;
  }
  Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) override {
    const std::size_t n = numberOf(key);
    if (n / together_ != set_) earlier_.clear(), set_ = n / together_;
    std::vector<const Capture*> earlier;
    for (const Capture& other : earlier_) earlier.push_back(&other);
    Capture own = capture;
    dropShown(own, earlier, kTolerance);
    if (Status put = store_.put(merged_[n], own, stop, colourQuality_); !put) return put;
    earlier_.push_back(std::move(own));
    return store_.putRecord(merged_[n], plan_.cameras[n].subject, plan_.cameras[n].parts);
  }

 private:
  std::size_t numberOf(const ContentKey& key) const {
    return std::size_t(std::ranges::find(plain_, key) - plain_.begin());
  }

  const CaptureStore& store_;
  int colourQuality_;
  StoreyPlan plan_;
  std::vector<ContentKey> plain_, merged_;
  std::size_t together_;
  std::size_t set_ = 0;  ///< whose captures are in earlier_
  std::list<Capture> earlier_;
};

}  // namespace

CaptureBake mergedBake(const Workplace& at, std::function<Result<OpenProject>(double)> open,
                       std::size_t together) {
  CaptureBake merged;
  merged.together = together;
  merged.at = std::move(open);
  merged.bake = [&at, together](const OpenProject& project, const std::vector<int>& cameras,
                                const CaptureStore& store) -> Result<double> {
    MergingSink sink(store, project, together);
    const auto report = bake(*project.rays, *project.layout, cameras, project.project.bake, sink, at.runner,
                             at.progress, at.stop);
    if (!report) return tl::unexpected(report.error());
    return report->seconds;
  };
  merged.keys = [together](const OpenProject& project) { return mergedKeys(project.keys, together); };
  return merged;
}

}  // namespace acentric
