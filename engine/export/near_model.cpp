#include "engine/export/near_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/export/chart_picture.h"
#include "engine/export/surface_charts.h"
#include "engine/export/texture_atlas.h"
#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/view/local_shading.h"

namespace acentric {
namespace {

/// A picture is sampled so many times finer than what it shows; edges where alpha is cut off are seen most.
constexpr double kOversampling = 2, kMaskOversampling = 3;
/// Of what is finer than texels, places across and down that a texel averages.
constexpr int kMostParts = 4;

/// How meshes differ; their order is that of drawing.
struct MeshKind {
  AlphaMode alpha = AlphaMode::opaque;
  float cutoff = 0;
  bool back = false, doubleSided = false;
  auto operator<=>(const MeshKind&) const = default;
};

/// A side of a triangle of local geometry.
struct Face {
  const LocalTriangle* triangle = nullptr;
  bool back = false;
};

struct Painted {
  const SurfaceChart* chart = nullptr;
  MeshKind kind;
  ChartPicture picture;
};

class NearWriter {
 public:
  NearWriter(const WalkScene& walk, std::size_t region, const LocalGeometry& local, int atlasPixels,
             DrawModel& model)
      : walk_(walk),
        local_(local),
        polygon_(walk.layout->regions[region].polygon),
        eye_(polygon_.centroid(), walk.layout->eyeZ()),
        atlasPixels_(atlasPixels),
        model_(model),
        meshes_(local.meshes(*walk.scene)),
        shading_(walk, local) {}

  NearModelCounts write() {
    collect();
    const std::vector<SurfaceChart> charts = chartsOf(surfaces_);
    std::vector<double> texels;
    double area = 0;
    for (const SurfaceChart& chart : charts) {
      texels.push_back(texelOf(chart));
      area += (chart.size.x / texels.back() + 1) * (chart.size.y / texels.back() + 1);
    }
    const double coarser = std::max(1.0, std::sqrt(area / kMostNearTexels));
    std::map<AlphaMode, std::vector<Painted>> painted;
    for (std::size_t c = 0; c < charts.size(); ++c) {
      const MeshKind kind = kinds_[surfaces_[charts[c].triangles.front()].kind];
      painted[kind.alpha].push_back({&charts[c], kind, paint(charts[c], coarser * texels[c])});
    }
    counts_.charts = charts.size();
    for (auto& [alpha, all] : painted) lay(all);
    return counts_;
  }

 private:
  void collect() {
    std::map<std::tuple<int, bool, bool>, std::uint32_t>
        known;  // by material, side, and whether it is of one
    const auto add = [&](const LocalTriangle& t, bool back, bool sides) {
      const int material = meshes_[t.mesh].material;
      const auto [kind, isNew] = known.try_emplace({material, back, sides}, std::uint32_t(kinds_.size()));
      if (isNew) kinds_.push_back(kindOf(t.mesh, back, sides));
      SurfaceTriangle surface;
      for (int i = 0; i < 3; ++i) surface.corners[std::size_t(i)] = local_.vertices[t.vertices[i]].position;
      surface.kind = kind->second;
      surfaces_.push_back(surface), faces_.push_back({&t, back}), details_.push_back(detailOf(t));
    };
    for (const LocalTriangle& t : local_.triangles) {
      if (walk_.mirrors && walk_.mirrors->planeOf(local_, t) != FlatMirrors::kNoPlane) continue;
      const bool sides = shading_.hasLightOnBack(t.mesh, t.triangle);
      add(t, false, sides);
      if (sides) add(t, true, sides);
    }
  }

  MeshKind kindOf(std::uint32_t mesh, bool back, bool sides) const {
    const LocalMaterial& of = shading_.materialOf(mesh);
    MeshKind kind;
    kind.back = back, kind.doubleSided = !sides && of.material->doubleSided;
    kind.alpha = of.clear() ? AlphaMode::blend : of.masked ? AlphaMode::mask : AlphaMode::opaque;
    if (of.masked) kind.cutoff = of.material->alphaCutoff;
    return kind;
  }

  LocalPoint pointOf(const Face& face, const glm::vec2& b) const {
    const LocalTriangle& t = *face.triangle;
    const glm::vec2 at = (1 - b.x - b.y) * local_.vertices[t.vertices[0]].barycentric +
                         b.x * local_.vertices[t.vertices[1]].barycentric +
                         b.y * local_.vertices[t.vertices[2]].barycentric;
    return {t.mesh, t.triangle, at, face.back};
  }

