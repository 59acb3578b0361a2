// acentric-sample-city TRIANGLES|town OUT.glb: writes a city of about so many triangles, or a flat town.

#include <charconv>
#include <cstdio>
#include <exception>
#include <string_view>

#include "projects/city/generator/city.h"
#include "projects/city/generator/town.h"

int main(int argc, char** argv) {
  std::size_t triangles = 0;
  const std::string_view text = argc == 3 ? argv[1] : "";
  const bool town = text == "town";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), triangles);
  if (!town && (argc != 3 || error != std::errc() || end != text.data() + text.size() ||
                triangles < 100'000 || triangles > 20'000'000)) {
    std::fputs(
        "usage: acentric-sample-city TRIANGLES OUT.glb\n       acentric-sample-city town OUT.glb\nWrites as "
        "glTF 2.0 a city of about 100000 to 20000000 triangles, the same streets whatever\ntheir number; or "
        "a "
        "flat town of 2 x 2 km and about 30000 triangles.\n",
        stderr);
    return 2;
  }
  try {
    namespace city = acentric::city;
    const auto written =
        acentric::gallery::writeModel(town ? city::makeTown() : city::makeCity(triangles), argv[2]);
    if (written) return 0;
    std::fprintf(stderr, "error: %s\n", written.error().describe().c_str());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
  }
  return 1;
}
