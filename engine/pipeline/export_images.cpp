#include "engine/pipeline/export_images.h"

#include <fmt/format.h>

#include "engine/bake/truth.h"
#include "engine/base/file.h"
#include "engine/base/folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetre = 0.001;

std::vector<PerspectiveView> facesFrom(const glm::dvec3& eye, int pixels) {
  std::vector<PerspectiveView> faces;
  for (int k = 0; k < 6; ++k) {
    PerspectiveView view;
    view.eye = eye;
    view.yawRadians = k < 4 ? k * kPi / 2 : 0;
    view.pitchRadians = k < 4 ? 0 : (k == 4 ? kPi / 2 : -kPi / 2);
    view.fovRadians = kPi / 2;
    view.width = view.height = pixels;
    faces.push_back(view);
  }
  return faces;
}

/// Along the view's axis, of distances along the rays.
FloatImage alongAxis(const FloatImage& rayDistance, const PerspectiveView& view) {
  FloatImage out = rayDistance;
  const glm::dvec3 forward = view.rayThrough(0.5 * view.width, 0.5 * view.height);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.at(x, y) *= float(glm::dot(view.rayThrough(x + 0.5, y + 0.5), forward));
  return out;
}

class ImagesWriter {
 public:
  ImagesWriter(const OpenProject& open, const ExportImagesOptions& options, fs::path folder,
               TaskRunner& runner, const Progress& progress, const std::stop_token& stop)
      : open_(open),
        options_(options),
        folder_(std::move(folder)),
        runner_(runner),
        progress_(progress),
        stop_(stop) {}

  Result<ExportImagesReport> write() {
    std::error_code error;
    const bool panoramas = options_.format == ImageSetFormat::panoramas;
    if (panoramas)
      fs::create_directories(folder_ / "panoramas", error);
    else
      for (const char* name : {"images", "depth"}) fs::create_directories(folder_ / name, error);
    const auto& regions = open_.layout->regions;
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (!options_.onlyRegion || int(r) == *options_.onlyRegion) chosen.push_back(r);
    if (chosen.empty())
      return fail(ErrorKind::invalidArgument, "there is no such region", open_.file.string());
    // Each picture gives its share of the points.
    pointsPerImage_ = options_.mostPoints / (6 * chosen.size());
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      if (progress_) progress_({double(n), double(chosen.size()), "tracing pictures"});
      const glm::dvec3 eye(regions[chosen[n]].polygon.centroid(), open_.layout->eyeZ());
      if (panoramas) {
        if (Status written = writePanoramaAt(eye, int(chosen[n])); !written)
          return tl::unexpected(written.error());
        continue;
      }
      for (const PerspectiveView& view : facesFrom(eye, options_.facePixels))
        if (Status written = writeImage(view, int(n)); !written) return tl::unexpected(written.error());
    }
    if (Status described = describe(); !described) return tl::unexpected(described.error());
    return ExportImagesReport{images_.size() + panoramas_.size(), points_.size()};
  }

 private:
  Status writePanoramaAt(const glm::dvec3& eye, int region) {
    const Panorama traced =
        tracePanorama(*open_.rays, eye, 2 * options_.facePixels, open_.project.bake, runner_, stop_);
    if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "tracing panoramas was stopped");
    panoramas_.push_back({fmt::format("panoramas/{:05}.exr", panoramas_.size()), region, eye});
    return writePanorama(traced.radiance, traced.rayDistance, folder_ / panoramas_.back().file);
  }

  Status writeImage(const PerspectiveView& view, int place) {
    const TruthFrame traced =
        renderTruth(*open_.rays, view, open_.project.bake, open_.project.exposure, 1, runner_, stop_);
    if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "tracing pictures was stopped");
    const std::string name = fmt::format("{:05}", images_.size());
    const bool png = options_.format == ImageSetFormat::nerfstudio;
    PosedImage image{view, fmt::format("images/{}.png", name),
                     fmt::format("depth/{}.{}", name, png ? "png" : "exr"), place};
    if (Status written = writeColourImage(traced.colour, folder_ / image.colour); !written) return written;
    const FloatImage depth = alongAxis(traced.rayDistance, view);
    const Status written = png ? writeDepthPng(depth, kMillimetre, folder_ / image.depth)
                               : writeFloatImage(depth, folder_ / image.depth, "Z");
    if (!written) return written;
    if (options_.format != ImageSetFormat::seurat) takePoints(traced, view);
    // COLMAP's names are relative to a folder of images of its own.
    if (options_.format == ImageSetFormat::colmap) image.colour = name + ".png";
    images_.push_back(std::move(image));
    return {};
  }

  void takePoints(const TruthFrame& traced, const PerspectiveView& view) {
    const auto pixels = std::size_t(view.width) * std::size_t(view.height);
    const std::size_t step = std::max<std::size_t>(1, pixels / std::max<std::size_t>(1, pointsPerImage_));
    for (std::size_t i = step / 2; i < pixels; i += step) {
      const float distance = traced.rayDistance.pixels[i];
      if (!std::isfinite(distance)) continue;
      const int x = int(i % std::size_t(view.width)), y = int(i / std::size_t(view.width));
      points_.push_back(
          {view.eye + double(distance) * view.rayThrough(x + 0.5, y + 0.5), traced.colour.pixels[i]});
    }
  }

  Status describe() const {
    switch (options_.format) {
      case ImageSetFormat::colmap: {
        std::error_code error;
        fs::create_directories(folder_ / "sparse" / "0", error);
        return writeColmap(images_, points_, folder_ / "sparse" / "0");
      }
      case ImageSetFormat::nerfstudio:
        if (Status written = writePointsPly(points_, folder_ / "points.ply"); !written) return written;
        return writeTextAtomically(folder_ / "transforms.json",
                                   nerfstudioTransforms(images_, kMillimetre, "points.ply"));
      case ImageSetFormat::seurat:
        return writeTextAtomically(folder_ / "manifest.json",
                                   seuratManifest(images_, images_.front().view.eye));
      case ImageSetFormat::panoramas:
        return writeTextAtomically(folder_ / "panoramas.json",
                                   panoramaList(panoramas_, double(open_.project.exposure)));
    }
    return {};
  }

  const OpenProject& open_;
  const ExportImagesOptions& options_;
  const fs::path folder_;
  TaskRunner& runner_;
  const Progress& progress_;
  const std::stop_token& stop_;
  std::size_t pointsPerImage_ = 0;
  std::vector<PosedImage> images_;
  std::vector<PosedPanorama> panoramas_;
  std::vector<ColouredPoint> points_;
};

}  // namespace

Status ExportImagesOptions::check() const {
  if (facePixels < 16 || facePixels > 8192)
    return fail(ErrorKind::invalidArgument, "pictures must have 16 to 8192 pixels a side");
  return {};
}

Result<ExportImagesReport> exportImages(const OpenProject& open, const fs::path& folder,
                                        const ExportImagesOptions& options, TaskRunner& runner,
                                        const Progress& progress, const std::stop_token& stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    return fail(ErrorKind::invalidArgument, "is there already: name a new folder", folder.string());
  return writeFolderAtomically(folder, [&](const fs::path& temporary) {
    return ImagesWriter(open, options, temporary, runner, progress, stop).write();
  });
}

}  // namespace acentric
