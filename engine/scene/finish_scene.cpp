#include "engine/scene/finish_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/default_light.h"
#include "engine/scene/mesh_cleaning.h"
#include "engine/scene/project_origin.h"
#include "engine/scene/texture_light.h"
#include "engine/scene/up_axis_guess.h"

namespace acentric {
namespace {

struct Box {
  glm::dvec3 min{std::numeric_limits<double>::max()};
  glm::dvec3 max{std::numeric_limits<double>::lowest()};
  bool empty() const { return min.x > max.x; }
  void add(const glm::dvec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
  void add(const SourceMesh& mesh) {
    for (const glm::uvec3& t : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) add(mesh.positions[t[corner]]);
  }
  double diagonal() const { return empty() ? 0 : glm::length(max - min); }
};

/// Nobody walks through a thimble, or a country.
void questionSize(double metres, ReportLines& guessed) {
  if (metres > 20000)
    guessed.add(fmt::format("the scene is {:.0f} km across: if that is too large, set metres per unit",
                            metres / 1000));
  else if (metres > 0 && metres < 0.5)
    guessed.add(
        fmt::format("the scene is only {:.2g} m across: if that is too small, set metres per unit", metres));
}

double chooseUnit(const SourceScene& source, const ImportOptions& options, double diagonal,
                  ReportLines& guessed) {
  if (options.metresPerUnit > 0) return options.metresPerUnit;
  if (source.metresPerUnit > 0) {
    guessed.add(source.metresPerUnit == 1
                    ? fmt::format("unit: metres ({})", source.unitSource)
                    : fmt::format("unit: {} m ({})", source.metresPerUnit, source.unitSource));
    questionSize(diagonal * source.metresPerUnit, guessed);
    return source.metresPerUnit;
  }
  if (diagonal <= 2000) {
    guessed.add("unit: metres (the file states none)");
    questionSize(diagonal, guessed);
    return 1;
  }
  const double unit = diagonal * 0.01 < 500 ? 0.01 : 0.001;
  guessed.add(fmt::format("unit: {} (the file states none, and as metres the scene would be {:.0f} m across)",
                          unit == 0.01 ? "centimetres" : "millimetres", diagonal));
  questionSize(diagonal * unit, guessed);
  return unit;
}

/// The meshes are in the file's axes.
UpAxis chooseUp(const SourceScene& source, const ImportOptions& options, ReportLines& guessed) {
  if (options.up != UpAxis::guess) return options.up;
  if (source.up != UpAxis::guess) {
    guessed.add(fmt::format("up axis: {} ({})", source.up == UpAxis::y ? "Y" : "Z", source.upSource));
    return source.up;
  }
  if (const auto times = levelAlongZ(source)) {
    guessed.add(
        fmt::format("up axis: Z (the file states none; {:.1f} times as much of its surfaces is level with Z "
                    "up as with Y up)",
                    *times));
    return UpAxis::z;
  }
  guessed.add("up axis: Y (the file states none)");
  return UpAxis::y;
}

glm::dmat4 metresZUp(double metresPerUnit, UpAxis up) {
  glm::dmat4 out(metresPerUnit);
  if (up == UpAxis::y) {  // (x, y, z) -> (x, -z, y)
    out[1] = glm::dvec4(0, 0, metresPerUnit, 0);
    out[2] = glm::dvec4(0, -metresPerUnit, 0, 0);
  }
  out[3] = glm::dvec4(0, 0, 0, 1);
  return out;
}

void reportDropped(const CleaningCounts& counts, ImportReport& report) {
  const auto line = [&](std::size_t n, const char* what) {
    if (n > 0) report.dropped.push_back(fmt::format("{} {}", counted(n, "triangle", "triangles"), what));
  };
  line(counts.degenerate, "without area");
  line(counts.notFinite, "with positions that are not finite numbers");
  line(counts.indexOutOfRange, "with indices out of range");
}

tl::unexpected<Error> noSurfaces(const CleaningCounts& counts, const std::string& modelledElse) {
  ImportReport report;
  reportDropped(counts, report);
  std::string why = modelledElse;
  for (const std::string& line : report.dropped) why += (why.empty() ? "" : ", ") + line;
  return fail(ErrorKind::unsupported, "has no surfaces" + (why.empty() ? std::string() : " (" + why + ")"));
}

class Finisher {
 public:
  Finisher(SourceScene source, const ImportOptions& options, const Progress& progress)
      : source_(std::move(source)), options_(options), progress_(progress) {}

