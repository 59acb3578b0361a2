#include "engine/export/gltf_background.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/export/capture_mesh.h"
#include "engine/export/glb.h"
#include "engine/export/texture_atlas.h"
#include "engine/geometry/conventions.h"
#include "engine/view/background.h"

namespace acentric {
namespace {

/// A part of a patch, in shares of its columns and rows, fringes included.
struct Part {
  glm::dvec2 low{0}, high{1};
};

/// The plane of a patch as seen from its camera.
struct PatchPlane {
  std::array<glm::dvec3, 4> corners;  ///< (c, t), as cornersOf
  std::array<double, 4> inverse;
  glm::dvec2 samples{0};  ///< columns and rows, fringes included

  template <class Value>
  static Value mixed(const std::array<Value, 4>& at, const glm::dvec2& share) {
    const Value top = at[0] + share.x * (at[1] - at[0]), bottom = at[2] + share.x * (at[3] - at[2]);
    return top + share.y * (bottom - top);
  }
  glm::dvec3 place(const glm::dvec3& from, const glm::dvec2& share) const {
    return from + mixed(corners, share) / mixed(inverse, share);
  }
  double inverseAt(double x, double y) const { return mixed(inverse, {x, y}); }
};

/// How far the middle of a side between inverse distances a and b lies from where a texture laid on by the
/// ends shows it, as a share of the side.
double swim(double a, double b) { return std::abs(a - b) / (2 * (a + b)); }

/// Cuts until textures lie right.
void cut(const PatchPlane& plane, const Part& part, std::vector<Part>& out) {
  constexpr double kLeast = 1.0 / 64;
  const glm::dvec2 &a = part.low, &b = part.high;
  const double across = std::max(swim(plane.inverseAt(a.x, a.y), plane.inverseAt(b.x, a.y)),
                                 swim(plane.inverseAt(a.x, b.y), plane.inverseAt(b.x, b.y))) *
                        plane.samples.x * (b.x - a.x);
  const double down = std::max(swim(plane.inverseAt(a.x, a.y), plane.inverseAt(a.x, b.y)),
                               swim(plane.inverseAt(b.x, a.y), plane.inverseAt(b.x, b.y))) *
                      plane.samples.y * (b.y - a.y);
  const bool done = std::max(across, down) <= kTextureError || std::min(b.x - a.x, b.y - a.y) < kLeast;
  if (done) {
    out.push_back(part);
    return;
  }
  const glm::dvec2 middle = 0.5 * (a + b);
  if (across >= down) {
    cut(plane, {a, {middle.x, b.y}}, out);
    cut(plane, {{middle.x, a.y}, b}, out);
  } else {
    cut(plane, {a, {b.x, middle.y}}, out);
    cut(plane, {{a.x, middle.y}, b}, out);
  }
}

/// A camera of the region with its mesh.
struct Meshed {
  int camera = 0;
  std::uint8_t roles = 0;
  const DisplayCapture* capture = nullptr;
  MeshBound bound;
  CaptureMesh mesh;
};

/// A patch that the region needs.
struct Shown {
  const Meshed* of;
  const MeshPatch* patch;
};

bool needed(const Meshed& of, std::uint32_t sample) {
  const bool own = (rolesOf(of.capture->samples[sample]) & of.roles) != 0;
  return own && (of.capture->mirror.empty() || of.capture->mirror[sample] == 0);
}

std::uint32_t sampleOf(const Shown& shown, int column, int row) {
  const MeshPatch& patch = *shown.patch;
  return shown.of->mesh.samples[patch.firstSample + std::size_t(column) * patch.rows + std::size_t(row)];
}

bool anyNeeded(const Shown& shown) {
  if ((shown.patch->roles & shown.of->roles) == 0) return false;
  for (int c = 0; c < shown.patch->columns; ++c)
    for (int r = 0; r < shown.patch->rows; ++r)
      if (needed(*shown.of, sampleOf(shown, c, r))) return true;
  return false;
}

/// The patch's samples and its border, which repeats them; what the region does not need is clear.
void paint(const Shown& shown, const glm::ivec2& at, ColourImage& page, GltfRegionReport& report) {
  const int columns = shown.patch->columns, rows = shown.patch->rows;
  for (int y = -kAtlasBorder; y < rows + kAtlasBorder; ++y)
    for (int x = -kAtlasBorder; x < columns + kAtlasBorder; ++x) {
      const std::uint32_t sample = sampleOf(shown, std::clamp(x, 0, columns - 1), std::clamp(y, 0, rows - 1));
      Rgba8 colour = shown.of->capture->colour[sample];
      const bool inside = x >= 0 && x < columns && y >= 0 && y < rows;
      const bool shows = needed(*shown.of, sample);
      report.samples += inside && shows ? 1 : 0;
      colour.a = shows ? 255 : 0;
      page.at(at.x + x, at.y + y) = colour;
    }
}

void addPatch(const Shown& shown, const glm::ivec2& at, const glm::ivec2& page, GlbMesh& mesh) {
  const ColumnCamera& camera = shown.of->capture->camera;
  const MeshPatch& patch = *shown.patch;
  const MeshBound& bound = shown.of->bound;
  const auto beyond = [&](MeshSide side) { return fringeOf(patch.fringes, side, bound); };
  const glm::dvec2 before(beyond(kLowColumn), beyond(kTopRow));
  PatchPlane plane{cornersOf(camera, patch, bound), {}, {}};
  for (std::size_t i = 0; i < 4; ++i) plane.inverse[i] = double(patch.inverseDistance[i]);
  if (std::ranges::any_of(plane.inverse, [](double w) { return !(w > 0); })) return;
  plane.samples =
      glm::dvec2(patch.columns, patch.rows) + before + glm::dvec2(beyond(kHighColumn), beyond(kBottomRow));
  std::vector<Part> parts;
  cut(plane, {}, parts);
  for (const Part& part : parts) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const glm::dvec2& share :
         {part.low, glm::dvec2(part.high.x, part.low.y), glm::dvec2(part.low.x, part.high.y), part.high}) {
      mesh.positions.push_back(gltfPosition(plane.place(camera.centreOfProjection, share)));
      const glm::dvec2 texel = glm::dvec2(at) - before + share * plane.samples;
      mesh.uv.emplace_back(texel / glm::dvec2(page));
    }
    mesh.triangles.emplace_back(first, first + 2, first + 1);
    mesh.triangles.emplace_back(first + 1, first + 2, first + 3);
  }
}