  /// Metres between neighbours of the finest that a triangle shows; infinite where that is of one colour.
  double detailOf(const LocalTriangle& t) const {
    const Mesh& mesh = meshes_[t.mesh];
    const LocalMaterial& material = shading_.materialOf(t.mesh);
    const glm::uvec3& corners = mesh.triangles[t.triangle];
    const glm::dvec3 a = mesh.positions[corners.y] - mesh.positions[corners.x];
    const glm::dvec3 b = mesh.positions[corners.z] - mesh.positions[corners.x];
    const double twiceArea = glm::length(glm::cross(a, b));
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(a - b)});
    const double height = longest > 0 ? twiceArea / longest : 0;
    double detail = HUGE_VAL;
    const auto take = [&](const TextureUse& use) {
      const TextureSampler sampler(*walk_.scene, use);
      if (!hasCoordinates(mesh, use) || !sampler.used()) return;
      const auto& uv = coordinatesOf(mesh, use);
      const auto texel = [&](std::uint32_t corner) {
        return glm::dvec2(use.transform * glm::vec3(uv[corner], 1)) *
               glm::dvec2(sampler.image()->width, sampler.image()->height);
      };
      const glm::dvec2 u = texel(corners.y) - texel(corners.x), v = texel(corners.z) - texel(corners.x);
      const double texels = std::abs(u.x * v.y - u.y * v.x);
      if (sampler.image()->width * sampler.image()->height > 1 && texels > 0)
        detail = std::min(detail, sampler.nearest() ? 0 : std::sqrt(twiceArea / texels));
    };
    if (material.textured) take(material.material->baseColourTexture);
    if (material.emissionTextured) take(material.material->emissiveTexture);
    if (const int resolution = shading_.lightResolution(t.mesh, t.triangle);
        resolution > 0 && !material.unlit)
      detail = std::min(detail, height / resolution);
    if (material.vertexColours && !mesh.colours.empty()) detail = std::min(detail, height / 4);
    return detail;
  }

  /// Metres.
  double texelOf(const SurfaceChart& chart) const {
    double distance = HUGE_VAL, detail = HUGE_VAL;
    for (const std::uint32_t t : chart.triangles) {
      distance = std::min(distance, eyeDistance(polygon_, eye_.z, surfaces_[t].corners));
      detail = std::min(detail, details_[t]);
    }
    const bool masked = kinds_[surfaces_[chart.triangles.front()].kind].alpha == AlphaMode::mask;
    const double seen =
        std::max(masked ? kFinestMaskTexel : kFinestTexel, distance * radians(1 / kTexelsPerDegree));
    const double finer = masked ? kMaskOversampling : kOversampling;
    const double fits = std::max(chart.size.x, chart.size.y) / (atlasPixels_ - 2 * kChartBorder);
    return std::max({seen, std::min(detail / finer, std::max(chart.size.x, seen)), fits});
  }

