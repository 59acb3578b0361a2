#include <limits>

#include "engine/export/bundle_materials.h"
#include "engine/export/local_file.h"

namespace acentric {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// What is taken of one mesh: triangles and vertices in the order in which they are first asked for.
struct TakenMesh {
  std::uint32_t place = kNone;                  ///< among the meshes taken
  std::vector<std::uint32_t> triangle, vertex;  ///< by those of the source: their new numbers
};

class Taking {
 public:
  Taking(const LocalGeometry& local, const Scene& scene, const EffectPlan& plan, const SurfaceLight* light,
         const FlatMirrors* mirrors)
      : local_(local),
        plan_(plan),
        meshes_(local.meshes(scene)),
        light_(local.surfaces ? &local.surfaces->light : light),
        mirrors_(mirrors),
        materials_(scene.materials),
        first_(firstTrianglesOf(meshes_)),
        taken_(meshes_.size()) {
    if (light_ != nullptr && light_->empty()) light_ = nullptr;
  }

  LocalGeometry take() {
    LocalGeometry out{local_.polygon, local_.vertices, local_.triangles, nullptr};
    numberMeshes();
    std::vector<std::vector<std::uint32_t>> sources(surfaces_.meshes.size());
    for (LocalTriangle& triangle : out.triangles) {
      TakenMesh& taken = taken_[triangle.mesh];
      const std::uint32_t source = triangle.triangle, mesh = triangle.mesh;
      if (taken.triangle[source] == kNone) {
        taken.triangle[source] = std::uint32_t(sources[taken.place].size());
        sources[taken.place].push_back(source);
        takeTriangle(meshes_[mesh], source, taken);
        if (mirrors_ != nullptr)
          surfaces_.mirrorPlanes[taken.place].push_back(mirrors_->planeOf(local_, triangle));
      }
      triangle.mesh = taken.place, triangle.triangle = taken.triangle[source];
    }
    if (light_ != nullptr) takeLight(sources);
    out.surfaces = std::make_shared<const LocalSurfaces>(std::move(surfaces_));
    return out;
  }

 private:
  /// Those that are used, in their order.
  void numberMeshes() {
    std::vector<char> used(meshes_.size());
    for (const LocalTriangle& triangle : local_.triangles) used[triangle.mesh] = 1;
    for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
      if (!used[m]) continue;
      taken_[m].place = std::uint32_t(surfaces_.meshes.size());
      taken_[m].triangle.assign(meshes_[m].triangles.size(), kNone);
      taken_[m].vertex.assign(meshes_[m].positions.size(), kNone);
      meshOf_.push_back(m);
      Mesh mesh;
      mesh.material = meshes_[m].material;
      surfaces_.meshes.push_back(std::move(mesh));
    }
    if (mirrors_ != nullptr) surfaces_.mirrorPlanes.resize(surfaces_.meshes.size());
  }

  void takeTriangle(const Mesh& from, std::uint32_t triangle, TakenMesh& taken) {
    Mesh& to = surfaces_.meshes[taken.place];
    glm::uvec3 corners(0);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = from.triangles[triangle][c];
      std::uint32_t& place = taken.vertex[vertex];
      if (place == kNone) {
        place = std::uint32_t(to.positions.size());
        takeVertex(from, vertex, to);
      }
      corners[c] = place;
    }
    to.triangles.push_back(corners);
  }

  void takeVertex(const Mesh& from, std::uint32_t vertex, Mesh& to) const {
    const MaterialNeeds needs = needsOf(materials_[std::size_t(from.material)], plan_);
    to.positions.push_back(from.positions[vertex]);
    if (!from.normals.empty()) to.normals.push_back(from.normals[vertex]);
    for (std::size_t set = 0; set < 2; ++set)
      if (needs.uv[set] && !from.uv[set].empty()) to.uv[set].push_back(from.uv[set][vertex]);
    if (needs.colours && !from.colours.empty()) to.colours.push_back(from.colours[vertex]);
  }

  void takeLight(const std::vector<std::vector<std::uint32_t>>& sources) {
    SurfaceLight& to = surfaces_.light;
    for (std::size_t place = 0; place < sources.size(); ++place)
      for (const std::uint32_t source : sources[place]) {
        const std::uint32_t triangle = first_[meshOf_[place]] + source;
        const bool known = triangle < light_->resolution.size();
        const std::uint16_t resolution = known ? light_->resolution[triangle] : std::uint16_t(0);
        const std::uint8_t back =
            triangle < light_->hasBack.size() && resolution > 0 ? light_->hasBack[triangle] : std::uint8_t(0);
        to.firstSample.push_back(std::uint32_t(to.light.size()));
        to.resolution.push_back(resolution);
        to.hasBack.push_back(back);
        if (resolution == 0) continue;
        const auto from = light_->light.begin() + std::ptrdiff_t(light_->firstSample[triangle]);
        to.light.insert(to.light.end(), from,
                        from + std::ptrdiff_t(surfaceSampleCount(resolution) << (back ? 1 : 0)));
      }
    if (to.light.empty()) to.light.push_back(HalfColour(0));  // without any, the surfaces would not be lit
    to.firstSample.push_back(std::uint32_t(to.light.size()));
  }

  const LocalGeometry& local_;
  const EffectPlan& plan_;
  const std::vector<Mesh>& meshes_;
  const SurfaceLight* light_;
  const FlatMirrors* mirrors_;
  const std::vector<Material>& materials_;
  std::vector<std::uint32_t> first_;
  std::vector<TakenMesh> taken_;
  std::vector<std::uint32_t> meshOf_;  ///< by place
  LocalSurfaces surfaces_;
};

}  // namespace

LocalGeometry selfContained(const LocalGeometry& local, const Scene& scene, const EffectPlan& plan,
                            const SurfaceLight* light, const FlatMirrors* mirrors) {
  return Taking(local, scene, plan, light, mirrors).take();
}

}  // namespace acentric
