#pragma once
/// The benches: each times some functions of the engine, beside naive variants and references where there
/// are.

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/base/result.h"
#include "tests/bench_functions/figures.h"

namespace acentric::bench {

/// On what.
struct Subject {
  std::filesystem::path model, project;  ///< for those that need one
  std::optional<glm::dvec2> at;          ///< a place of the model, metres; none: its middle
  double nearBand = 1, halfWidth = 1.5;  ///< metres
  std::size_t regions = 1000, planRegions = 100'000;
  std::size_t triangles = 0;  ///< simplify to so many; 0: as many as the error allows
  double error = 0.005;       ///< metres
  int threads = 2;
};

Status benchLayout(const Subject& subject, Figures& figures);
Status benchHardCases(const Subject& subject, Figures& figures);
Status benchWarp(const Subject& subject, Figures& figures);
Status benchGlFrames(const Subject& subject, Figures& figures);
Status benchPlan(const Subject& subject, Figures& figures);
Status benchBudgets(const Subject& subject, Figures& figures);
Status benchSimplify(const Subject& subject, Figures& figures);
Status benchCoverage(const Subject& subject, Figures& figures);

}  // namespace acentric::bench