/// Which roles of which cameras the region draws.
std::map<int, std::uint8_t> camerasOf(const Layout& layout, int region, const GltfOptions& options) {
  std::map<int, std::uint8_t> cameras;
  const Region& from = layout.regions[std::size_t(region)];
  for (std::size_t c = 0; c < from.covers.size(); ++c) {
    if (c > 0 && !options.bothHands) break;
    for (const Piece& piece : from.covers[c].pieces)
      cameras[piece.camera] |= roleBit(layout.cameras[std::size_t(piece.camera)], piece.role);
  }
  return cameras;
}

}  // namespace

std::vector<int> gltfCameras(const Layout& layout, int region, const GltfOptions& options) {
  std::vector<int> cameras;
  for (const auto& [camera, roles] : camerasOf(layout, region, options)) cameras.push_back(camera);
  return cameras;
}

Status addCaptures(Glb& glb, const WalkScene& walk, int region, const GltfOptions& options,
                   GltfRegionReport& report, TaskRunner& runner, const std::stop_token& stop) {
  std::vector<Meshed> meshes;
  for (const auto& [camera, roles] : camerasOf(*walk.layout, region, options)) {
    ++report.cameras;
    const DisplayCapture* capture = walk.captures[std::size_t(camera)].get();
    if (capture == nullptr) {
      ++report.missing;
      continue;
    }
    const MeshBound bound = meshBound(capture->camera, options.meshError, eyeReach(*walk.layout, camera));
    meshes.push_back({camera, roles, capture, bound, buildCaptureMesh(*capture, bound, runner, stop)});
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "writing glTF was stopped");
    for (std::size_t s = 0; s < capture->samples.size(); ++s)
      if ((rolesOf(capture->samples[s]) & roles) != 0 &&
          (capture->colour[s].a < 255 || (!capture->mirror.empty() && capture->mirror[s] != 0)))
        ++report.leftOut;
  }
  std::vector<Shown> shown;
  std::vector<glm::ivec2> sizes;
  for (const Meshed& each : meshes)
    for (const MeshPatch& patch : each.mesh.patches)
      if (anyNeeded({&each, &patch})) {
        shown.push_back({&each, &patch});
        sizes.emplace_back(patch.columns, patch.rows);
      }
  report.patches = shown.size();
  const AtlasPlan atlas = planAtlas(sizes, options.atlasPixels);
  for (std::size_t page = 0; page < atlas.pages.size(); ++page) {
    const glm::ivec2 size = atlas.pages[page];
    ColourImage picture(size.x, size.y, Rgba8(0, 0, 0, 255));
    GlbMesh mesh;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (atlas.places[i].page != int(page)) continue;
      paint(shown[i], atlas.places[i].at, picture, report);
      addPatch(shown[i], atlas.places[i].at, size, mesh);
    }
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "writing glTF was stopped");
    const bool whole = std::ranges::all_of(picture.pixels, [](const Rgba8& p) { return p.a == 255; });
    const auto texture = glb.addTexture(picture, {});
    if (!texture) return tl::unexpected(texture.error());
    GlbMaterial material;
    material.name = fmt::format("captures {}", page);
    material.texture = *texture;
    material.alpha = whole ? GlbMaterial::Alpha::opaque : GlbMaterial::Alpha::mask;
    glb.add("captures", mesh, glb.addMaterial(material));
    report.triangles += mesh.triangles.size();
    ++report.textures;
  }
  return {};
}

