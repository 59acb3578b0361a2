#include "engine/cli/sweep_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/stopwatch.h"
#include "engine/bench/numerics.h"
#include "engine/cli/bake_notice.h"
#include "engine/cli/seam_report.h"
#include "engine/measure/compare.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/view/view_cameras.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

constexpr double kEffort = 0.3;      ///< of an estimate: settings are many
constexpr int kMostThumbnail = 480;  ///< pixels across
constexpr double kRounding = 1e-4;   ///< metres by which an eye may stand outside

/// Means of squares of pixels, as many as make it no wider than a thumbnail.
ColourImage thumbnailOf(const ColourImage& picture) {
  const int side = (picture.width + kMostThumbnail - 1) / kMostThumbnail;
  if (side < 2) return picture;
  ColourImage small(picture.width / side, picture.height / side);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      glm::ivec4 sum(0);
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) sum += glm::ivec4(picture.at(x * side + i, y * side + j));
      small.at(x, y) = Rgba8(sum / (side * side));
    }
  return small;
}

/// Letters that any file system takes.
std::string fileNameOf(const SweepSetting& setting) {
  std::string name = setting.empty() ? "as-it-is" : "";
  for (const KnobChoice& choice : setting)
    name += (name.empty() ? "" : "_") + choice.knob + "-" + choice.value;
  return name;
}

const SweepPoint* sameBake(const Sweep& known, const std::string& key) {
  const auto found = std::ranges::find_if(
      known.points, [&](const SweepPoint& p) { return p.measured() && p.bakeKey == key; });
  return found == known.points.end() ? nullptr : &*found;
}

Spread single(double value) { return {value, value, value, value, 1}; }

}  // namespace

Result<std::unique_ptr<SweepRun>> SweepRun::start(PathWalk walk, const BakeSettings& truthBake,
                                                  SweepRunOptions options, const Common& common,
                                                  TaskRunner& runner) {
  const fs::path project = walk.storeys.front().file;
  walk.storeys.front().file = options.folder / "sweep.acentric.json";  // so its captures are in the folder
  std::unique_ptr<SweepRun> run(new SweepRun(std::move(walk), std::move(options), common, runner));
  const OpenProject& open = run->walk_.storeys.front();
  auto store = openCaptures(open.file);
  if (!store) return tl::unexpected(store.error());
  run->store_ = std::move(*store);
  std::error_code error;
  if (fs::is_directory(captureFolderFor(project), error)) {
    auto original = CaptureStore::open(captureFolderFor(project));
    if (!original) return tl::unexpected(original.error());
    run->original_ = std::move(*original);
  }
  fs::create_directories(run->options_.folder / "pictures", error);
  for (std::size_t i = 0; i < run->views_.size(); ++i) {
    if (Status on = run->goOn(i, run->views_.size(), "tracing the truth"); !on)
      return tl::unexpected(on.error());
    run->truth_.push_back(renderTruth(*open.rays, run->views_[i], truthBake, open.project.exposure,
                                      run->options_.truthSamples, runner, common.stop));
    const auto file = run->options_.folder / "pictures" / fmt::format("truth-{}.jpg", i);
    if (Status written = writeColourImage(thumbnailOf(run->truth_.back().colour), file); !written)
      return tl::unexpected(written.error());
  }
  return run;
}

Status SweepRun::goOn(std::size_t done, std::size_t total, const char* what) const {
  if (common_.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
  if (common_.progress) common_.progress({double(done), double(total), now_.empty() ? what : now_});
  return {};
}

Status SweepRun::outsideOf(const Layout& layout) const {
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const glm::dvec2 eye(views_[i].eye);
    if (glm::distance(clampToPlan(layout, eye), eye) > kRounding)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("frame {} of the path stands outside its regions", i));
  }
  return {};
}

