/// The cell that a repeated walk is made of: a small project of its own, baked and exported as any other.
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/bench/repeated_walk.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/export_bundle.h"

namespace acentric {
namespace {

/// So many cells around the baked one are laid out: all that its regions' neighbours and covers are made of.
constexpr int kCellsAround = 3;
/// Each camera sees so many cells to each side, metres; beyond is the sky.
constexpr double kSeen = 30;

Material unlit(const glm::vec3& colour) {
  Material material;
  material.baseColour = glm::vec4(colour, 1);
  material.metallic = 0;
  material.unlit = true;
  return material;
}

/// What stands in each cell, again and again.
class CellScene {
 public:
  explicit CellScene(const Lattice& lattice) : lattice_(lattice) {
    scene_.name = "repeated cell";
    for (const glm::vec3& colour : {glm::vec3(0.35f, 0.33f, 0.3f), glm::vec3(0.5f, 0.48f, 0.42f)})
      ground_.push_back(mesh(colour));
    for (const float shade : {1.0f, 0.8f, 0.6f, 0.45f}) {
      pillar_.push_back(mesh(shade * glm::vec3(0.8f, 0.45f, 0.3f)));
      block_.push_back(mesh(shade * glm::vec3(0.3f, 0.5f, 0.75f)));
    }
    scene_.sky = {{0.25f, 0.45f, 0.8f}, {0.75f, 0.8f, 0.85f}, {0.3f, 0.3f, 0.3f}};
    const auto reach = [&](int i, int j) { return glm::length(at(i, j) - at(0, 0)); };
    const int cells = int(std::ceil(kSeen / std::min(reach(1, 0), reach(0, 1))));
    for (int j = -cells; j <= cells; ++j)
      for (int i = -cells; i <= cells; ++i) addCell(i, j);
  }

  ScenePtr scene() && {
    for (const Mesh& mesh : scene_.meshes)
      for (const glm::vec3& position : mesh.positions) scene_.bounds.add(position);
    scene_.parts = partsOf(scene_);
    scene_.key = keyOf(scene_.parts);
    return std::make_shared<const Scene>(std::move(scene_));
  }

 private:
  glm::dvec2 at(int i, int j) const { return lattice_.cornerPosition(i, j, 0, 0); }

  std::size_t mesh(const glm::vec3& colour) {
    Mesh mesh;
    mesh.material = int(scene_.materials.size());
    scene_.materials.push_back(unlit(colour));
    scene_.meshes.push_back(std::move(mesh));
    return scene_.meshes.size() - 1;
  }

  /// Corners counter-clockwise as seen from the front.
  void quad(std::size_t number, const std::array<glm::vec3, 4>& corners) {
    Mesh& mesh = scene_.meshes[number];
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (std::size_t i = 0; i < corners.size(); ++i) mesh.normals.push_back(normal);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }

  /// Four sides of different shades, and a top.
  void box(const std::vector<std::size_t>& sides, const glm::vec2& middle, float half, float height) {
    const auto corner = [&](int k, float z) {
      const float x = k == 0 || k == 3 ? -half : half, y = k < 2 ? -half : half;
      return glm::vec3(middle.x + x, middle.y + y, z);
    };
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      quad(sides[std::size_t(k)], {corner(k, 0), corner(next, 0), corner(next, height), corner(k, height)});
    }
    quad(sides[0], {corner(0, height), corner(1, height), corner(2, height), corner(3, height)});
  }

