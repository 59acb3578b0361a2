/// Seconds, triangles and error of simplifying what a model has around a place.

#include "engine/scene/simplify.h"
#include "engine/scene/import.h"
#include "engine/scene/local_geometry.h"
#include "tests/bench_functions/benches.h"

namespace acentric::bench {

Status benchSimplify(const Subject& subject, Figures& figures) {
  const auto scene = parseScene(subject.model, {});
  if (!scene) return tl::unexpected(scene.error());
  const glm::dvec2 at = subject.at.value_or(glm::dvec2(scene->bounds.centre()));
  const double half = subject.halfWidth;
  const LocalGeometry full =
      clipToPolygon(*scene, {{at + glm::dvec2(-half, -half), at + glm::dvec2(half, -half),
                              at + glm::dvec2(half), at + glm::dvec2(-half, half)}});
  SimplifyOptions options;
  options.mostTriangles = subject.triangles;
  options.maxError = subject.error;
  const auto simplified = simplify(*scene, full, options);
  if (!simplified) return tl::unexpected(simplified.error());
  const SimplifyReport& r = simplified->report;
  figures.add("simplify", "s", {r.seconds});
  figures.fact("triangles before", r.before);
  figures.fact("triangles after", r.after);
  figures.fact("triangles at the rim", r.rim);
  figures.fact("triangles set apart", r.split);
  figures.fact("millimetres of the largest error", 1e3 * r.maxError);
  figures.fact("millimetres of the mean error", 1e3 * r.meanError);
  figures.fact("within the error", r.withinError);
  figures.fact("within the budget", r.withinBudget);
  return {};
}

}  // namespace acentric::bench
