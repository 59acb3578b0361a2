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
#include "engine/store/packed_text.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using Json = BundleJson;
using namespace walk_format;

/// Of one page that has others below it.
constexpr std::size_t kMostChildren = 32;
/// Regions so many steps from those of a page are in it too: an eye that crosses its border has seen nothing
/// of the next page yet.
constexpr int kStepsBeyond = 2;

struct Box {
  glm::dvec2 low{std::numeric_limits<double>::max()}, high{-std::numeric_limits<double>::max()};
  void add(const glm::dvec2& point) { low = glm::min(low, point), high = glm::max(high, point); }
  void add(const Box& other) { add(other.low), add(other.high); }
};

/// One storey of the index and of the bundle.
struct Source {
  const Json& json;
  const BundleStorey& storey;
};

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

  /// A file of the index with its place.
  Json placed(Json file) const {
    if (file.is_object()) file["at"] = places_.at(file["file"].get<std::string>());
    return file;
  }

  Json addPage(const Json& page, const Box& box, bool leaf) {
    const std::string text = jsonText(page);
    const std::vector<std::byte> bytes = packedText(text);
    const std::uint64_t at = pages_.size();
    pages_.insert(pages_.end(), bytes.begin(), bytes.end());
    return {{"at", at},
            {"bytes", bytes.size()},
            {"raw", text.size()},
            {"hash", hashText(bytes)},
            {"box", {box.low.x, box.low.y, box.high.x, box.high.y}},
            {"leaf", leaf}};
  }

  static Box boxOf(const BundleStorey& storey, std::span<const int> regions) {
    Box box;
    for (const int region : regions)
      for (const glm::dvec2& corner : storey.layout.regions[std::size_t(region)].polygon.corners)
        box.add(corner);
    return box;
  }

  /// The regions themselves, those around them, and the cameras of all of these, by numbers within the page.
  Json leafOf(const Source& source, std::span<const int> regions) {
    const BundleStorey& storey = source.storey;
    const std::set<int> own(regions.begin(), regions.end());
    std::set<int> all = own, last = own;
    for (int step = 0; step < kStepsBeyond; ++step) {
      std::set<int> next;
      for (const int region : last)
        for (const int neighbour : storey.neighbours[std::size_t(region)])
          if (all.insert(neighbour).second) next.insert(neighbour);
      last = std::move(next);
    }
    std::map<int, int> number;  // in the order of the storey: an eye is in the first that holds it
    for (const int region : all) number.emplace(region, int(number.size()));
    std::map<int, int> cameraNumber;
    Json cameras = Json::array(), listed = Json::array();
    const auto addCamera = [&](int camera) {
      const auto [found, isNew] = cameraNumber.emplace(camera, int(cameraNumber.size()));
      if (isNew) {
        Json json = source.json["cameras"][std::size_t(camera)];
        json["number"] = camera;
        json["full"] = placed(json["full"]), json["coarse"] = placed(json["coarse"]);
        cameras.push_back(std::move(json));
      }
      return found->second;
    };
    const auto renumber = [&](Json covers) {
      for (Json& cover : covers)
        for (Json& piece : cover["pieces"]) piece["camera"] = addCamera(piece["camera"].get<int>());
      return covers;
    };
    for (const int region : all) {
      Json json = source.json["regions"][std::size_t(region)];
      json["number"] = region, json["own"] = own.contains(region);
      json["local"] = placed(json["local"]);
      json["covers"] = renumber(json["covers"]), json["panoramas"] = renumber(json["panoramas"]);
      Json neighbours = Json::array();
      for (const int neighbour : storey.neighbours[std::size_t(region)])
        if (const auto found = number.find(neighbour); found != number.end())
          neighbours.push_back(found->second);
      json["neighbours"] = std::move(neighbours);
      listed.push_back(std::move(json));
    }
    // Cameras that nothing shows go with the first page.
    for (const int camera : unused_) addCamera(camera);
    return {{"cameras", std::move(cameras)}, {"regions", std::move(listed)}};
  }

  /// Halves along the longer side.
  static std::pair<std::vector<int>, std::vector<int>> halves(const BundleStorey& storey,
                                                              std::vector<int> regions) {
    Box middles;
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
  Json pageOf(const Source& source, std::vector<int> regions) {
    const Box box = boxOf(source.storey, regions);
    auto most = std::size_t(options_.regionsPerPage);
    if (regions.size() <= most) {
      const Json leaf = leafOf(source, regions);
      if (regions.size() == 1 || jsonText(leaf).size() <= kMostPageBytes) {
        unused_.clear();
        return addPage(leaf, box, true);
      }
      most = (regions.size() + 1) / 2;  // no reader takes it as it is
    }
    std::vector<std::vector<int>> parts{std::move(regions)};
    while (parts.size() < kMostChildren) {
      const auto largest = std::ranges::max_element(parts, {}, &std::vector<int>::size);
      if (largest->size() <= most) break;
      auto [low, high] = halves(source.storey, std::move(*largest));
      *largest = std::move(low);
      parts.push_back(std::move(high));
    }
    Json children = Json::array();
    for (std::vector<int>& part : parts) children.push_back(pageOf(source, std::move(part)));
    return addPage({{"pages", std::move(children)}}, box, false);
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
    for (Json& texture : root["textures"]) texture = placed(texture);
    for (std::size_t s = 0; s < bundle_.storeys.size(); ++s) {
      const BundleStorey& storey = bundle_.storeys[s];
      const Source source{index_["storeys"][s], storey};
      std::vector<int> all(storey.layout.regions.size());
      for (std::size_t r = 0; r < all.size(); ++r) all[r] = int(r);
      unused_ = camerasUnusedIn(storey);
      Json& json = root["storeys"][s];
      json.erase("cameras"), json.erase("regions");
      double top = -HUGE_VAL, bottom = HUGE_VAL;
      for (const BundleCamera& camera : storey.cameras)
        top = std::max(top, camera.topElevation), bottom = std::min(bottom, camera.bottomElevation);
      json["topElevation"] = storey.cameras.empty() ? 0 : top;
      json["bottomElevation"] = storey.cameras.empty() ? 0 : bottom;
      json["cameraCount"] = storey.cameras.size(), json["regionCount"] = all.size();
      json["page"] = all.empty() ? Json() : pageOf(source, std::move(all));
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