  void addCell(int i, int j) {
    // The ground as two strips of the cell's parallelogram.
    const auto place = [&](double u, double v) {
      const glm::dvec2 p = at(i, j) + u * (at(i + 1, j) - at(i, j)) + v * (at(i, j + 1) - at(i, j));
      return glm::vec3(p, 0);
    };
    const bool turned = glm::cross(place(1, 0) - place(0, 0), place(0, 1) - place(0, 0)).z < 0;
    for (int strip = 0; strip < 2; ++strip) {
      const double low = 0.5 * strip, high = low + 0.5;
      std::array<glm::vec3, 4> corners{place(low, 0), place(high, 0), place(high, 1), place(low, 1)};
      if (turned) std::swap(corners[1], corners[3]);
      quad(ground_[std::size_t(strip)], corners);
    }
    for (int slot = 0; slot < lattice_.slots(); ++slot) {
      const glm::vec2 middle(lattice_.polygonOf({i, j, slot}).centroid());
      if (lattice_.kindOf(slot) == RegionKind::ring)
        box(pillar_, middle, 0.2f, 2.8f);
      else
        box(block_, middle, 0.3f, 0.8f);
    }
  }

  const Lattice& lattice_;
  Scene scene_;
  std::vector<std::size_t> ground_, pillar_, block_;  ///< meshes
};

LayoutSpec specOf(const RepeatedCellOptions& options) {
  LayoutSpec spec;
  spec.configuration = options.configuration;
  spec.cellSize = options.cellSize;
  return spec;
}

}  // namespace

class RepeatedCellMaker {
 public:
  RepeatedCellMaker(const RepeatedCellOptions& options, const std::filesystem::path& folder)
      : options_(options), folder_(folder) {}

  Result<std::shared_ptr<const RepeatedCell>> make(TaskRunner& runner, const Progress& progress,
                                                   const std::stop_token& stop) {
    std::shared_ptr<RepeatedCell> cell(new RepeatedCell(specOf(options_)));
    auto open = project(*cell);
    if (!open) return tl::unexpected(open.error());
    BakeRequest request;
    request.surfaceLight = false;  // nothing is lit
    request.cameras.emplace();
    for (std::size_t c = 0; c < open->layout->cameras.size(); ++c)
      if (const CameraId& id = open->layout->cameras[c].id; id.i == 0 && id.j == 0)
        request.cameras->push_back(int(c));
    const auto baked = bakeProject(*open, request, runner, progress, stop);
    if (!baked) return tl::unexpected(baked.error());
    ExportBundleOptions exporting;
    exporting.allowMissing = true, exporting.generator = "repeated cell";
    const std::filesystem::path target = folder_ / "bundle";
    const auto written = exportBundle(std::span(&*open, 1), target, exporting, runner, progress, stop);
    if (!written) return tl::unexpected(written.error());
    if (Status taken = take(*open, target, *cell); !taken) return tl::unexpected(taken.error());
    return cell;
  }

 private:
  Result<OpenProject> project(const RepeatedCell& cell) const {
    OpenProject open;
    open.file = folder_ / "cell.acentric.json";
    Project& project = open.project;
    project.scene = "cell.glb";  // is never read
    project.layout() = cell.spec();
    for (int j = -kCellsAround; j <= kCellsAround; ++j)
      for (int i = -kCellsAround; i <= kCellsAround; ++i)
        for (int slot = 0; slot < cell.lattice().slots(); ++slot) project.layout().added.insert({i, j, slot});
    project.bake.samplesPerDegree = options_.samplesPerDegree;
    for (const Status& sound : {project.layout().check(), project.bake.check()})
      if (!sound) return tl::unexpected(sound.error());
    const ScenePtr scene = CellScene(cell.lattice()).scene();
    auto rays = RayScene::build(scene, planEffects(*scene, {}));
    if (!rays) return tl::unexpected(rays.error());
    auto layout = buildLayout(project.layout());
    if (!layout) return tl::unexpected(layout.error());
    open.rays = std::move(*rays);
    open.imported = open.scene = scene;
    open.drawn = std::make_shared<const DrawnScene>(scene);
    open.plan = open.rays->plan();
    open.layout = std::make_shared<const Layout>(std::move(*layout));
    open.layouts = {open.layout};
    open.keys = captureKeys(*scene, open.plan, project.bake, *open.layout);
    open.surfaceLightKey = scene->key;
    return open;
  }