Result<SweepRun::Prospect> SweepRun::foretell(const SweepSetting& setting, const Sweep& known) {
  now_ = textOf(setting);
  Prospect prospect;
  const OpenProject& base = walk_.storeys.front();
  const auto project = applySetting(base.project, setting);
  auto open = project ? reopenProject(base, *project, common_.host, common_.progress, common_.stop)
                      : Result<OpenProject>(tl::unexpected(project.error()));
  Status fits = open ? outsideOf(*open->layout) : Status(tl::unexpected(open.error()));
  if (!fits) {
    if (fits.error().kind == ErrorKind::cancelled) return tl::unexpected(fits.error());
    prospect.whyNot = fits.error().message;
    return prospect;
  }
  prospect.bakeKey = bakeKeyOf(*open);
  if (Status taken = adopt(*open); !taken) return tl::unexpected(taken.error());
  if (options_.viewsOnly) {
    prospect.open = std::move(*open);
    foretellViews(prospect);
    return prospect;
  }
  const auto there = std::ranges::count_if(open->keys, [&](const auto& key) { return store_->has(key); });
  const bool light = store_->hasSurfaceLight(open->surfaceLightKey);
  const double missing = open->keys.empty() ? 0 : 1 - double(there) / double(open->keys.size());
  const SweepPoint* before = sameBake(known, prospect.bakeKey);
  if (before && missing == 0 && light) {
    prospect.bakeSeconds = (*before)[Measure::bakeSeconds].median;
  } else {
    auto forecast = forecastAll(*open);
    if (!forecast) return tl::unexpected(forecast.error());
    prospect.bakeSeconds = forecast->seconds();
    forecast->cameras -= int(there);
    forecast->captureSeconds *= missing, forecast->captureBytes *= missing;
    if (light) forecast->lights = 0, forecast->lightSeconds = forecast->lightBytes = 0;
    prospect.missingSeconds = forecast->seconds();
    if (!forecast->nothing()) prospect.forecast = std::move(*forecast);
  }
  prospect.open = std::move(*open);
  return prospect;
}

/// What is in the project's own store already.
Status SweepRun::adopt(const OpenProject& open) {
  if (!original_) return {};
  std::vector<ContentKey> keys = open.keys;
  keys.push_back(open.surfaceLightKey);
  for (const ContentKey& key : keys)
    if (Status taken = store_->adopt(key, *original_); !taken) return taken;
  return {};
}

std::vector<int> SweepRun::camerasOfViews(const OpenProject& open) const {
  std::set<int> needed;
  for (const PerspectiveView& view : views_)
    for (const int camera : camerasOf(*open.layout, view, open.project.view).cameras) needed.insert(camera);
  return {needed.begin(), needed.end()};
}

void SweepRun::foretellViews(Prospect& prospect) const {
  const OpenProject& open = *prospect.open;
  prospect.cameras = camerasOfViews(open);
  std::vector<int> missing = *prospect.cameras;
  std::erase_if(missing, [&](int camera) { return store_->has(open.keys[std::size_t(camera)]); });
  prospect.missingSeconds = secondsPerPixel_ * pixelsOf(open, missing);
}

SweepRun::ViewsShare SweepRun::shareOf(const OpenProject& open) const {
  ViewsShare share;
  for (const int camera : camerasOfViews(open)) {
    share.bytes += double(store_->bytesOf(open.keys[std::size_t(camera)]));
    share.pixels += pixelsOf(open, {&camera, 1});
  }
  share.allPixels = pixelsOf(open, allCamerasOf(*open.layout));
  return share;
}

/// What frames are painted from is not like the rest: they look at more, and rather along rooms than at
/// walls.
Result<BakeForecast> SweepRun::forecastAll(const OpenProject& open) const {
  BakeShare whole{&open, bakingOrder(open), true};
  BakeForecastOptions options;
  options.brief = false;
  options.effort = kEffort;
  return forecastBake(std::span(&whole, 1), options, runner_, common_.progress, common_.stop);
}

Status SweepRun::bakeViews(const Prospect& prospect, const Sweep& known, SweepPoint& point) {
  const OpenProject& open = *prospect.open;
  BakeRequest request;
  request.cameras = prospect.cameras;
  const auto report = bakeProject(open, request, *store_, runner_, common_.progress, common_.stop);
  if (!report) return tl::unexpected(report.error());
  std::vector<int> baked;
  for (const BakedCamera& camera : report->captures.cameras)
    if (!camera.reused) baked.push_back(camera.camera);
  const ViewsShare share = shareOf(open);
  share_ = share.pixels / share.allPixels;
  if (!baked.empty()) secondsPerPixel_ = report->captures.seconds / pixelsOf(open, baked);
  lightSeconds_ = std::max(lightSeconds_, report->surfaceLightSeconds);
  point.bakeKey = prospect.bakeKey;
  const double light = double(store_->bytesOf(open.surfaceLightKey));
  const auto all = [&](const ViewsShare& of) { return of.bytes * of.allPixels / of.pixels; };
  if (point.setting.empty()) {
    const auto forecast = forecastAll(open);
    if (!forecast) return tl::unexpected(forecast.error());
    point[Measure::bytes] = single(forecast->captureBytes + light);
    point[Measure::bakeSeconds] = single(forecast->seconds());
    if (secondsPerPixel_ <= 0) secondsPerPixel_ = forecast->captureSeconds / share.allPixels;
    lightSeconds_ = forecast->lightSeconds;
  } else {
    // As far as the project as it is was from what its own few captures say.
    const OpenProject& base = walk_.storeys.front();
    const double told =
        (*known.find({}))[Measure::bytes].median - double(store_->bytesOf(base.surfaceLightKey));
    point[Measure::bytes] = single(all(share) * told / all(shareOf(base)) + light);
    point[Measure::bakeSeconds] = single(secondsPerPixel_ * share.allPixels + lightSeconds_);
  }
  point.bakeEstimated = true;
  return {};
}