void addSky(Glb& glb, const WalkScene& walk, int region) {
  constexpr int kRound = 64, kUp = 32;
  constexpr double kFar = 4;  // sizes of the scene
  const Sky sky = backgroundSky(walk);
  const glm::dvec3 middle(walk.layout->regions[std::size_t(region)].polygon.centroid(), walk.layout->eyeZ());
  double radius = 1;
  for (int corner = 0; corner < 8; ++corner) {
    const Bounds& box = walk.scene->bounds;
    const glm::vec3 at(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z);
    if (!box.empty()) radius = std::max(radius, kFar * glm::distance(glm::dvec3(at), middle));
  }
  GlbMesh mesh;
  for (int i = 0; i <= kUp; ++i)
    for (int k = 0; k <= kRound; ++k) {
      const double up = kPi * (double(i) / kUp - 0.5), round = kTwoPi * k / kRound;
      const glm::dvec3 to(std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up));
      mesh.positions.push_back(gltfPosition(middle + radius * to));
      mesh.colour.push_back(toneMap(sky.radiance(glm::vec3(to)), walk.exposure));
    }
  for (int i = 0; i < kUp; ++i)
    for (int k = 0; k < kRound; ++k) {
      const auto a = std::uint32_t(i * (kRound + 1) + k), b = a + kRound + 1;
      if (i > 0) mesh.triangles.emplace_back(a, b, a + 1);  // at the poles a side is a point
      if (i + 1 < kUp) mesh.triangles.emplace_back(a + 1, b, b + 1);
    }
  GlbMaterial material;
  material.name = "sky";
  glb.add("sky", mesh, glb.addMaterial(material));
}

}  // namespace acentric
