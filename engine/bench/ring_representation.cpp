#include <fmt/format.h>

#include <algorithm>

#include "engine/bench/bake_to_size.h"
#include "engine/bench/make_representation.h"
#include "engine/pipeline/local_triangles.h"

namespace acentric {
namespace {

/// From a ring's centre to its cameras, of cells of one metre.
double ringRadius(Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 1;
  const ConvexPolygon ring = cellPolygon(spec, {});
  return glm::distance(ring.centroid(), ring.corners.front());
}

/// What near surfaces take of the scene.
std::uint64_t localMeshBytes(const Scene& scene, const LocalTriangles& local) {
  const auto first = scene.firstTriangles();
  std::uint64_t vertices = 0, triangles = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    std::vector<char> used(mesh.positions.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (local.wanted[first[m] + t] == LightSides::none) continue;
      ++triangles;
      for (int corner = 0; corner < 3; ++corner) used[mesh.triangles[t][corner]] = 1;
    }
    vertices += std::uint64_t(std::ranges::count(used, 1));
  }
  return meshBytes(vertices, triangles);
}

class RingView final : public RepresentationView {
 public:
  RingView(LoadedWalk loaded, const ViewSettings& settings)
      : loaded_(std::move(loaded)), settings_(settings) {
    settings_.renderer = Renderer::list;
  }
  Result<Frame> render(const PerspectiveView& view, TaskRunner& runner, FrameMemory& memory) const override {
    return renderFrame(loaded_.walk, view, settings_, runner, memory);
  }

 private:
  LoadedWalk loaded_;
  ViewSettings settings_;
};

std::string lightNoteOf(const std::string& name) { return name + ".light"; }

/// The project with a layout of its own, in a folder of its own.
std::function<Result<OpenProject>(double samplesPerDegree)> openingOf(const Workplace& at,
                                                                      const std::string& name,
                                                                      const LayoutSpec& spec) {
  Project project = at.open.project;
  project.layout() = spec;
  return [&at, name, project = std::move(project)](double samplesPerDegree) mutable -> Result<OpenProject> {
    project.bake.samplesPerDegree = samplesPerDegree;
    auto open = reopenProject(at.open, project, {}, at.progress, at.stop);
    if (open) open->file = at.fileOf(name);
    return open;
  };
}

CaptureBake bakeBeside(const ContentKey& light, const Workplace& at,
                       std::function<Result<OpenProject>(double)> openAt) {
  CaptureBake bake = plainBake(at, std::move(openAt));
  bake.keep = {light};
  return bake;
}

/// Light on the surfaces that some region draws; how long it took, now or in an earlier run.
Result<double> bakeLight(const Workplace& at, const std::string& name, const OpenProject& open,
                         const CaptureStore& store) {
  const std::string noteName = lightNoteOf(name);
  if (store.hasSurfaceLight(open.surfaceLightKey))
    if (const auto note = readNote(at, noteName, open.surfaceLightKey)) return note->seconds;
  BakeRequest request;
  request.cameras = std::vector<int>();
  const auto report = bakeProject(open, request, store, at.runner, at.progress, at.stop);
  if (!report) return tl::unexpected(report.error());
  if (Status noted = writeNote(at, noteName, {open.surfaceLightKey, 0, report->surfaceLightSeconds}); !noted)
    return tl::unexpected(noted.error());
  return report->surfaceLightSeconds;
}

}  // namespace

LayoutSpec relaid(const LayoutSpec& spec, Configuration configuration) {
  LayoutSpec other = spec;
  other.cellSize = spec.cellSize * ringRadius(spec.configuration) / ringRadius(configuration);
  other.configuration = configuration;
  other.forgetCells();
  other.freeApvs.clear(), other.density.clear();
  return other;
}

Result<RepresentationBake> bakeOfRings(const Workplace& at, const std::string& name, const LayoutSpec& spec,
                                       const SizeTarget& target) {
  const auto openAt = openingOf(at, name, spec);
  auto own = openAt(at.open.project.bake.samplesPerDegree);
  if (!own) return tl::unexpected(own.error());
  RepresentationBake bake{std::move(*own)};
  const OpenProject& open = bake.open;
  bake.cameras = allCamerasOf(*open.layout), bake.light = true;
  bake.bytesThere = localMeshBytes(
      open.drawn->scene(), localTrianglesOf(*open.rays, *open.drawn, *open.layout, at.runner, at.stop));
  if (target.bytes) bake.packedBytes = *target.bytes - double(bake.bytesThere);
  std::error_code error;
  const auto folder = captureFolderFor(open.file);
  if (!std::filesystem::is_directory(folder, error)) return bake;  // asking makes none
  const auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  bake.light =
      !store->hasSurfaceLight(open.surfaceLightKey) || !readNote(at, lightNoteOf(name), open.surfaceLightKey);
  if (bake.light) return bake;
  const std::uint64_t lightBytes = store->bytesOf(open.surfaceLightKey);
  bake.bytesThere += lightBytes;
  if (bake.packedBytes) *bake.packedBytes -= double(lightBytes);
  const auto there = isBakedToSize(at, name, bakeBeside(open.surfaceLightKey, at, openAt), bake.packedBytes,
                                   target.tolerance);
  if (!there) return tl::unexpected(there.error());
  if (!*there) return bake;
  bake.cameras.clear();
  if (target.bytes) return bake;
  const auto packed = packedBytes(*store, open.keys);
  if (!packed) return tl::unexpected(packed.error());
  bake.bytesThere += *packed;
  return bake;
}

Result<Representation> makeRings(const Workplace& at, const std::string& name, const LayoutSpec& spec,
                                 const SizeTarget& target) {
  const auto openAt = openingOf(at, name, spec);
  const auto own = openAt(at.open.project.bake.samplesPerDegree);
  if (!own) return tl::unexpected(own.error());
  const auto store = openCaptures(own->file);
  if (!store) return tl::unexpected(store.error());
  const auto lightSeconds = bakeLight(at, name, *own, *store);
  if (!lightSeconds) return tl::unexpected(lightSeconds.error());
  const std::uint64_t lightBytes = store->bytesOf(own->surfaceLightKey),
                      polygonBytes = localMeshBytes(
                          own->drawn->scene(),
                          localTrianglesOf(*own->rays, *own->drawn, *own->layout, at.runner, at.stop));

  const CaptureBake bake = bakeBeside(own->surfaceLightKey, at, openAt);
  std::optional<double> captureBytes;
  if (target.bytes) captureBytes = *target.bytes - double(lightBytes + polygonBytes);
  auto sized = bakeToSize(at, name, bake, captureBytes, target.tolerance);
  if (!sized) return tl::unexpected(sized.error());

  auto loaded = loadWalk(sized->open, nullptr, at.runner, at.progress, at.stop);
  if (!loaded) return tl::unexpected(loaded.error());
  Representation made{name, describe(spec.configuration), sized->cost, nullptr};
  made.cost.lightBytes = lightBytes;
  made.cost.meshBytes = polygonBytes;
  made.cost.bakeSeconds += *lightSeconds;
  for (const auto& capture : loaded->walk.captures)
    made.cost.samples += capture ? capture->samples.size() : 0;
  for (const auto& local : loaded->walk.local)
    if (local) made.cost.triangles = std::max(made.cost.triangles, local->triangles.size());
  made.view = std::make_unique<const RingView>(std::move(*loaded), at.open.project.view);
  return made;
}

}  // namespace acentric