  ChartPicture paint(const SurfaceChart& chart, double texel) const {
    const glm::ivec2 size = glm::max(glm::ivec2(glm::min(glm::ceil(chart.size / texel - 1e-9),
                                                         glm::dvec2(atlasPixels_ - 2 * kChartBorder))),
                                     1);
    std::vector<std::array<glm::dvec2, 3>> triangles;
    for (const std::uint32_t t : chart.triangles) {
      auto& placed = triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) placed[i] = chart.place(surfaces_[t].corners[i]) / texel;
    }
    const std::vector<TexelOwner> owners = ownersOf(triangles, size);
    ChartPicture picture;
    picture.image = ColourImage(size.x + 2 * kChartBorder, size.y + 2 * kChartBorder);
    picture.texelsPerMetre = glm::dvec2(1 / texel);
    std::vector<int> parts;
    for (const std::uint32_t t : chart.triangles)
      parts.push_back(std::clamp(int(std::ceil(texel / std::max(details_[t], 1e-9))), 1, kMostParts));
    std::vector<char> known(owners.size()), shown(owners.size());
    for (std::size_t i = 0; i < owners.size(); ++i) {
      const TexelOwner& owner = owners[i];
      if (owner.triangle == TexelOwner::kNone) continue;
      const int x = int(i) % picture.image.width, y = int(i) / picture.image.width;
      const std::uint32_t t = chart.triangles[owner.triangle];
      picture.image.pixels[i] = shownAt(faces_[t], triangles[owner.triangle], owner,
                                        glm::dvec2(x, y) - double(kChartBorder), parts[owner.triangle]);
      known[i] = 1, shown[i] = owner.distance == 0 ? 1 : 0;
    }
    fillUnknown(picture.image, known);
    return shrunk(std::move(picture), shown);
  }

  /// What a texel from `low` on shows of its owner.
  Rgba8 shownAt(const Face& face, const std::array<glm::dvec2, 3>& triangle, const TexelOwner& owner,
                const glm::dvec2& low, int parts) const {
    glm::vec4 sum(0);
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const glm::vec2 b =
            parts == 1 ? owner.barycentric
                       : glm::vec2(nearestWithin(triangle, low + (glm::dvec2(i, j) + 0.5) / double(parts)));
        const LocalPoint point = pointOf(face, b);
        glm::vec4 shown = shading_.shownAt(point, glm::vec3(eye_));
        if (shading_.materialOf(point.mesh).masked) shown.a *= shading_.alphaAt(point);
        sum += shown;
      }
    sum /= float(parts * parts);
    return encodeShown(glm::vec3(sum), sum.a);
  }

  /// Pictures of charts that are drawn alike go to pages of their own.
  void lay(std::vector<Painted>& all) {
    std::vector<glm::ivec2> sizes;
    for (const Painted& each : all) sizes.push_back(each.picture.size());
    const AtlasPlan atlas = planAtlas(sizes, atlasPixels_, kChartBorder);
    for (std::size_t page = 0; page < atlas.pages.size(); ++page) {
      ColourImage picture(atlas.pages[page].x, atlas.pages[page].y, Rgba8(0, 0, 0, 255));
      std::vector<char> known(picture.pixels.size());
      std::map<MeshKind, DrawMesh> meshes;
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (atlas.places[i].page != int(page)) continue;
        const ColourImage& image = all[i].picture.image;
        const glm::ivec2 at = atlas.places[i].at - kChartBorder;
        for (int y = 0; y < image.height; ++y)
          for (int x = 0; x < image.width; ++x) {
            picture.at(at.x + x, at.y + y) = image.at(x, y);
            known[std::size_t(at.y + y) * std::size_t(picture.width) + std::size_t(at.x + x)] = 1;
          }
        add(all[i], atlas.places[i].at, atlas.pages[page], meshes[all[i].kind]);
      }
      fillUnknown(picture, known);
      counts_.texels += picture.pixels.size();
      for (auto& [kind, mesh] : meshes) {
        finish(mesh, kind);
        counts_.triangles += mesh.triangles.size();
        model_.meshes.push_back(std::move(mesh));
      }
      model_.textures.push_back({std::move(picture)});
      ++counts_.textures;
    }
  }

  void add(const Painted& painted, const glm::ivec2& at, const glm::ivec2& page, DrawMesh& mesh) const {
    std::map<std::array<float, 3>, std::uint32_t> known;
    for (const std::uint32_t t : painted.chart->triangles) {
      glm::uvec3 triangle;
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 corner = surfaces_[t].corners[std::size_t(i)];
        const glm::vec3 position(corner - model_.origin);
        const auto [vertex, isNew] =
            known.try_emplace({position.x, position.y, position.z}, mesh.positions.size());
        triangle[i] = vertex->second;
        if (!isNew) continue;
        mesh.positions.push_back(position);
        mesh.uv.emplace_back(
            (glm::dvec2(at) + painted.chart->place(corner) * painted.picture.texelsPerMetre) /
            glm::dvec2(page));
      }
      if (painted.kind.back) std::swap(triangle.y, triangle.z);
      mesh.triangles.push_back(triangle);
    }
  }

  void finish(DrawMesh& mesh, const MeshKind& kind) const {
    mesh.part = "near";
    mesh.material = kind.alpha == AlphaMode::blend  ? "near, glass"
                    : kind.alpha == AlphaMode::mask ? "near, masked"
                                                    : "near";
    mesh.texture = int(model_.textures.size());
    mesh.doubleSided = kind.doubleSided;
    mesh.alpha = kind.alpha;
    if (kind.alpha == AlphaMode::mask) mesh.cutoff = kind.cutoff;
  }

  const WalkScene& walk_;
  const LocalGeometry& local_;
  const ConvexPolygon& polygon_;
  const glm::dvec3 eye_;  ///< for glass: in the region's middle
  const int atlasPixels_;
  DrawModel& model_;
  const std::vector<Mesh>& meshes_;
  const LocalShading shading_;
  std::vector<MeshKind> kinds_;
  std::vector<SurfaceTriangle> surfaces_;
  std::vector<Face> faces_;      ///< of the surfaces
  std::vector<double> details_;  ///< detailOf each face's triangle
  NearModelCounts counts_;
};

}  // namespace

double eyeDistance(const ConvexPolygon& polygon, double eyeZ, const std::array<glm::vec3, 3>& triangle) {
  double outside = 0;  // by that axis which separates most
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const glm::dvec2 from = polygon.corners[i];
    const glm::dvec2 side = polygon.corners[(i + 1) % polygon.corners.size()] - from;
    const double length = glm::length(side);
    if (!(length > 0)) continue;
    double least = HUGE_VAL;
    for (const glm::vec3& corner : triangle) {
      const glm::dvec2 to = glm::dvec2(corner) - from;
      least =
          std::min(least, (to.x * side.y - to.y * side.x) / length);  // counter-clockwise: positive outside
    }
    outside = std::max(outside, least);
  }
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const glm::vec3& corner : triangle)
    low = std::min(low, double(corner.z)), high = std::max(high, double(corner.z));
  return std::hypot(outside, std::max({0.0, low - eyeZ, eyeZ - high}));
}

NearModelCounts addNear(const WalkScene& walk, std::size_t region, const LocalGeometry& local,
                        int atlasPixels, DrawModel& model) {
  return NearWriter(walk, region, local, atlasPixels, model).write();
}

}  // namespace acentric
