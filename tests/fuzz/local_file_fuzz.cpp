/// Near geometry of bundles (kind 4).

#include "engine/export/bundle_read.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMaterials = 20, kMirrors = 4;
  return readLocalFile(test::withChecksum(data, size), "a region", kMaterials, kMirrors).has_value();
}
