/// Project files and camera paths; what is accepted must survive being written and read.

#include <cstdlib>

#include "engine/pipeline/project.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

bool accepts(const std::uint8_t* data, std::size_t size) {
  const auto project = parseProject(std::string(reinterpret_cast<const char*>(data), size), "a project");
  if (project && !parseProject(formatProject(*project), "the same")) std::abort();
  const test::MemoryFile file(test::bytesOf(data, size));
  return loadPath(file.path()) || project;
}
