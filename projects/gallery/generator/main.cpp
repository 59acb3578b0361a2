// acentric-sample-gallery OUT.glb|OUT.gltf: writes the sample scene.

#include <cstdio>
#include <exception>
#include <string_view>

#include "projects/gallery/generator/gallery.h"

int main(int argc, char** argv) {
  if (argc != 2 || std::string_view(argv[1]).starts_with("-")) {
    std::fputs(
        "usage: acentric-sample-gallery OUT.glb|OUT.gltf\nWrites the sample scene, a small gallery, as glTF "
        "2.0.\n",
        stderr);
    return argc == 2 && std::string_view(argv[1]) == "--help" ? 0 : 2;
  }
  try {
    const auto written = acentric::gallery::writeModel(acentric::gallery::makeGallery(), argv[1]);
    if (written) return 0;
    std::fprintf(stderr, "error: %s\n", written.error().describe().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  return 1;
}