Status SweepRun::bake(const Prospect& prospect, const Sweep& known, SweepPoint& point) {
  const OpenProject& open = *prospect.open;
  BakeRequest request;
  if (prospect.forecast) tell(*prospect.forecast, common_);
  const auto report = bakeProject(open, request, *store_, runner_, common_.progress, common_.stop);
  if (!report) return tl::unexpected(report.error());
  const bool all = report->captures.reused == 0 && !report->surfaceLightReused;
  const SweepPoint* before = sameBake(known, prospect.bakeKey);
  point.bakeKey = prospect.bakeKey;
  if (all) {
    point[Measure::bakeSeconds] = single(report->captures.seconds + report->surfaceLightSeconds);
  } else if (before) {
    point[Measure::bakeSeconds] = (*before)[Measure::bakeSeconds];
    point.bakeEstimated = before->bakeEstimated;
  } else {
    point[Measure::bakeSeconds] = single(prospect.bakeSeconds);
    point.bakeEstimated = true;
  }
  std::uint64_t bytes = store_->bytesOf(open.surfaceLightKey);
  for (const ContentKey& key : open.keys) bytes += store_->bytesOf(key);
  point[Measure::bytes] = single(double(bytes));
  return {};
}

Result<SweepPoint> SweepRun::measure(const SweepSetting& setting, const Prospect& prospect,
                                     const Sweep& known) {
  SweepPoint point;
  point.setting = setting;
  point.skipped = prospect.whyNot;
  if (!prospect.open) return point;
  now_ = textOf(setting);
  Status done = options_.viewsOnly ? bakeViews(prospect, known, point) : bake(prospect, known, point);
  const Stopwatch watch;
  if (done) done = measureFrames(*prospect.open, known.referenceMs, point);
  if (done) {
    point.measureSeconds = watch.seconds();
    return point;
  }
  if (done.error().kind == ErrorKind::cancelled) return tl::unexpected(done.error());
  SweepPoint skipped;
  skipped.setting = setting;
  skipped.skipped = done.error().describe();
  return skipped;
}

Result<Numerics> SweepRun::numerics() {
  now_ = "numerics";
  return benchNumerics(walk_.storeys.front(), views_, {options_.repeats}, runner_, common_.progress,
                       common_.stop);
}

Status SweepRun::measureFrames(const OpenProject& open, double referenceMs, SweepPoint& point) {
  if (!options_.viewsOnly)
    if (Status loaded = measureLoading(open, point); !loaded) return loaded;
  const auto maker =
      FrameMaker::create(std::span(&open, 1), nameOf(open.project.view.renderer), common_, runner_);
  if (!maker) return tl::unexpected(maker.error());
  std::vector<ColourImage> pictures;
  if (Status done = measureErrors(**maker, point, pictures); !done) return done;
  if (Status done = measureTimes(**maker, pictures, referenceMs, point); !done) return done;
  if (!options_.viewsOnly)
    if (Status done = measureFlicker(open, **maker, point); !done) return done;
  return writePictures(pictures[std::size_t(point.worstFrame)], point);
}

Status SweepRun::measureLoading(const OpenProject& open, SweepPoint& point) const {
  std::vector<double> milliseconds;
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    if (Status on = goOn(std::size_t(repeat), std::size_t(options_.repeats), "loading"); !on) return on;
    const Stopwatch watch;
    const auto maker =
        FrameMaker::create(std::span(&open, 1), nameOf(open.project.view.renderer), common_, runner_);
    if (!maker) return tl::unexpected(maker.error());
    const auto frame = (*maker)->render(views_.front());
    if (!frame) return tl::unexpected(frame.error());
    milliseconds.push_back(watch.seconds() * 1e3);
  }
  point[Measure::loadMs] = spreadOf(std::move(milliseconds));
  return {};
}

