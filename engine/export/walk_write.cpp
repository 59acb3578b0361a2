#include "engine/export/walk_write.h"

#include <algorithm>
#include <deque>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/export/bundle.h"
#include "engine/export/bundle_json.h"
#include "engine/export/bundle_read.h"
#include "engine/export/walk_format.h"
#include "engine/export/walk_page_write.h"
#include "engine/store/packed_text.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = BundleJson;
using namespace walk_format;

class WalkWriter {
 public:
  WalkWriter(const fs::path& folder, Json index, const Bundle& bundle, const WalkOptions& options)
      : folder_(folder), index_(std::move(index)), bundle_(bundle), options_(options) {}

  Result<std::uint64_t> write(const fs::path& file, const std::stop_token& stop) {
    placeData();
    const std::string text = jsonText(rootJson());
    const std::vector<std::byte> root = packedText(text);
    Header header;
    header.rootBytes = root.size(), header.rootRaw = text.size();
    header.pageStart = kHeaderBytes + root.size();
    header.dataStart = header.pageStart + pages_.size();
    header.fileBytes = header.dataStart + dataBytes_;
    const auto hash = ContentKey::fromHex(hashText(root));
    if (!hash) return tl::unexpected(hash.error());
    header.rootHash = {hash->high, hash->low};
    const Status written = replaceFileAtomically(file, [&](const fs::path& temporary) -> Status {
      std::ofstream out(temporary, std::ios::binary);
      const auto put = [&](std::span<const std::byte> bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
      };
      put(headerBytes(header)), put(root), put(pages_);
      for (const std::string& name : order_) {
        if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped", file.string());
        const auto bytes = readFile(folder_ / name);
        if (!bytes) return tl::unexpected(bytes.error());
        put(*bytes);
      }
      out.flush();
      if (!out) return fail(ErrorKind::outOfSpace, "cannot be written: is the disk full?", file.string());
      return {};
    });
    if (!written) return tl::unexpected(written.error());
    return header.fileBytes;
  }

 private:
  void place(const BundleFile& file) {
    if (!places_.emplace(file.path, dataBytes_).second) return;
    order_.push_back(file.path);
    dataBytes_ += file.bytes;
  }

  /// Cameras of a region, those of its first cover first.
  static std::vector<int> camerasOf(const BundleStorey& storey, std::size_t region) {
    std::vector<int> cameras;
    const auto add = [&](const std::vector<Cover>& covers) {
      for (const Cover& cover : covers)
        for (const Piece& piece : cover.pieces)
          if (std::ranges::find(cameras, piece.camera) == cameras.end()) cameras.push_back(piece.camera);
    };
    add(storey.layout.regions[region].covers), add(storey.layout.panoramas[region]);
    return cameras;
  }

  void placeCaptures(const BundleStorey& storey, std::size_t region,
                     std::optional<BundleCapture> BundleCamera::*rendition) {
    for (const int camera : camerasOf(storey, region))
      if (const auto& capture = storey.cameras[std::size_t(camera)].*rendition) place(capture->file);
  }

  void placeRegion(const BundleStorey& storey, std::size_t region, bool first) {
    placeCaptures(storey, region, &BundleCamera::coarse);
    if (storey.local[region]) place(storey.local[region]->file);
    if (first)
      for (const BundleTexture& texture : bundle_.textures) place(texture.file);
    placeCaptures(storey, region, &BundleCamera::full);
  }

  static std::size_t startRegion(const BundleStorey& storey) {
    const int region = storey.layout.nearestRegion(storey.start).region;
    return std::size_t(std::max(region, 0));
  }

