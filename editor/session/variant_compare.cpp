#include "editor/session/variant_compare.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "editor/session/engine_texts.h"
#include "editor/session/truth_compare.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/view/view_cameras.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

Result<std::shared_ptr<WalkStream>> streamOf(const OpenProject& open, std::size_t memoryBytes) {
  auto start = startWalk(open, nullptr);
  if (!start) return tl::unexpected(start.error());
  WalkStreamOptions options;
  options.memoryBytes = memoryBytes;
  options.threads = 0;
  return std::make_shared<WalkStream>(std::move(*start), options);
}

Result<Frame> frameOf(const OpenProject& open, WalkStream& stream, const PerspectiveView& view,
                      TaskRunner& runner, const std::stop_token& stop) {
  ViewSettings settings = open.project.view;
  settings.renderer = withoutOpenGl(settings.renderer);
  const ViewCameras needed = camerasOf(*open.layout, view, settings);
  if (needed.region < 0)
    return fail(ErrorKind::notFound, tr("the kept variant has no cell where the eye is"));
  if (Status there = stream.complete(needed.cameras, std::span(&needed.region, 1), runner, {}, stop); !there)
    return tl::unexpected(there.error());
  auto frame = renderFrame(stream.walk()->walk, view, settings, runner);
  if (frame && frame->stats.missingImages > 0)
    return fail(ErrorKind::notFound, tr("captures of the kept variant that are seen here are not on disk"));
  return frame;
}

std::string figuresText(const char* name, const Comparison& figures, std::span<const std::uint64_t> bytes) {
  return trf("{} {:.1f} dB   {}   {} cameras", name, figures.psnr,
             ui::formatBytes(std::accumulate(bytes.begin(), bytes.end(), std::uint64_t(0))), bytes.size());
}

}  // namespace

std::string keptText(const VariantFigures& figures) {
  return figuresText(tr("kept"), figures.kept, figures.keptBytes);
}

std::string nowText(const VariantFigures& figures, std::span<const std::uint64_t> bytes) {
  return figuresText(tr("now"), figures.now, bytes);
}

bool VariantCompare::Key::operator==(const Key& other) const {
  return kept == other.kept && samePlace(view, other.view) && sameSize(view, other.view);
}

void VariantCompare::clear() {
  drawing_.abandon();
  comparing_.abandon();
  key_.reset();
  frame_.reset();
  figures_.reset();
  askedFrame_.reset();
  problem_.clear();
}

void VariantCompare::keep(std::shared_ptr<const OpenProject> variant) {
  clear();
  stream_.reset();
  kept_ = std::move(variant);
}

void VariantCompare::forget() { keep(nullptr); }

void VariantCompare::follow(const std::optional<VariantRequest>& wanted) {
  if (!wanted || !kept_) {
    if (key_) clear();
    return;
  }
  const Key key{kept_, wanted->view};
  if (!key_ || !(*key_ == key)) {
    clear();
    key_ = key;
    draw(key, wanted->memoryBytes);
  }
  compare(*wanted);
}

void VariantCompare::draw(const Key& key, std::size_t memoryBytes) {
  drawing_.restart(tr("Drawing the kept variant"), [this, key, memoryBytes, stream = stream_,
                                                    threads = threads_](const Job::Context& context) {
    TaskRunner runner(threads - 1);
    const auto fail = [&](const Error& error) {
      if (error.kind != ErrorKind::cancelled)
        context.post([this, text = engineText(error)] { problem_ = text; });
    };
    auto own = stream;
    if (!own) {
      auto made = streamOf(*key.kept, memoryBytes);
      if (!made) return fail(made.error());
      own = std::move(*made);
      context.post([this, own] { stream_ = own; });
    }
    auto frame = frameOf(*key.kept, *own, key.view, runner, context.stop());
    if (!frame) return fail(frame.error());
    context.post([this, drawn = std::make_shared<const Frame>(std::move(*frame))] { frame_ = drawn; });
  });
}

/// As soon as both frames are there.
void VariantCompare::compare(const VariantRequest& wanted) {
  if (!frame_ || !wanted.frame || wanted.frame == askedFrame_) return;
  askedFrame_ = wanted.frame;
  figures_.reset();
  comparing_.restart(tr("Comparing variants"), [this, wanted, kept = kept_, frame = frame_,
                                                threads = threads_](const Job::Context& context) {
    TaskRunner runner(threads - 1);
    const Project& project = wanted.now->project;
    const TruthFrame truth = renderTruth(*wanted.now->rays, wanted.view, project.bake, project.exposure,
                                         kTruthRays, runner, context.stop());
    if (context.stop().stop_requested()) return;
    const auto before = acentric::compare(*frame, truth.colour, truth.rayDistance);
    const auto now = acentric::compare(*wanted.frame, truth.colour, truth.rayDistance);
    if (!before || !now) return;  // of another size: the next frame is not
    const auto figures =
        std::make_shared<const VariantFigures>(VariantFigures{*before, *now, capturesOnDisk(*kept).bytes});
    context.post([this, figures] { figures_ = figures; });
  });
}

}  // namespace acentric::editor