Status SweepRun::measureErrors(FrameMaker& maker, SweepPoint& point,
                               std::vector<ColourImage>& pictures) const {
  std::vector<double> psnr, ssim, msSsim, depth, holes;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (Status on = goOn(i, views_.size(), "comparing"); !on) return on;
    auto frame = maker.render(views_[i]);
    if (!frame) return tl::unexpected(frame.error());
    const auto comparison = compare(*frame, truth_[i].colour, truth_[i].rayDistance);
    if (!comparison) return tl::unexpected(comparison.error());
    psnr.push_back(comparison->psnr), ssim.push_back(comparison->ssim);
    holes.push_back(comparison->holeShare);
    msSsim.push_back(msSsimOf(frame->colour, truth_[i].colour));
    if (!onOpenGl(maker.settings.renderer))
      depth.push_back(depthErrorOf(*frame, maker.inverseZDepth(), views_[i], truth_[i].rayDistance));
    pictures.push_back(std::move(frame->colour));
  }
  point.worstFrame = int(std::ranges::min_element(msSsim) - msSsim.begin());
  point[Measure::psnr] = spreadOf(std::move(psnr));
  point[Measure::ssim] = spreadOf(std::move(ssim));
  point[Measure::msSsim] = spreadOf(std::move(msSsim));
  point[Measure::depthError] = spreadOf(std::move(depth));
  point[Measure::holeShare] = spreadOf(std::move(holes));
  return {};
}

Status SweepRun::openReference() {
  if (reference_) return {};
  const OpenProject& open = walk_.storeys.front();
  const Renderer own = open.project.view.renderer;
  auto maker =
      FrameMaker::create(walk_.storeys, nameOf(onOpenGl(own) ? Renderer::list : own), common_, runner_);
  if (!maker) return tl::unexpected(maker.error());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (Status on = goOn(i, views_.size(), "loading"); !on) return on;
    const auto frame = (*maker)->render(views_[i]);
    if (!frame) return tl::unexpected(frame.error());
  }
  reference_ = std::move(*maker);
  return {};
}

Status SweepRun::measureTimes(FrameMaker& maker, const std::vector<ColourImage>& pictures, double referenceMs,
                              SweepPoint& point) {
  if (Status opened = openReference(); !opened) return opened;
  std::vector<double> medians, slowest, references;
  for (int repeat = 0; repeat < options_.repeats; ++repeat) {
    std::vector<double> milliseconds, beside;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      if (Status on = goOn(i, views_.size(), "timing"); !on) return on;
      auto frame = maker.render(views_[i]);
      if (!frame) return tl::unexpected(frame.error());
      milliseconds.push_back(frame->stats.totalSeconds * 1e3);
      point.changedFrames += frame->colour.pixels != pictures[i].pixels ? 1 : 0;
      maker.recycle(std::move(*frame));
      auto other = reference_->render(views_[i]);
      if (!other) return tl::unexpected(other.error());
      beside.push_back(other->stats.totalSeconds * 1e3);
      reference_->recycle(std::move(*other));
    }
    const Spread spread = spreadOf(std::move(milliseconds));
    references.push_back(spreadOf(std::move(beside)).median);
    const double scale = referenceMs > 0 ? referenceMs / references.back() : 1;
    medians.push_back(scale * spread.median), slowest.push_back(scale * spread.p99);
  }
  referenceMs_ = spreadOf(std::move(references)).median;
  point[Measure::frameMs] = spreadOf(std::move(medians));
  point[Measure::frameP99Ms] = spreadOf(std::move(slowest));
  return {};
}

Status SweepRun::measureFlicker(const OpenProject& open, FrameMaker& maker, SweepPoint& point) const {
  const std::vector<Pop> crossings = crossingsAlong({{open}, walk_.size, walk_.views}, options_.crossings);
  std::vector<double> changed;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (Status on = goOn(i, crossings.size(), "crossing borders"); !on) return on;
    const auto before = maker.render(crossings[i].before);
    if (!before) return tl::unexpected(before.error());
    const auto after = maker.render(crossings[i].after);
    if (!after) return tl::unexpected(after.error());
    changed.push_back(changeBetween(before->colour, after->colour).changedShare);
  }
  point[Measure::flicker] = spreadOf(std::move(changed));
  return {};
}

Status SweepRun::writePictures(const ColourImage& worst, SweepPoint& point) const {
  point.pictures = "pictures/" + fileNameOf(point.setting);
  const ColourImage& truth = truth_[std::size_t(point.worstFrame)].colour;
  const auto write = [&](const ColourImage& picture, const char* ending) {
    return writeColourImage(thumbnailOf(picture), options_.folder / (point.pictures + ending));
  };
  if (Status written = write(worst, ".jpg"); !written) return written;
  return write(differenceImage(worst, truth, kDifferenceGain), "-difference.jpg");
}

}  // namespace acentric::cli