  /// Of the bundle what is the baked cell's.
  static Status take(const OpenProject& open, const std::filesystem::path& folder, RepeatedCell& cell) {
    const auto files = bundleFolder(folder);
    auto bundle = readBundle(*files);
    if (!bundle) return tl::unexpected(bundle.error());
    const BundleStorey& storey = bundle->storeys.front();
    const Layout& layout = *open.layout;
    require(storey.layout.regions.size() == layout.regions.size() &&
                storey.layout.cameras.size() == layout.cameras.size(),
            "a bundle has its layout's regions and cameras");
    std::map<std::pair<int, int>, RepeatedCell::CameraKind> kinds;
    for (std::size_t c = 0; c < layout.cameras.size(); ++c) {
      const CameraId& id = layout.cameras[c].id;
      if (id.i != 0 || id.j != 0) continue;
      RepeatedCell::CameraKind kind{id.corner, id.direction, storey.cameras[c], {}, {}, {}};
      if (!kind.renditions.full || !kind.renditions.coarse)
        return fail(ErrorKind::internal, "a camera of the repeated cell was not baked", folder.string());
      for (const auto& [file, into] : {std::pair(&kind.renditions.full->file, &kind.full),
                                       std::pair(&kind.renditions.coarse->file, &kind.coarse)}) {
        auto bytes = files->read(file->path, file->bytes);
        if (!bytes) return tl::unexpected(bytes.error());
        *into = std::move(*bytes);
      }
      kinds.emplace(std::pair(id.corner, id.direction), std::move(kind));
    }
    cell.locals_.resize(std::size_t(cell.lattice().slots()));
    for (std::size_t r = 0; r < layout.regions.size(); ++r) {
      const CellId& id = layout.regions[r].id;
      if (id.i != 0 || id.j != 0) continue;
      for (const Cover& cover : storey.layout.regions[r].covers)  // panoramas are made of what these call for
        for (const Piece& piece : cover.pieces) {
          const CameraId& camera = layout.cameras[std::size_t(piece.camera)].id;
          auto& from = kinds.at({camera.corner, camera.direction}).from;
          const glm::ivec2 offset(id.i - camera.i, id.j - camera.j);
          if (std::ranges::find(from, offset) == from.end()) from.push_back(offset);
        }
      if (!storey.local[r]) continue;
      auto local = readBundleLocal(*files, *bundle, storey, r);
      if (!local) return tl::unexpected(local.error());
      cell.locals_[std::size_t(id.slot)] = std::move(*local);
    }
    for (auto& [name, kind] : kinds)
      if (!kind.from.empty()) cell.cameras_.push_back(std::move(kind));
    BundleStorey bare;
    bare.name = storey.name;
    bare.layout.spec = storey.layout.spec;
    bundle->name = "repeated";
    bundle->storeys = {std::move(bare)};
    cell.root_ = std::move(*bundle);
    return {};
  }

  const RepeatedCellOptions& options_;
  const std::filesystem::path& folder_;
};

Result<std::shared_ptr<const RepeatedCell>> RepeatedCell::make(const RepeatedCellOptions& options,
                                                               const std::filesystem::path& folder,
                                                               TaskRunner& runner, const Progress& progress,
                                                               const std::stop_token& stop) {
  LayoutSpec spec = specOf(options);
  if (Status sound = spec.check(); !sound) return tl::unexpected(sound.error());
  return RepeatedCellMaker(options, folder).make(runner, progress, stop);
}

glm::dvec2 RepeatedCell::step(int i, int j) const {
  return lattice_.cornerPosition(i, j, 0, 0) - lattice_.cornerPosition(0, 0, 0, 0);
}

std::size_t RepeatedCell::kindOf(const CameraId& camera) const {
  const auto found =
      std::ranges::lower_bound(cameras_, std::pair(camera.corner, camera.direction), {},
                               [](const CameraKind& kind) { return std::pair(kind.corner, kind.direction); });
  require(found != cameras_.end() && found->corner == camera.corner && found->direction == camera.direction,
          "a lattice has the same cameras in each cell");
  return std::size_t(found - cameras_.begin());
}

}  // namespace acentric