  Result<Scene> finish(const std::string& name) {
    scene_.name = name;
    if (auto placed = placeInstances(source_, options_); !placed) return tl::unexpected(placed.error());
    for (auto* meshes : {&source_.meshes, &source_.prototypes})
      for (SourceMesh& mesh : *meshes) dropBroken(mesh, counts_);
    for (const SourceMesh& mesh : source_.prototypes) prototypeBoxes_.emplace_back().add(mesh);
    const Box box = boxOfAll();
    const auto nothing = [&] {
      return noSurfaces(counts_, fmt::format("{}", fmt::join(source_.ignored.take(), ", ")));
    };
    if (box.empty()) return nothing();
    placeEverything(box);
    cleanMeshes();
    if (scene_.meshes.empty() && scene_.instances.empty()) return nothing();
    takeRest();
    return std::move(scene_);
  }

 private:
  /// Of instances their prototypes' boxes, placed.
  Box boxOfAll() const {
    Box box;
    for (const SourceMesh& mesh : source_.meshes) box.add(mesh);
    for (const SourceInstance& instance : source_.instances) {
      const Box& own = prototypeBoxes_[instance.prototype];
      for (int corner = 0; corner < 8 && !own.empty(); ++corner) {
        const glm::dvec3 at(corner & 1 ? own.min.x : own.max.x, corner & 2 ? own.min.y : own.max.y,
                            corner & 4 ? own.min.z : own.max.z);
        box.add(glm::dvec3(instance.worldFromMesh * glm::dvec4(at, 1)));
      }
    }
    return box;
  }

  void placeEverything(const Box& sourceBox) {
    metresPerUnit_ = chooseUnit(source_, options_, sourceBox.diagonal(), source_.guessed);
    const glm::dmat4 world = metresZUp(metresPerUnit_, chooseUp(source_, options_, source_.guessed));
    for (SourceMesh& mesh : source_.meshes) applyTransform(mesh, world);
    for (SourceInstance& instance : source_.instances)
      instance.worldFromMesh = world * instance.worldFromMesh;
    const Box box = boxOfAll();
    scene_.origin = projectOriginFor(box.min, box.max);
    if (scene_.origin != glm::dvec3(0))
      source_.guessed.add(fmt::format("project origin: moved to ({}, {}, {}) m, near the scene",
                                      scene_.origin.x, scene_.origin.y, scene_.origin.z));
    for (const SourceLight& from : source_.lights) placeLight(from, world);
  }

  void placeLight(const SourceLight& from, const glm::dmat4& world) {
    Light light = from.light;
    light.direction = glm::vec3(glm::normalize(glm::dmat3(world) * glm::dvec3(light.direction)));
    light.position = glm::vec3(glm::dvec3(world * glm::dvec4(from.position, 1)) - scene_.origin);
    light.range *= float(metresPerUnit_);
    light.radius *= float(metresPerUnit_);
    // The file's distances shrink with the unit; so that the picture stays, candela shrink with their square.
    if (light.kind != LightKind::directional) light.intensity *= float(metresPerUnit_ * metresPerUnit_);
    scene_.lights.push_back(std::move(light));
  }

  void cleanMeshes() {
    double done = 0;
    for (SourceMesh& mesh : source_.meshes) {
      if (progress_ && int(done) % 64 == 0)
        progress_({done, double(source_.meshes.size()), "checking meshes"});
      done += 1;
      Mesh clean = cleaned(std::move(mesh), scene_.origin);
      mesh = {};
      if (!clean.triangles.empty()) scene_.meshes.push_back(std::move(clean));
    }
    cleanPrototypes();
  }

  Mesh cleaned(SourceMesh&& mesh, const glm::dvec3& origin) {
    const TextureUse& normals = source_.materials[std::size_t(mesh.material)].normalTexture;
    return cleanMesh(std::move(mesh), origin, normals.used(), normals.uvSet, normals.transform, counts_);
  }

