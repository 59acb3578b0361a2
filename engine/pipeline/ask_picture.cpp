#include "engine/pipeline/ask_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/bake/preview.h"
#include "engine/geometry/conventions.h"
#include "engine/inspect/capture_reach.h"
#include "engine/inspect/sampling_rate.h"

namespace acentric {
namespace {

constexpr double kLeastGain = 0.1;  ///< dB

template <class Pixel>
Image<Pixel> cropped(const Image<Pixel>& image, const PixelRect& part) {
  Image<Pixel> out(part.width(), part.height());
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.at(x, y) = image.at(part.x0 + x, part.y0 + y);
  return out;
}

std::optional<SurfacePoint> surfaceAt(const OpenProject& open, const PerspectiveView& view,
                                      const glm::ivec2& pixel) {
  const glm::dvec3 direction = view.rayThrough(pixel.x + 0.5, pixel.y + 0.5);
  const PreviewSeen seen = PreviewTracer(open.rays).along({glm::vec3(view.eye), glm::vec3(direction)});
  if (!seen.found()) return std::nullopt;
  return SurfacePoint{view.eye + double(seen.distance) * direction, glm::dvec3(seen.normal), seen.mesh,
                      seen.triangle};
}

/// How a camera serves an eye that looks at the surface.
PixelPainter paintingBy(int camera, const OpenProject& open, const PerspectiveView& view,
                        const SurfacePoint& surface) {
  const ColumnCamera columns = columnCameraFor(open.layout->cameras[std::size_t(camera)], *open.layout,
                                               open.scene->bounds, open.project.bake);
  const SurfaceAxes axes = axesOf(surface.normal);
  const glm::dvec3 toCamera = columns.centreOfProjection - surface.position,
                   toEye = view.eye - surface.position;
  PixelPainter painter;
  painter.camera = camera;
  painter.metres = glm::length(toCamera);
  const double cosine = glm::dot(toCamera, toEye) / std::max(1e-12, painter.metres * glm::length(toEye));
  painter.radians = std::acos(std::clamp(cosine, -1.0, 1.0));
  painter.samplesPerPixel = compareRates(samplesPerMetre(columns, surface.position, axes),
                                         pixelsPerMetre(view.eye, view.focalPixels(), surface.position, axes))
                                .ratio();
  return painter;
}

/// Of the samples in the point's pixel of the capture, from the camera outwards, the place of the one that is
/// nearest to the point. A patch reaches past its outermost samples: where that pixel has none, those around
/// it are asked. 0 where there is none either.
int layerOf(const DisplayCapture& capture, const glm::dvec3& point) {
  const ColumnCamera& camera = capture.camera;
  const glm::dvec3 offset = point - camera.centreOfProjection;
  const double horizontal = glm::length(glm::dvec2(offset));
  if (horizontal <= 0) return 0;
  const double fromMiddle =
      std::remainder(std::atan2(offset.y, offset.x) - camera.lowAzimuth - camera.fovRadians / 2, kTwoPi);
  const int column = int(std::floor((fromMiddle + camera.fovRadians / 2) / camera.columnPitch()));
  const int row =
      int(std::floor((camera.topElevation - std::atan2(offset.z, horizontal)) / camera.rowPitch()));
  const auto layerIn = [&](int c, int r) {
    if (c < 0 || c >= camera.columns || r < 0 || r >= camera.rows) return 0;
    std::vector<double> inverse;
    for (std::size_t i = capture.columnStart[std::size_t(c)]; i < capture.columnStart[std::size_t(c) + 1];
         ++i)
      if (capture.samples[i].row == std::uint32_t(r))
        inverse.push_back(inverseDistanceOf(capture.samples[i]));
    if (inverse.empty()) return 0;
    std::ranges::sort(inverse, std::greater());
    const auto away = [own = 1 / horizontal](double each) { return std::abs(each - own); };
    return int(std::ranges::min_element(inverse, {}, away) - inverse.begin()) + 1;
  };
  if (const int layer = layerIn(column, row); layer > 0) return layer;
  for (int c = column - 1; c <= column + 1; ++c)
    for (int r = row - 1; r <= row + 1; ++r)
      if (const int layer = layerIn(c, r); layer > 0) return layer;
  return 0;
}

double squaresOf(const ColourImage& a, const ColourImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 difference = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    sum += glm::dot(difference, difference);
  }
  return sum;
}

/// What the truth loses where its samples lie so far apart.
double lostAt(const ColourImage& truth, double samplesPerPixel) {
  return squaresOf(truth, atSampleRate(truth, std::max(1.0, 1 / std::max(samplesPerPixel, 1e-3))));
}

// ------------------------------------------------------------------ what may be changed

struct Candidate {
  std::string what, why;
  Project project;
  bool closesHoles = false;
  double texels = 1;  ///< squares of what baked light gets wrong, times this
};

std::string metresText(double metres) { return fmt::format("{:.3g} m", metres); }

Candidate finer(const Project& project) {
  const double now = project.bake.samplesPerDegree;
  Candidate c{"", "finer captures everywhere", project};
  c.project.bake.samplesPerDegree = std::min(64.0, std::round(now * 1.5 * 10) / 10);
  c.what = fmt::format("samples per degree {:g} to {:g}", now, c.project.bake.samplesPerDegree);
  return c;
}

/// The same where the eye stands alone; nothing where more cannot be.
std::optional<Candidate> finerHere(const OpenProject& open, int region) {
  if (region < 0) return std::nullopt;
  const CellId cell = open.layout->regions[std::size_t(region)].id;
  Candidate c{"", "finer captures for this cell alone", open.project};
  LayoutSpec& spec = c.project.layout();
  const double before = densityOf(spec, cell), now = std::min(kMostRegionDensity, 1.5 * before);
  spec.density[cell] = now;
  c.what = fmt::format("samples per degree here times {:.3g}", now / before);
  return c;
}

/// Cameras nearer to the eye: four cells in place of one where that can be, else smaller ones everywhere.
Candidate nearer(const OpenProject& open, int region) {
  Candidate c{"", "cameras nearer to the eye", open.project};
  LayoutSpec& spec = c.project.layout();
  const CellId* cell = region >= 0 ? &open.layout->regions[std::size_t(region)].id : nullptr;
  if (cell != nullptr && canSplit(spec.configuration) && cell->slot == 0 && cell->level < kMaxLevel) {
    spec.split.insert(*cell);
    c.what = fmt::format("split the cell ({}, {}) into four", cell->i, cell->j);
    return c;
  }
  const double now = spec.cellSize;
  spec.cellSize = std::max(kLeastCellSize, now * 0.7);
  c.what = fmt::format("cell size {} to {}", metresText(now), metresText(spec.cellSize));
  return c;
}

std::optional<Candidate> asPolygons(const OpenProject& open, const PictureAnswer& answer) {
  if (!answer.surface || answer.region < 0) return std::nullopt;
  const Region& region = open.layout->regions[std::size_t(answer.region)];
  const double now = open.project.layout().nearBand;
  constexpr double kFarthest = 3, kStep = 0.1;  ///< metres; the first also times the band of now
  const double most = std::max(kFarthest, kFarthest * now);
  double band = now;
  while (band <= most && !region.polygon.grown(band).containsClosed(glm::dvec2(answer.surface->position)))
    band = std::floor(band / kStep + 1.5) * kStep;
  if (band == now || band > most) return std::nullopt;
  Candidate c{"", "the surface is drawn as polygons", open.project};
  c.project.layout().nearBand = band;
  c.what = fmt::format("near band {} to {}", metresText(now), metresText(c.project.layout().nearBand));
  return c;
}

std::vector<Candidate> moreHidden(const Project& project) {
  std::vector<Candidate> all;
  const BakeSettings& bake = project.bake;
  constexpr int kMostLayers = 64;
  if (bake.maxLayers < kMostLayers) {
    Candidate c{"", "more of what lies behind", project, true};
    c.project.bake.maxLayers = std::min(kMostLayers, 2 * bake.maxLayers);
    c.what = fmt::format("layers {} to {}", bake.maxLayers, c.project.bake.maxLayers);
    all.push_back(std::move(c));
  }
  if (bake.pruning && bake.testEyes < kMostTestEyes) {
    Candidate c{"", "pruning looks from more places", project, true};
    c.project.bake.testEyes = std::min(kMostTestEyes, 2 * bake.testEyes);
    c.project.bake.pruningLoss = bake.pruningLoss / 2;
    c.what = fmt::format("test eyes {} to {}, half the pruning loss", bake.testEyes, c.project.bake.testEyes);
    all.push_back(std::move(c));
  }
  return all;
}

Candidate finerLight(const Project& project) {
  const double now = project.bake.surfaceTexel;
  Candidate c{"", "finer light on near surfaces", project};
  c.project.bake.surfaceTexel = std::max(0.002, now / 2);
  c.texels = std::pow(c.project.bake.surfaceTexel / now, 2);
  c.what = fmt::format("surface texel {} to {}", metresText(now), metresText(c.project.bake.surfaceTexel));
  return c;
}

std::vector<Candidate> candidatesFor(const OpenProject& open, const PictureAnswer& answer) {
  std::vector<Candidate> all;
  const auto wrong = [&](ErrorSource source) { return answer.here.of(source).squares > 0; };
  if (answer.painter) {
    if (auto here = finerHere(open, answer.region)) all.push_back(std::move(*here));
    all.push_back(finer(open.project));
    all.push_back(nearer(open, answer.region));
    if (auto band = asPolygons(open, answer)) all.push_back(std::move(*band));
  }
  if (wrong(ErrorSource::holes)) std::ranges::move(moreHidden(open.project), std::back_inserter(all));
  if (wrong(ErrorSource::polygons)) all.push_back(finerLight(open.project));
  std::erase_if(all, [&](const Candidate& c) { return c.project == open.project || !c.project.check(); });
  return all;
}

// ------------------------------------------------------------------ what it promises

/// By the camera that serves the eye best, of those that the region draws the surface from.
std::optional<PixelPainter> paintingIn(const OpenProject& open, const PictureAnswer& answer) {
  const auto region = open.layout->regionAt(glm::dvec2(answer.view.eye));
  if (!region) return std::nullopt;
  std::optional<PixelPainter> best;
  for (const Cover& cover : drawnCovers(*open.layout, *region))
    if (const Piece* piece = pieceAt(cover, glm::dvec2(answer.surface->position))) {
      const PixelPainter painter = paintingBy(piece->camera, open, answer.view, *answer.surface);
      if (!best || painter.samplesPerPixel > best->samplesPerPixel) best = painter;
    }
  return best;
}

double promiseOf(const OpenProject& open, const PictureAnswer& answer, const Candidate& candidate) {
  Attribution after = answer.here;
  const auto times = [&after](ErrorSource source, double factor) {
    after.parts[std::size_t(source)].squares *= factor;
  };
  if (candidate.closesHoles) times(ErrorSource::holes, 0);
  times(ErrorSource::polygons, candidate.texels);
  if (!answer.surface || !answer.painter) return after.psnr();
  const auto region = open.layout->regionAt(glm::dvec2(answer.view.eye));
  const glm::dvec2 place(answer.surface->position);
  if (region && open.layout->regions[std::size_t(*region)].grown.containsClosed(place)) {
    times(ErrorSource::resampling, 0);
    times(ErrorSource::silhouettes, 0);
  } else if (const auto painter = paintingIn(open, answer)) {
    constexpr std::array kCaptured{ErrorSource::resampling, ErrorSource::silhouettes,
                                   ErrorSource::viewDependent};
    double captured = 0;
    for (const ErrorSource source : kCaptured) captured += after.of(source).squares;
    const double now = lostAt(answer.truthHere, answer.painter->samplesPerPixel);
    const double gained = std::max(0.0, now - lostAt(answer.truthHere, painter->samplesPerPixel));
    // No more than there is, what is wrong beside the sampling stays so; and edges, which are most of it, get
    // no better than with the square of the rate.
    const double rates = answer.painter->samplesPerPixel / std::max(painter->samplesPerPixel, 1e-9);
    const double least = std::min(1.0, rates * rates);
    const double stays = captured > 0 ? std::max(least, 1 - gained / std::max(now, captured)) : 1;
    for (const ErrorSource source : kCaptured) times(source, stays);
    const double angle = answer.painter->radians > 0 ? painter->radians / answer.painter->radians : 1;
    times(ErrorSource::viewDependent, std::min(1.0, angle * angle));
  }
  return after.psnr();
}

}  // namespace

