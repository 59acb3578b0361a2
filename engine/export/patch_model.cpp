#include "engine/export/patch_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "engine/export/texture_atlas.h"
#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"

namespace acentric {
namespace {

/// Some of a patch's texels: [low, high), counted from its first sample; those beside them are around it.
struct TexelBox {
  glm::ivec2 low{0}, high{0};
  glm::ivec2 size() const { return high - low; }
  bool empty() const { return low.x >= high.x || low.y >= high.y; }
};

/// The plane of a patch as seen from its camera. Places on it are columns and rows of the capture, or
/// relative to the camera's centre of projection.
struct PatchPlane {
  const ColumnCamera& camera;
  glm::dvec3 normal;

  glm::dvec3 direction(const glm::dvec2& at) const {
    const double steepest = radians(89.95);
    return {camera.directionAt(at.x), std::tan(std::clamp(camera.elevationAt(at.y), -steepest, steepest))};
  }
  double inverse(const glm::dvec2& at) const { return glm::dot(normal, direction(at)); }
  glm::dvec3 position(const glm::dvec2& at) const {
    const glm::dvec3 towards = direction(at);
    return towards / glm::dot(normal, towards);
  }
  glm::dvec2 seenAt(const glm::dvec3& position) const {
    const double middle = 0.5 * camera.columns;
    const double azimuth =
        std::remainder(std::atan2(position.y, position.x) - camera.azimuthAt(middle), kTwoPi);
    const double elevation = std::atan2(position.z, std::hypot(position.x, position.y));
    return {middle + azimuth / camera.columnPitch(), (camera.topElevation - elevation) / camera.rowPitch()};
  }
  /// How far amid two places the capture saw something else than a texture that is laid on by them shows,
  /// samples.
  double error(const glm::dvec2& a, const glm::dvec2& b) const {
    const glm::dvec2 apart = glm::abs(seenAt(0.5 * (position(a) + position(b))) - 0.5 * (a + b));
    return std::max(apart.x, apart.y);
  }
};

/// Where a capture sees its flat mirrors, column by column: how near, as PatchPlane::inverse; 0 elsewhere.
/// Empty where it sees none.
std::vector<float> mirrorsOf(const DisplayCapture& capture) {
  std::vector<float> nearest;
  const DisplayPatches& all = *capture.patches;
  for (const DisplayPatch& patch : all.patches) {
    if (patch.mirror == 0) continue;
    nearest.resize(std::size_t(capture.camera.columns) * std::size_t(capture.camera.rows));
    const PatchPlane plane{capture.camera, glm::dvec3(patch.normal)};
    for (int c = 0; c < patch.columns; ++c)
      for (int r = 0; r < patch.rows; ++r) {
        const std::size_t texel =
            patch.firstTexel + std::size_t(c + 1) * (std::size_t(patch.rows) + 2) + std::size_t(r + 1);
        if ((all.cover[texel] & kTexelParts) == 0) continue;
        const glm::ivec2 at(patch.column + c, patch.row + r);
        float& here = nearest[std::size_t(at.x) * std::size_t(capture.camera.rows) + std::size_t(at.y)];
        here = std::max(here, float(plane.inverse(glm::dvec2(at) + 0.5)));
      }
  }
  return nearest;
}

/// A part of a patch that fits a texture.
struct PatchPart {
  const ShownCapture* of = nullptr;
  const DisplayPatch* patch = nullptr;
  /// Any of these; with RoleMeshes::apart just these, and what has all roles of the patch, as where it
  /// reaches under others.
  std::uint8_t roles = 0;
  bool apart = false;
  const std::vector<float>* mirrors = nullptr;  ///< mirrorsOf the capture; null: none
  TexelBox texels;

