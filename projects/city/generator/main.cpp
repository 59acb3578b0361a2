// acentric-sample-city TRIANGLES OUT.glb: writes a city of about so many triangles.

#include <charconv>
#include <cstdio>
#include <exception>
#include <string_view>

#include "projects/city/generator/city.h"

int main(int argc, char** argv) {
  std::size_t triangles = 0;
  const std::string_view text = argc == 3 ? argv[1] : "";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), triangles);
  if (argc != 3 || error != std::errc() || end != text.data() + text.size() || triangles < 100'000 ||
      triangles > 20'000'000) {
    std::fputs(
        "usage: acentric-sample-city TRIANGLES OUT.glb\nWrites a city of about 100000 to 20000000 triangles "
        "as "
        "glTF 2.0, the same streets whatever their number.\n",
        stderr);
    return 2;
  }
  try {
    const auto written = acentric::gallery::writeModel(acentric::city::makeCity(triangles), argv[2]);
    if (written) return 0;
    std::fprintf(stderr, "error: %s\n", written.error().describe().c_str());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
  }
  return 1;
}
