/// Packed captures (kind 1); what is accepted must be drawable.

#include "engine/store/keyed.h"
#include "engine/view/walk_scene.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const auto capture = withoutKey(keyedCaptureOf(test::withChecksum(data, size), "a pack"));
  if (!capture) return false;
  prepareForDisplay(*capture, 1);
  return true;
}
