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
  void add(const SourceMesh& mesh) {
    for (const glm::uvec3& t : mesh.triangles)
      for (int corner = 0; corner < 3; ++corner) {
        min = glm::min(min, mesh.positions[t[corner]]);
        max = glm::max(max, mesh.positions[t[corner]]);
      }
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
  if (const auto times = levelAlongZ(source.meshes)) {
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
    Box box;
    for (SourceMesh& mesh : source_.meshes) {
      dropBroken(mesh, counts_);
      box.add(mesh);
    }
    const auto nothing = [&] {
      return noSurfaces(counts_, fmt::format("{}", fmt::join(source_.ignored.take(), ", ")));
    };
    if (box.empty()) return nothing();
    placeEverything(box);
    cleanMeshes();
    if (scene_.meshes.empty()) return nothing();
    takeRest();
    return std::move(scene_);
  }

 private:
  void placeEverything(const Box& sourceBox) {
    metresPerUnit_ = chooseUnit(source_, options_, sourceBox.diagonal(), source_.guessed);
    const glm::dmat4 world = metresZUp(metresPerUnit_, chooseUp(source_, options_, source_.guessed));
    Box box;
    for (SourceMesh& mesh : source_.meshes) {
      applyTransform(mesh, world);
      box.add(mesh);
    }
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
      const Material& material = source_.materials[std::size_t(mesh.material)];
      const TextureUse& normals = material.normalTexture;
      Mesh clean = cleanMesh(std::move(mesh), scene_.origin, normals.used(), normals.uvSet, normals.transform,
                             counts_);
      mesh = {};
      if (!clean.triangles.empty()) scene_.meshes.push_back(std::move(clean));
    }
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
    report.found.push_back(fmt::format("{} in {}", counted(counts_.kept, "triangle", "triangles"),
                                       counted(scene_.meshes.size(), "mesh", "meshes")));
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
  CleaningCounts counts_;
  Scene scene_;
};

}  // namespace

Result<Scene> finishScene(SourceScene source, const std::string& name, const ImportOptions& options,
                          const Progress& progress) {
  return Finisher(std::move(source), options, progress).finish(name);
}

}  // namespace acentric