  /// About their own middles, so that single precision holds them however far off they are modelled.
  void cleanPrototypes() {
    constexpr std::uint32_t kGone = ~0u;
    std::vector<std::uint32_t> number;
    std::vector<glm::dvec3> middles;
    for (std::size_t p = 0; p < source_.prototypes.size(); ++p) {
      const Box& box = prototypeBoxes_[p];
      middles.push_back(box.empty() ? glm::dvec3(0) : 0.5 * box.min + 0.5 * box.max);
      Mesh clean = cleaned(std::move(source_.prototypes[p]), middles.back());
      source_.prototypes[p] = {};
      number.push_back(clean.triangles.empty() ? kGone : std::uint32_t(scene_.prototypes.size()));
      if (number.back() != kGone) scene_.prototypes.push_back(std::move(clean));
    }
    for (const SourceInstance& from : source_.instances) {
      if (number[from.prototype] == kGone) continue;
      glm::dmat4 at = from.worldFromMesh;
      at[3] = glm::dvec4(glm::dvec3(at * glm::dvec4(middles[from.prototype], 1)) - scene_.origin, 1);
      scene_.instances.push_back({number[from.prototype], glm::mat4x3(glm::dmat4x3(at))});
    }
    source_.instances = {};
    // The same scene, in whatever order its file names them.
    std::ranges::stable_sort(scene_.instances, [](const Instance& a, const Instance& b) {
      if (a.prototype != b.prototype) return a.prototype < b.prototype;
      const float *one = &a.worldFromPrototype[0].x, *other = &b.worldFromPrototype[0].x;
      return std::lexicographical_compare(one, one + 12, other, other + 12);
    });
  }

  void takeRest() {
    scene_.materials = std::move(source_.materials);
    scene_.textures = std::move(source_.textures);
    scene_.images = std::move(source_.images);
    scene_.bounds = boundsOf(scene_);
    const std::size_t ownLights = scene_.lights.size();
    if (!applyLighting(scene_, options_.lighting, source_.guessed))
      addDefaultLight(scene_, options_.defaultLight, source_.guessed);
    if (counts_.normalsMade > 0)
      source_.guessed.add(fmt::format("normals: {} without any are shaded flat",
                                      counted(counts_.normalsMade, "mesh", "meshes")));
    if (counts_.tangentsMade > 0)
      source_.guessed.add(
          fmt::format("tangents: made for {}", counted(counts_.tangentsMade, "mesh", "meshes")));
    ImportReport& report = scene_.report;
    if (scene_.instances.empty())
      report.found.push_back(fmt::format("{} in {}", counted(counts_.kept, "triangle", "triangles"),
                                         counted(scene_.meshes.size(), "mesh", "meshes")));
    else
      report.found.push_back(fmt::format(
          "{} ({}), in {} and {} of {}", counted(scene_.shownTriangleCount(), "triangle", "triangles"),
          counted(counts_.kept, "unique", "unique"), counted(scene_.meshes.size(), "mesh", "meshes"),
          counted(scene_.instances.size(), "instance", "instances"),
          counted(scene_.prototypes.size(), "shared mesh", "shared meshes")));
    report.found.push_back(fmt::format(
        "{}, {}, {}", counted(scene_.materials.size(), "material", "materials"),
        counted(scene_.textures.size(), "texture", "textures"), counted(ownLights, "light", "lights")));
    const glm::vec3 size = scene_.bounds.size();
    const int decimals = std::max({size.x, size.y, size.z}) < 0.1F ? 5 : 2;
    report.found.push_back(
        fmt::format("{0:.{3}f} x {1:.{3}f} x {2:.{3}f} m (x, y, z up)", size.x, size.y, size.z, decimals));
    reportDropped(counts_, report);
    report.metresPerUnit = metresPerUnit_;
    report.ignored = source_.ignored.take();
    report.guessed = source_.guessed.take();
    scene_.parts = partsOf(scene_);
    scene_.key = keyOf(scene_.parts);
  }

  SourceScene source_;
  const ImportOptions& options_;
  const Progress& progress_;
  double metresPerUnit_ = 1;
  std::vector<Box> prototypeBoxes_;  ///< in their own frames
  CleaningCounts counts_;
  Scene scene_;
};

}  // namespace

Result<Scene> finishScene(SourceScene source, const std::string& name, const ImportOptions& options,
                          const Progress& progress) {
  return Finisher(std::move(source), options, progress).finish(name);
}

}  // namespace acentric
