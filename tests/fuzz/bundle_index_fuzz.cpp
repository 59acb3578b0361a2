/// bundle.json; what is accepted must be walkable.

#include "engine/export/bundle_read.h"
#include "engine/view/view_cameras.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const auto bundle = parseBundle(std::string(reinterpret_cast<const char*>(data), size), "bundle.json");
  if (!bundle) return false;
  for (const BundleStorey& storey : bundle->storeys)
    for (const Region& region : storey.layout.regions)
      for (const double yaw : {0.0, 1.5, -2.5}) {
        PerspectiveView view;
        view.eye = glm::dvec3(region.polygon.centroid(), storey.layout.eyeZ());
        view.yawRadians = yaw, view.width = 64, view.height = 36;
        paintingOrder(storey.layout, view, bundle->view);
      }
  return true;
}
