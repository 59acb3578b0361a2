/// GLB files with compressed geometry (meshopt, Draco), as the importer's process reads them.

#include "engine/scene/import.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const test::MemoryFile file(test::bytesOf(data, size));
  return static_cast<bool>(parseScene(file.path(), {}));
}
