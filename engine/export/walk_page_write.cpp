#include "engine/export/walk_page_write.h"

#include "engine/base/contract.h"

namespace acentric {

using Json = BundleJson;

namespace {
constexpr int kStepsBeyond = 2;
}  // namespace

std::set<int> withBeyond(const std::vector<std::vector<int>>& neighbours, const std::set<int>& own) {
  std::set<int> all = own, last = own;
  for (int step = 0; step < kStepsBeyond; ++step) {
    std::set<int> next;
    for (const int region : last)
      for (const int neighbour : neighbours[std::size_t(region)])
        if (all.insert(neighbour).second) next.insert(neighbour);
    last = std::move(next);
  }
  return all;
}

Json placedFile(Json file, std::uint64_t at) {
  if (file.is_object()) file["at"] = at;
  return file;
}

Json leafPage(const WalkLeaf& leaf, const PlaceOfFile& placeOf) {
  const BundleStorey& part = leaf.part;
  require(leaf.cameras.size() == part.cameras.size() && leaf.regions.size() == part.layout.regions.size() &&
              leaf.own.size() == leaf.regions.size(),
          "each camera and region of a page has a number");
  Json lists = placesJson(part);
  const auto put = [&](Json& json, const auto& described) {
    if (described) json["at"] = placeOf(described->file);
  };
  for (std::size_t c = 0; c < leaf.cameras.size(); ++c) {
    Json& camera = lists["cameras"][c];
    camera["number"] = leaf.cameras[c];
    put(camera["full"], part.cameras[c].full), put(camera["coarse"], part.cameras[c].coarse);
  }
  for (std::size_t r = 0; r < leaf.regions.size(); ++r) {
    Json& region = lists["regions"][r];
    region["number"] = leaf.regions[r], region["own"] = leaf.own[r] != 0;
    put(region["local"], part.local[r]);
  }
  return lists;
}

Json innerPage(std::vector<Json> entries) {
  require(entries.size() <= kMostWalkChildren, "a page has so many below it");
  Json pages = Json::array();
  for (Json& entry : entries) pages.push_back(std::move(entry));
  return {{"pages", std::move(pages)}};
}

Json pageEntry(std::uint64_t at, std::uint64_t bytes, const std::string& hash, std::uint64_t raw,
               const WalkBox& box, bool leaf) {
  return {{"at", at},
          {"bytes", bytes},
          {"raw", raw},
          {"hash", hash},
          {"box", {box.low.x, box.low.y, box.high.x, box.high.y}},
          {"leaf", leaf}};
}

void putPage(Json& storey, const WalkStoreyCounts& counts, Json page) {
  storey.erase("cameras"), storey.erase("regions");
  storey["topElevation"] = counts.topElevation, storey["bottomElevation"] = counts.bottomElevation;
  storey["cameraCount"] = counts.cameras, storey["regionCount"] = counts.regions;
  storey["page"] = std::move(page);
}

}  // namespace acentric
