/// Seconds, triangles and error of simplifying what a model has around a place.
///   simplify_bench MODEL X Y [HALF_WIDTH] [TRIANGLES] [ERROR]
#include <fmt/format.h>

#include <cstdlib>

#include "engine/scene/import.h"
#include "engine/scene/simplify.h"

using namespace acentric;

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print("simplify_bench MODEL X Y [HALF_WIDTH] [TRIANGLES] [ERROR]\n");
    return 2;
  }
  const auto number = [&](int at, double otherwise) {
    return argc > at ? std::strtod(argv[at], nullptr) : otherwise;
  };
  const auto scene = parseScene(argv[1], {});
  if (!scene) {
    fmt::print("{}\n", scene.error().describe());
    return 1;
  }
  const glm::dvec2 at(number(2, 0), number(3, 0));
  const double half = number(4, 1.5);
  const LocalGeometry full =
      clipToPolygon(*scene, {{at + glm::dvec2(-half, -half), at + glm::dvec2(half, -half),
                              at + glm::dvec2(half), at + glm::dvec2(-half, half)}});
  SimplifyOptions options;
  options.mostTriangles = static_cast<std::size_t>(number(5, 0));
  options.maxError = number(6, 0.005);
  const auto simplified = simplify(*scene, full, options);
  if (!simplified) {
    fmt::print("{}\n", simplified.error().describe());
    return 1;
  }
  const SimplifyReport& r = simplified->report;
  fmt::print(
      "{} -> {} triangles ({} at the rim, {} set apart) in {:.2f} s: {:.0f} triangles taken away per "
      "second\n",
      r.before, r.after, r.rim, r.split, r.seconds, double(r.before - r.after) / r.seconds);
  fmt::print(
      "error at most {:.3f} mm, mean {:.4f} mm ({} samples); within the error: {}, within the budget: {}\n",
      1e3 * r.maxError, 1e3 * r.meanError, r.errorSamples, r.withinError, r.withinBudget);
  fmt::print("{} light samples placed\n", simplified->lightPlaces.size());
  return 0;
}