  /// From where the walk begins outwards, storey after storey.
  void placeData() {
    std::vector<std::size_t> storeys{std::size_t(bundle_.storey)};
    for (std::size_t s = 0; s < bundle_.storeys.size(); ++s)
      if (s != storeys.front()) storeys.push_back(s);
    bool first = true;
    for (const std::size_t s : storeys) {
      const BundleStorey& storey = bundle_.storeys[s];
      std::vector<char> seen(storey.layout.regions.size(), 0);
      const auto from = [&](std::size_t start) {
        std::deque<std::size_t> next{start};
        seen[start] = 1;
        while (!next.empty()) {
          const std::size_t region = next.front();
          next.pop_front();
          placeRegion(storey, region, std::exchange(first, false));
          for (const int neighbour : storey.neighbours[region])
            if (std::exchange(seen[std::size_t(neighbour)], 1) == 0) next.push_back(std::size_t(neighbour));
        }
      };
      if (!seen.empty()) from(startRegion(storey));
      for (std::size_t region = 0; region < seen.size(); ++region)
        if (seen[region] == 0) from(region);
      for (const BundleCamera& camera : storey.cameras)
        for (const auto* capture : {&camera.coarse, &camera.full})
          if (*capture) place((*capture)->file);
    }
    for (const BundleTexture& texture : bundle_.textures) place(texture.file);
  }

  std::uint64_t placeOf(const BundleFile& file) const { return places_.at(file.path); }

  Json addPage(const Json& page, const WalkBox& box, bool leaf) {
    const std::string text = jsonText(page);
    const std::vector<std::byte> bytes = packedText(text);
    const std::uint64_t at = pages_.size();
    pages_.insert(pages_.end(), bytes.begin(), bytes.end());
    return pageEntry(at, bytes.size(), hashText(bytes), text.size(), box, leaf);
  }

  static WalkBox boxOf(const BundleStorey& storey, std::span<const int> regions) {
    WalkBox box;
    for (const int region : regions)
      for (const glm::dvec2& corner : storey.layout.regions[std::size_t(region)].polygon.corners)
        box.add(corner);
    return box;
  }

  /// The regions, those around them, and the cameras of all of these, by numbers within the page.
  Json leafOf(const BundleStorey& storey, std::span<const int> regions) {
    const std::set<int> own(regions.begin(), regions.end()), all = withBeyond(storey.neighbours, own);
    std::map<int, int> number;  // in the order of the storey: an eye is in the first that holds it
    for (const int region : all) number.emplace(region, int(number.size()));
    WalkLeaf leaf;
    std::map<int, int> cameraNumber;
    const auto addCamera = [&](int camera) {
      const auto [found, isNew] = cameraNumber.emplace(camera, int(cameraNumber.size()));
      if (isNew) {
        leaf.part.layout.cameras.push_back(storey.layout.cameras[std::size_t(camera)]);
        leaf.part.cameras.push_back(storey.cameras[std::size_t(camera)]);
        leaf.cameras.push_back(std::uint64_t(camera));
      }
      return found->second;
    };
    const auto renumber = [&](std::vector<Cover> covers) {
      for (Cover& cover : covers)
        for (Piece& piece : cover.pieces) piece.camera = addCamera(piece.camera);
      return covers;
    };
    for (const int r : all) {
      const auto region = std::size_t(r);
      leaf.regions.push_back(region), leaf.own.push_back(own.contains(r) ? 1 : 0);
      leaf.part.layout.regions.push_back(storey.layout.regions[region]);
      std::vector<Cover>& covers = leaf.part.layout.regions.back().covers;
      covers = renumber(std::move(covers));
      leaf.part.layout.panoramas.push_back(renumber(storey.layout.panoramas[region]));
      leaf.part.local.push_back(storey.local[region]);
      leaf.part.neighbours.emplace_back();
      for (const int neighbour : storey.neighbours[region])
        if (const auto found = number.find(neighbour); found != number.end())
          leaf.part.neighbours.back().push_back(found->second);
    }
    // Cameras that nothing shows go with the first page.
    for (const int camera : unused_) addCamera(camera);
    return leafPage(leaf, [this](const BundleFile& file) { return placeOf(file); });
  }

  /// Halves along the longer side.
  static std::pair<std::vector<int>, std::vector<int>> halves(const BundleStorey& storey,
                                                              std::vector<int> regions) {
    WalkBox middles;
    const auto middleOf = [&](int region) {
      return storey.layout.regions[std::size_t(region)].polygon.centroid();
    };
    for (const int region : regions) middles.add(middleOf(region));
    const int axis = middles.high.x - middles.low.x < middles.high.y - middles.low.y ? 1 : 0;
    std::ranges::stable_sort(regions, {}, [&](int region) { return middleOf(region)[axis]; });
    const auto half = regions.begin() + std::ptrdiff_t(regions.size() / 2);
    return {{regions.begin(), half}, {half, regions.end()}};
  }

