#include "engine/cli/mesh_budget.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric::cli {
namespace {

Json costJson(const MeshCost& cost) {
  return {{"errorSamples", cost.error},
          {"samples", cost.samples},
          {"triangles", cost.triangles},
          {"bytes", cost.bytes},
          {"buildMs", cost.buildSeconds * 1e3}};
}

}  // namespace

void MeshBudget::add(const FrameStats& stats) {
  ++frames_;
  drawn_ += stats.meshTriangles;
  for (const MeshCost& cost : stats.meshes) meshes_[cost.camera] = cost;
}

MeshCost MeshBudget::sum() const {
  MeshCost all;
  for (const auto& [camera, cost] : meshes_) all.add(cost);
  return all;
}

Json MeshBudget::json() const {
  const MeshCost all = sum();
  Json json = {{"trianglesDrawnPerFrame", drawnPerFrame()}};
  json.update(costJson(all));
  json["captures"] = Json::array();
  for (const auto& [camera, cost] : meshes_) {
    Json one = {{"camera", camera}};
    one.update(costJson(cost));
    json["captures"].push_back(std::move(one));
  }
  return json;
}

std::string MeshBudget::text() const {
  const MeshCost all = sum();
  std::uint64_t most = 0;
  for (const auto& [camera, cost] : meshes_) most = std::max(most, cost.triangles);
  return fmt::format(
      "  meshes of {} captures within {:g} samples: {} triangles of {} samples ({} at most in one), {}, "
      "built in "
      "{:.0f} ms; {} triangles drawn a frame\n",
      meshes_.size(), all.error, countText(all.triangles), countText(all.samples), countText(most),
      bytesText(all.bytes), all.buildSeconds * 1e3, countText(std::uint64_t(drawnPerFrame())));
}

}  // namespace acentric::cli