Result<PictureAnswer> askPicture(const OpenProject& open, const WalkScene& walk, const Frame& frame,
                                 const PerspectiveView& view, const glm::ivec2& pixel, TaskRunner& runner,
                                 const std::stop_token& stop) {
  const bool fits = frame.colour.width == view.width && frame.colour.height == view.height &&
                    frame.source.width == view.width && frame.source.height == view.height;
  if (!fits || pixel.x < 0 || pixel.y < 0 || pixel.x >= view.width || pixel.y >= view.height)
    return fail(ErrorKind::invalidArgument, fmt::format("({}, {}) is no pixel of a frame of {}x{}", pixel.x,
                                                        pixel.y, view.width, view.height));
  if (walk.captures.size() != open.layout->cameras.size() || walk.local.size() != open.layout->regions.size())
    return fail(ErrorKind::invalidArgument, "the frame is of another layout");
  const PixelRect around{std::max(pixel.x - kAskedPixels, 0), std::max(pixel.y - kAskedPixels, 0),
                         std::min(pixel.x + kAskedPixels + 1, view.width),
                         std::min(pixel.y + kAskedPixels + 1, view.height)};
  TruthFrame truth =
      renderTruth(*open.rays, view, around, open.project.bake, walk.exposure, kAskedRays, runner, stop);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");

  PictureAnswer answer;
  answer.view = view;
  answer.pixel = pixel;
  answer.source = frame.source.at(pixel.x, pixel.y);
  answer.shown = frame.colour.at(pixel.x, pixel.y);
  answer.truth = truth.colour.at(pixel.x - around.x0, pixel.y - around.y0);
  answer.surface = surfaceAt(open, view, pixel);
  answer.here = attribute({cropped(frame.colour, around), cropped(frame.source, around), {}}, truth.colour,
                          truth.rayDistance, viewDependentPixels(*open.rays, view, around, runner));
  answer.truthHere = std::move(truth.colour);

  if (const auto region = open.layout->regionAt(glm::dvec2(view.eye))) {
    answer.region = *region;
    const auto& local = walk.local[std::size_t(*region)];
    answer.triangles = local ? local->triangles.size() : 0;
  }
  const int camera = int(answer.source) - 1;
  const bool captured = answer.source != kSourceHole && answer.source < kSourceBackground &&
                        camera < int(open.layout->cameras.size());
  if (!captured || !answer.surface) return answer;
  answer.painter = paintingBy(camera, open, view, *answer.surface);
  if (const auto& capture = walk.captures[std::size_t(camera)])
    answer.painter->layer = layerOf(*capture, answer.surface->position);
  return answer;
}