  /// The entry of the page that holds these regions, or of the one above those that do.
  Json pageOf(const BundleStorey& storey, std::vector<int> regions) {
    const WalkBox box = boxOf(storey, regions);
    auto most = std::size_t(options_.regionsPerPage);
    if (regions.size() <= most) {
      const Json leaf = leafOf(storey, regions);
      if (regions.size() == 1 || jsonText(leaf).size() <= kMostPageBytes) {
        unused_.clear();
        return addPage(leaf, box, true);
      }
      most = (regions.size() + 1) / 2;  // no reader takes it as it is
    }
    std::vector<std::vector<int>> parts{std::move(regions)};
    while (parts.size() < kMostWalkChildren) {
      const auto largest = std::ranges::max_element(parts, {}, &std::vector<int>::size);
      if (largest->size() <= most) break;
      auto [low, high] = halves(storey, std::move(*largest));
      *largest = std::move(low);
      parts.push_back(std::move(high));
    }
    std::vector<Json> children;
    for (std::vector<int>& part : parts) children.push_back(pageOf(storey, std::move(part)));
    return addPage(innerPage(std::move(children)), box, false);
  }

  static std::set<int> camerasUnusedIn(const BundleStorey& storey) {
    std::set<int> unused;
    for (std::size_t c = 0; c < storey.cameras.size(); ++c) unused.insert(int(c));
    for (std::size_t r = 0; r < storey.layout.regions.size(); ++r)
      for (const int camera : camerasOf(storey, r)) unused.erase(camera);
    return unused;
  }

  Json rootJson() {
    Json root = index_;
    for (std::size_t t = 0; t < bundle_.textures.size(); ++t)
      root["textures"][t] = placedFile(root["textures"][t], placeOf(bundle_.textures[t].file));
    for (std::size_t s = 0; s < bundle_.storeys.size(); ++s) {
      const BundleStorey& storey = bundle_.storeys[s];
      std::vector<int> all(storey.layout.regions.size());
      for (std::size_t r = 0; r < all.size(); ++r) all[r] = int(r);
      unused_ = camerasUnusedIn(storey);
      WalkStoreyCounts counts{storey.cameras.size(), all.size(), -HUGE_VAL, HUGE_VAL};
      for (const BundleCamera& camera : storey.cameras) {
        counts.topElevation = std::max(counts.topElevation, camera.topElevation);
        counts.bottomElevation = std::min(counts.bottomElevation, camera.bottomElevation);
      }
      if (storey.cameras.empty()) counts.topElevation = counts.bottomElevation = 0;
      putPage(root["storeys"][s], counts, all.empty() ? Json() : pageOf(storey, std::move(all)));
    }
    return root;
  }

  const fs::path& folder_;
  const Json index_;
  const Bundle& bundle_;
  const WalkOptions& options_;
  std::map<std::string, std::uint64_t> places_;  ///< of files, from where data begin
  std::vector<std::string> order_;
  std::uint64_t dataBytes_ = 0;
  std::vector<std::byte> pages_;
  std::set<int> unused_;  ///< cameras of the storey that no page has yet and no region shows
};

}  // namespace

Result<std::uint64_t> writeWalk(const fs::path& folder, const fs::path& file, const WalkOptions& options,
                                const std::stop_token& stop) {
  const auto text = readText(folder / kBundleIndex);
  if (!text) return tl::unexpected(text.error());
  const auto bundle = parseBundle(*text, (folder / kBundleIndex).string());
  if (!bundle) return tl::unexpected(bundle.error());
  auto index = parseJson<Json>(*text, kBundleIndex);
  if (!index) return tl::unexpected(index.error());
  return WalkWriter(folder, std::move(*index), *bundle, options).write(file, stop);
}

}  // namespace acentric
