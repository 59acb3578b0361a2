/// Surface light and simplified geometry of the store (kinds 2 and 3).

#include "engine/store/capture_store.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const test::MemoryFile file(test::withChecksum(data, size));
  const bool light = readSurfaceLight(file.path()).has_value();
  const bool simplified = readSimplified(file.path()).has_value();
  return light || simplified;
}