Result<std::vector<Improvement>> improvementsOf(const OpenProject& open, const PictureAnswer& answer,
                                                std::size_t most, const ImportHost& host, TaskRunner& runner,
                                                const std::stop_token& stop) {
  struct Promised {
    Improvement improvement;
    OpenProject open;
  };
  std::vector<Promised> promised;
  for (Candidate& candidate : candidatesFor(open, answer)) {
    auto changed = reopenProject(open, candidate.project, host, {}, stop);
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    if (!changed) continue;  // a layout that cannot be: no way out
    const double psnr = promiseOf(*changed, answer, candidate);
    if (psnr < answer.here.psnr() + kLeastGain) continue;
    promised.push_back(
        {{std::move(candidate.what), std::move(candidate.why), psnr, std::move(candidate.project), {}},
         std::move(*changed)});
  }
  std::ranges::stable_sort(promised, std::greater(),
                           [](const Promised& each) { return each.improvement.psnrHere; });
  if (promised.size() > most) promised.resize(most);
  std::vector<Improvement> best;
  for (Promised& each : promised) {
    const BakeShare missing = missingOf(each.open, {});
    const auto bake = forecastBake({&missing, 1}, {.glance = true}, runner, {}, stop);
    if (!bake) return tl::unexpected(bake.error());
    each.improvement.bake = *bake;
    best.push_back(std::move(each.improvement));
  }
  return best;
}

}  // namespace acentric
