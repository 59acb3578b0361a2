#include "engine/export/tileset.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/export/bundle_json.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kRounding = 1e-3;  // metres by which boxes of content are larger: readers have it in floats

Json volume(const TileBox& box) {
  Json numbers = Json::array();
  for (const glm::dvec3& v : {box.centre, box.halves[0], box.halves[1], box.halves[2]})
    for (int i = 0; i < 3; ++i) numbers.push_back(v[i]);
  return {{"box", std::move(numbers)}};
}

TileBox boxOf(const glm::dvec3& low, const glm::dvec3& high) {
  TileBox box{0.5 * (low + high), glm::dmat3(0)};
  for (int i = 0; i < 3; ++i) box.halves[i][i] = 0.5 * (high[i] - low[i]);
  return box;
}

/// Upright boxes around many things.
struct Extent {
  glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const TileBox& box) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 sides(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      add(box.centre + box.halves * sides);
    }
  }
  TileBox box() const { return boxOf(low, high); }
};

TileBox contentBox(const Bounds& bounds) {
  return boxOf(glm::dvec3(bounds.min) - kRounding, glm::dvec3(bounds.max) + kRounding);
}

class TilesetWriter {
 public:
  TilesetWriter(std::vector<RegionTile> tiles, const std::string& generator, Json extras,
                const fs::path& folder)
      : tiles_(std::move(tiles)), generator_(generator), extras_(std::move(extras)), folder_(folder) {
    Extent all;
    for (const RegionTile& tile : tiles_) all.add(contentBox(tile.bounds));
    error_ = glm::distance(all.low, all.high);
  }

  Status write() {
    const auto root = tileOf(tiles_);
    if (!root) return tl::unexpected(root.error());
    return writeTree(kTilesetIndex, *root, true);
  }

 private:
  /// Without content: what stands in for `tiles`, and is refined wherever one is, however far away.
  Json around(std::span<const RegionTile> tiles) const {
    Extent content, request;
    for (const RegionTile& tile : tiles) content.add(contentBox(tile.bounds)), request.add(requestBox(tile));
    return {{"boundingVolume", volume(content.box())},
            {"viewerRequestVolume", volume(request.box())},
            {"geometricError", error_},
            {"refine", "ADD"}};
  }

  Json leaf(const RegionTile& tile) const {
    return {{"boundingVolume", volume(contentBox(tile.bounds))},
            {"viewerRequestVolume", volume(requestBox(tile))},
            {"geometricError", 0},
            {"content", {{"uri", tile.file}}},
            {"extras", tile.extras}};
  }

  /// The tile with all of these below it; in tilesets of their own where they are many.
  Result<Json> tileOf(std::span<RegionTile> tiles) {
    Json out = around(tiles);
    out["children"] = Json::array();
    if (tiles.size() <= kMostTiles) {
      for (const RegionTile& tile : tiles) out["children"].push_back(leaf(tile));
      return out;
    }
    std::vector<std::span<RegionTile>> parts{tiles};
    while (parts.size() < kMostTiles && parts.front().size() > kMostTiles) {
      std::vector<std::span<RegionTile>> halves;
      for (const auto& part : parts)
        for (const auto& half : halved(part)) halves.push_back(half);
      parts = std::move(halves);
    }
    for (const auto& part : parts) {
      const std::string file = fmt::format("tileset-{}.json", ++files_);
      const auto root = tileOf(part);
      if (!root) return root;
      if (Status written = writeTree(file, *root, false); !written) return tl::unexpected(written.error());
      Json child = around(part);
      child["content"] = {{"uri", file}};
      out["children"].push_back(std::move(child));
    }
    return out;
  }

  /// Across the longer side of where the regions lie.
  static std::array<std::span<RegionTile>, 2> halved(std::span<RegionTile> tiles) {
    Extent middles;
    const auto middle = [](const RegionTile& tile) { return glm::dvec3(tile.polygon.centroid(), tile.eyeZ); };
    for (const RegionTile& tile : tiles) middles.add(middle(tile));
    const glm::dvec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = (tiles.size() + 1) / 2;  // the first is the largest
    std::ranges::stable_sort(tiles, {}, [&](const RegionTile& tile) { return middle(tile)[axis]; });
    return {tiles.first(half), tiles.subspan(half)};
  }

  Status writeTree(const std::string& file, const Json& root, bool first) const {
    Json asset{{"version", "1.1"}};
    if (first) asset["extras"] = {{"format", kTilesetFormat}, {"version", 1}, {"generator", generator_}};
    Json json{{"asset", std::move(asset)}, {"geometricError", error_}, {"root", root}};
    if (first) json["extras"] = extras_;
    return writeTextAtomically(folder_ / file, layOut(json));
  }

  std::vector<RegionTile> tiles_;
  const std::string& generator_;
  const Json extras_;
  const fs::path& folder_;
  double error_ = 0;  ///< metres: of what is not shown at all
  int files_ = 0;
};

}  // namespace

TileBox requestBox(const RegionTile& tile) {
  const auto& corners = tile.polygon.corners;
  double least = std::numeric_limits<double>::max();
  TileBox box;
  for (std::size_t i = 0; i < corners.size(); ++i) {  // one of its sides is one of the polygon's
    const glm::dvec2 along = glm::normalize(corners[(i + 1) % corners.size()] - corners[i]),
                     across(-along.y, along.x);
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::dvec2& corner : corners) {
      const glm::dvec2 at(glm::dot(corner, along), glm::dot(corner, across));
      low = glm::min(low, at), high = glm::max(high, at);
    }
    const glm::dvec2 half = 0.5 * (high - low) + kRequestMargin, middle = 0.5 * (low + high);
    if (half.x * half.y >= least) continue;
    least = half.x * half.y;
    box.centre = {middle.x * along + middle.y * across, tile.eyeZ};
    box.halves = glm::dmat3(glm::dvec3(half.x * along, 0), glm::dvec3(half.y * across, 0),
                            glm::dvec3(0, 0, 0.5 * tile.eyeHeight));
  }
  return box;
}

Status writeTileset(std::vector<RegionTile> tiles, const std::string& generator, Json extras,
                    const fs::path& folder) {
  require(!tiles.empty(), "a tileset has a tile");
  return TilesetWriter(std::move(tiles), generator, std::move(extras), folder).write();
}

}  // namespace acentric
