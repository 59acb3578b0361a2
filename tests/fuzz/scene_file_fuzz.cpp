/// Scenes as the import cache keeps them.

#include "engine/scene/scene_file.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const test::MemoryFile file(test::bytesOf(data, size));
  return static_cast<bool>(readSceneFile(file.path(), [](const auto&) { return true; }));
}
