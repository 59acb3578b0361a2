#include "editor/session/truth_compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// Each of its pixels as a block of the picture's.
ColourImage enlarged(const ColourImage& small, int width, int height) {
  ColourImage out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.at(x, y) = small.at(x * small.width / width, y * small.height / height);
  return out;
}

/// `raysPerPixel` as in Truth.
std::shared_ptr<Truth> traced(const RayScene& rays, const PerspectiveView& view, const BakeSettings& bake,
                              float exposure, int raysPerPixel, TaskRunner& runner,
                              const std::stop_token& stop) {
  auto truth = std::make_shared<Truth>();
  truth->view = view;
  truth->raysPerPixel = raysPerPixel;
  if (raysPerPixel > 0) {
    truth->frame = renderTruth(rays, view, bake, exposure, raysPerPixel, runner, stop);
    return truth;
  }
  PerspectiveView coarse = view;
  coarse.width = std::max(1, view.width / kCoarseTruthPixels);
  coarse.height = std::max(1, view.height / kCoarseTruthPixels);
  const TruthFrame small = renderTruth(rays, coarse, bake, exposure, 1, runner, stop);
  truth->frame.colour = enlarged(small.colour, view.width, view.height);
  return truth;
}

}  // namespace

bool samePlace(const PerspectiveView& a, const PerspectiveView& b) {
  return a.eye == b.eye && a.yawRadians == b.yawRadians && a.pitchRadians == b.pitchRadians &&
         a.fovRadians == b.fovRadians;
}

bool sameSize(const PerspectiveView& a, const PerspectiveView& b) {
  return a.width == b.width && a.height == b.height;
}

std::string figuresText(const Compared& compared) {
  return trf("PSNR {:.1f} dB   SSIM {:.3f}   holes {} of pixels", compared.figures.psnr,
             compared.figures.ssim, ui::formatPercent(compared.figures.holeShare));
}

std::string againstText(const Compared& compared) {
  return trfMany("against {} ray per pixel, {}×{} pixels", "against {} rays per pixel, {}×{} pixels",
                 std::uint64_t(compared.raysPerPixel), compared.raysPerPixel, compared.width,
                 compared.height);
}

std::string describe(const Truth& truth) {
  if (truth.raysPerPixel == 0) return trf("truth, coarse: 1 ray for {0}×{0} pixels", kCoarseTruthPixels);
  return trfMany("truth, {} ray per pixel", "truth, {} rays per pixel", std::uint64_t(truth.raysPerPixel),
                 truth.raysPerPixel);
}

bool TruthCompare::Key::operator==(const Key& other) const {
  return rays == other.rays && bake == other.bake && exposure == other.exposure &&
         samePlace(view, other.view) && sameSize(view, other.view);
}

void TruthCompare::follow(const std::optional<CompareRequest>& wanted) {
  const auto forgetTruth = [this] {
    comparing_.abandon();
    truth_.reset();
    compared_.reset();
    askedFrame_.reset();
    askedTruth_.reset();
  };
  if (!wanted) {
    if (!key_) return;
    key_.reset();
    tracing_.abandon();
    return forgetTruth();
  }
  const Key key{wanted->open->rays, wanted->open->project.bake, wanted->exposure, wanted->view};
  const bool another = !key_ || !(*key_ == key);
  if (another || rays_ != wanted->raysPerPixel) {
    key_ = key;
    rays_ = wanted->raysPerPixel;
    // A truth that is coarser than what is asked for now is refined; a finer one is none of it.
    if (another || (truth_ && truth_->raysPerPixel > rays_)) forgetTruth();
    trace(key, truth_ ? truth_->raysPerPixel : -1, rays_);
  }
  if (compared_ && compared_->frame != wanted->frame) compared_.reset();
  compareNewest(wanted->frame);
}

/// The truths above `from` rays (-1: the coarse one too) up to `to`.
void TruthCompare::trace(const Key& key, int from, int to) {
  if (from == to) return tracing_.abandon();
  tracing_.restart(
      tr("Tracing the truth"), [this, key, from, to, threads = threads_](const Job::Context& context) {
        TaskRunner runner(threads - 1);
        for (const int rays : {0, 1, 4, 9, 16}) {
          if (rays <= from || rays > to) continue;
          if (rays == 9 && to > 9) continue;  // each begins anew: none that is hardly finer than the last
          auto truth = traced(*key.rays, key.view, key.bake, key.exposure, rays, runner, context.stop());
          if (context.stop().stop_requested()) return;
          context.post([this, truth = std::shared_ptr<const Truth>(std::move(truth))] { truth_ = truth; });
        }
      });
}

void TruthCompare::compareNewest(const std::shared_ptr<const Frame>& frame) {
  if (!frame || !truth_ || truth_->raysPerPixel == 0 || (frame == askedFrame_ && truth_ == askedTruth_))
    return;
  askedFrame_ = frame;
  askedTruth_ = truth_;
  comparing_.restart(
      tr("Comparing with the truth"), [this, frame, truth = truth_](const Job::Context& context) {
        const auto figures = compare(*frame, truth->frame.colour, truth->frame.rayDistance);
        if (!figures) return;  // of another size: the next frame is not
        auto compared = std::make_shared<const Compared>(
            Compared{*figures, truth->raysPerPixel, truth->view.width, truth->view.height, frame, truth});
        context.post([this, compared] { compared_ = compared; });
      });
}

}  // namespace acentric::editor