  std::size_t texel(int column, int row) const {
    return patch->firstTexel + std::size_t(column + 1) * (std::size_t(patch->rows) + 2) +
           std::size_t(row + 1);
  }
  /// What a mirror hangs on: seen past its frame by a capture, it would cover what the mirror shows.
  bool backsMirror(int column, int row) const {
    constexpr double kAtMost = 0.1;  // metres behind it
    const ColumnCamera& camera = of->capture->camera;
    const glm::ivec2 at(patch->column + column, patch->row + row);
    if (at.x < 0 || at.y < 0 || at.x >= camera.columns || at.y >= camera.rows) return false;
    const double mirror =
        double((*mirrors)[std::size_t(at.x) * std::size_t(camera.rows) + std::size_t(at.y)]);
    const double own = PatchPlane{camera, glm::dvec3(patch->normal)}.inverse(glm::dvec2(at) + 0.5);
    return mirror > 0 && own > 0 && own < 0.9999 * mirror && 1 / own - 1 / mirror < kAtMost;
  }
  std::uint32_t cover(int column, int row) const {
    if (mirrors != nullptr && backsMirror(column, row)) return 0;
    const std::uint32_t word = of->capture->patches->cover[texel(column, row)];
    const auto needs = std::uint8_t(word >> kTexelRoles);
    return (apart ? needs == roles || needs == patch->roles : (needs & roles) != 0) ? word & kTexelParts : 0;
  }
  Rgba8 colour(int column, int row) const {
    Rgba8 colour = of->capture->patches->colour[texel(column, row)];
    const int parts = std::popcount(cover(column, row)), all = std::popcount(kTexelParts);
    colour.a = std::uint8_t((colour.a * parts + all / 2) / all);
    return colour;
  }
};

/// What of the texels the roles want of the patch's own samples.
TexelBox coveredOf(const PatchPart& part) {
  TexelBox covered{part.texels.high, part.texels.low};
  for (int c = part.texels.low.x; c < part.texels.high.x; ++c)
    for (int r = part.texels.low.y; r < part.texels.high.y; ++r)
      if (part.cover(c, r) != 0)
        covered = {glm::min(covered.low, {c, r}), glm::max(covered.high, {c + 1, r + 1})};
  return covered;
}

struct Rectangle {
  glm::dvec2 low, high;
  std::array<glm::dvec2, 4> corners() const { return {low, {high.x, low.y}, {low.x, high.y}, high}; }
};

/// Cuts until textures lie right. What lies behind the plane's horizon is left out.
void cut(const PatchPlane& plane, const Rectangle& whole, std::vector<Rectangle>& out) {
  constexpr double kLeast = 0.5;      // samples
  constexpr double kFarthest = 1e-5;  // 1/m
  const std::array<glm::dvec2, 4> at = whole.corners();
  const auto isBefore = [&](const glm::dvec2& place) { return plane.inverse(place) > kFarthest; };
  const bool seen = std::ranges::all_of(at, isBefore);
  if (!seen && std::ranges::none_of(at, isBefore)) return;
  const glm::dvec2 size = whole.high - whole.low;
  double across = size.x, down = size.y;
  if (seen) {
    const double upper = plane.error(at[0], at[1]), lower = plane.error(at[2], at[3]);
    const double left = plane.error(at[0], at[2]), right = plane.error(at[1], at[3]);
    const double worst = std::max({upper, lower, left, right, plane.error(at[1], at[2])});
    if (worst <= kTextureError || std::max(size.x, size.y) <= kLeast) {
      out.push_back(whole);
      return;
    }
    if (std::max({upper, lower, left, right}) > kTextureError)
      across = std::max(upper, lower), down = std::max(left, right);
  } else if (std::max(size.x, size.y) <= kLeast) {
    return;
  }
  const glm::dvec2 middle = 0.5 * (whole.low + whole.high);
  if (across >= down) {
    cut(plane, {whole.low, {middle.x, whole.high.y}}, out);
    cut(plane, {{middle.x, whole.low.y}, whole.high}, out);
  } else {
    cut(plane, {whole.low, {whole.high.x, middle.y}}, out);
    cut(plane, {{whole.low.x, middle.y}, whole.high}, out);
  }
}

class PatchWriter {
 public:
  PatchWriter(std::span<const ShownCapture> shown, RoleMeshes meshes, int atlasPixels, DrawModel& model)
      : roleMeshes_(meshes), atlasPixels_(atlasPixels), model_(model) {
    for (const ShownCapture& each : shown) find(each, false);
    for (const ShownCapture& each : shown)
      if (each.capture->reflections) behindMirrors_.push_back({each.capture->reflections.get(), each.roles});
    for (const ShownCapture& each : behindMirrors_) find(each, true);
  }

  PatchModelCounts write(const std::stop_token& stop) {
    std::vector<glm::ivec2> sizes;
    for (const PatchPart& part : parts_) sizes.push_back(part.texels.size());
    const AtlasPlan atlas = planAtlas(sizes, atlasPixels_);
    for (std::size_t page = 0; page < atlas.pages.size() && !stop.stop_requested(); ++page) {
      ColourImage picture(atlas.pages[page].x, atlas.pages[page].y, Rgba8(0, 0, 0, 255));
      std::map<std::pair<bool, std::uint8_t>, DrawMesh> meshes;  // those that are blended last; by roles
      for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (atlas.places[i].page != int(page)) continue;
        const PatchPart& part = parts_[i];
        paint(part, atlas.places[i].at, picture);
        add(part, atlas.places[i].at, atlas.pages[page],
            meshes[{part.patch->blended, part.apart ? part.roles : std::uint8_t(0xff)}]);
      }
      const bool whole = isOpaque(picture);
      for (auto& [key, mesh] : meshes) {
        if (mesh.triangles.empty()) continue;
        const auto& [blended, roles] = key;
        mesh.part = "captures";
        mesh.material = fmt::format("captures {}{}", page, blended ? ", glass" : "");
        mesh.texture = int(model_.textures.size());
        mesh.alpha = blended ? AlphaMode::blend : whole ? AlphaMode::opaque : AlphaMode::mask;
        mesh.roles = roles;
        counts_.triangles += mesh.triangles.size();
        model_.meshes.push_back(std::move(mesh));
      }
      model_.textures.push_back({std::move(picture)});
      ++counts_.textures;
    }
    return counts_;
  }

