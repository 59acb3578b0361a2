#include "engine/cli/attribution_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/geometry/conventions.h"
#include "engine/measure/compare.h"
#include "engine/measure/statistics.h"

namespace acentric::cli {
void AttributionReport::add(const Frame& frame, const TruthFrame& truth,
                            const Image<std::uint8_t>& viewDependent, const PerspectiveView& view) {
  sums_ += attribute(frame, truth.colour, truth.rayDistance, viewDependent);
  const double pixelsPerSample = view.focalPixels() * radians(1) / samplesPerDegree_;
  Frame limit = frame;
  limit.colour = atSampleRate(truth.colour, std::max(1.0, pixelsPerSample));
  limitSums_ += attribute(limit, truth.colour, truth.rayDistance, viewDependent);
  limitPsnr_.push_back(psnrOf(limit.colour, truth.colour));
  limitSsim_.push_back(ssimOf(limit.colour, truth.colour));
}

Json AttributionReport::json() const {
  Json sources = Json::object();
  for (std::size_t s = 0; s < kErrorSources; ++s) {
    const auto source = ErrorSource(s);
    sources[nameOf(source)] = {{"pixels", double(sums_.of(source).pixels) / double(sums_.pixels())},
                               {"error", sums_.share(source)},
                               {"errorAtLimit", shareAtLimit(source)},
                               {"psnrWithout", sums_.psnrWithout(source)}};
  }
  return {{"psnr", sums_.psnr()},
          {"sources", std::move(sources)},
          {"limit",
           {{"samplesPerDegree", samplesPerDegree_},
            {"psnr", spreadOf(limitPsnr_).median},
            {"ssim", spreadOf(limitSsim_).median}}}};
}

double AttributionReport::shareAtLimit(ErrorSource source) const {
  return sums_.squares() > 0 ? limitSums_.of(source).squares / sums_.squares() : 0;
}

std::string AttributionReport::text() const {
  std::string text = fmt::format(
      "  where the error is ({:.2f} dB over all frames)      pixels    error   at best   PSNR without\n",
      sums_.psnr());
  for (std::size_t s = 0; s < kErrorSources; ++s) {
    const auto source = ErrorSource(s);
    if (sums_.of(source).pixels == 0) continue;
    text += fmt::format("    {:<46} {:6.2f} % {:6.2f} %  {:6.2f} %   {:6.2f} dB\n", wordsFor(source),
                        100 * double(sums_.of(source).pixels) / double(sums_.pixels()),
                        100 * sums_.share(source), 100 * shareAtLimit(source), sums_.psnrWithout(source));
  }
  return text +
         fmt::format(
             "  at best, the truth itself at {:g} samples per degree: {:.2f} dB, SSIM {:.4f} (medians)\n",
             samplesPerDegree_, spreadOf(limitPsnr_).median, spreadOf(limitSsim_).median);
}

}  // namespace acentric::cli
