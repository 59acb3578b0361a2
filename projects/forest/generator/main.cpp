// acentric-sample-forest TRIANGLES OUT.glb [SEED]: writes a town in a forest of about so many triangles.

#include <charconv>
#include <cstdio>
#include <exception>
#include <string_view>

#include "projects/forest/generator/forest.h"

namespace {

bool parse(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

int main(int argc, char** argv) {
  namespace forest = acentric::forest;
  forest::ForestOptions options;
  if (argc < 3 || argc > 4 || !parse(argv[1], options.triangles) ||
      options.triangles < forest::kFewestTriangles || options.triangles > forest::kMostTriangles ||
      (argc == 4 && !parse(argv[3], options.seed))) {
    std::fputs(
        "usage: acentric-sample-forest TRIANGLES OUT.glb [SEED]\nWrites as glTF 2.0 a small town in a "
        "forest, "
        "100000 to 4000000000 triangles in all places together,\nby EXT_mesh_gpu_instancing and "
        "EXT_meshopt_compression: the same street whatever their number.\n",
        stderr);
    return 2;
  }
  try {
    const auto written = acentric::gallery::writeModel(forest::makeForest(options), argv[2],
                                                       acentric::gallery::ModelCoding::compact);
    if (written) return 0;
    std::fprintf(stderr, "error: %s\n", written.error().describe().c_str());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
  }
  return 1;
}