 private:
  /// `reflections`: those that mirrors show.
  void find(const ShownCapture& shown, bool reflections) {
    if (!shown.capture->patches) return;
    const std::vector<float>* mirrors = nullptr;
    if (!reflections) {
      mirrors_.push_back(mirrorsOf(*shown.capture));
      if (!mirrors_.back().empty()) mirrors = &mirrors_.back();
    }
    for (const DisplayPatch& patch : shown.capture->patches->patches) {
      if ((patch.roles & shown.roles) == 0 || (patch.mirror != 0 && !reflections)) continue;
      const std::size_t before = parts_.size();
      if (roleMeshes_ == RoleMeshes::together) {
        cutToSize({&shown, &patch, shown.roles, false, mirrors, {}});
      } else {
        for (const std::uint8_t roles : rolesWithin(shown, patch))
          cutToSize({&shown, &patch, roles, true, mirrors, {}});
      }
      counts_.patches += parts_.size() > before ? 1 : 0;
    }
  }

  static std::set<std::uint8_t> rolesWithin(const ShownCapture& shown, const DisplayPatch& patch) {
    std::set<std::uint8_t> all;
    std::uint8_t ofFew = 0;
    const std::size_t texels = (std::size_t(patch.columns) + 2) * (std::size_t(patch.rows) + 2);
    for (std::size_t t = patch.firstTexel; t < patch.firstTexel + texels; ++t) {
      const auto roles = std::uint8_t(shown.capture->patches->cover[t] >> kTexelRoles);
      if ((roles & shown.roles) == 0) continue;
      all.insert(roles);
      if (roles != patch.roles) ofFew |= roles;
    }
    if (ofFew == patch.roles) all.erase(patch.roles);  // the others have what has them all
    return all;
  }

  /// Adds the patch in parts that fit a texture.
  void cutToSize(PatchPart part) {
    const int most = atlasPixels_ - 2 * kAtlasBorder;
    const glm::ivec2 end(part.patch->columns + 1, part.patch->rows + 1);
    for (int c = -1; c < end.x; c += most)
      for (int r = -1; r < end.y; r += most) {
        part.texels = {{c, r}, glm::min(end, glm::ivec2(c, r) + most)};
        part.texels = coveredOf(part);
        if (!part.texels.empty()) parts_.push_back(part);
      }
  }

  void paint(const PatchPart& part, const glm::ivec2& at, ColourImage& page) {
    const glm::ivec2 size = part.texels.size(), last(part.patch->columns, part.patch->rows);
    for (int y = -kAtlasBorder; y < size.y + kAtlasBorder; ++y)
      for (int x = -kAtlasBorder; x < size.x + kAtlasBorder; ++x) {
        const glm::ivec2 from = part.texels.low + glm::ivec2(x, y);
        const glm::ivec2 texel = glm::clamp(from, glm::ivec2(-1), last);
        Rgba8 colour = part.colour(texel.x, texel.y);
        if (texel != from) colour.a = 0;
        page.at(at.x + x, at.y + y) = colour;
        const bool own = x >= 0 && x < size.x && y >= 0 && y < size.y;
        counts_.samples += own && part.cover(texel.x, texel.y) != 0 ? 1 : 0;
      }
  }

  /// To the middles of the border: all between them is interpolated from the part's own texels and these.
  void add(const PatchPart& part, const glm::ivec2& at, const glm::ivec2& page, DrawMesh& mesh) {
    const ColumnCamera& camera = part.of->capture->camera;
    const PatchPlane plane{camera, glm::dvec3(part.patch->normal)};
    const glm::dvec2 first = glm::dvec2(part.patch->column, part.patch->row) + glm::dvec2(part.texels.low);
    rectangles_.clear();
    cut(plane, {first - 0.5, first + glm::dvec2(part.texels.size()) + 0.5}, rectangles_);
    for (const Rectangle& rectangle : rectangles_) {
      const auto vertex = std::uint32_t(mesh.positions.size());
      for (const glm::dvec2& corner : rectangle.corners()) {
        mesh.positions.emplace_back(camera.centreOfProjection - model_.origin + plane.position(corner));
        mesh.uv.emplace_back((glm::dvec2(at) + corner - first) / glm::dvec2(page));
      }
      mesh.triangles.emplace_back(vertex, vertex + 1, vertex + 2);
      mesh.triangles.emplace_back(vertex + 1, vertex + 3, vertex + 2);
    }
  }

  const RoleMeshes roleMeshes_;
  const int atlasPixels_;
  DrawModel& model_;
  std::vector<ShownCapture> behindMirrors_;
  std::deque<std::vector<float>> mirrors_;  ///< of captures that see any
  std::vector<PatchPart> parts_;
  std::vector<Rectangle> rectangles_;
  PatchModelCounts counts_;
};

}  // namespace

PatchModelCounts addPatches(std::span<const ShownCapture> shown, RoleMeshes meshes, int atlasPixels,
                            DrawModel& model, const std::stop_token& stop) {
  return PatchWriter(shown, meshes, atlasPixels, model).write(stop);
}

}  // namespace acentric
