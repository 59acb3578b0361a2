/// acentric-bench-functions: what `acentric bench functions` runs. Writes its figures as JSON.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/cli/machine/machine.h"
#include "tests/bench_functions/benches.h"

namespace {

using namespace acentric;
using namespace acentric::bench;

struct Bench {
  const char* name;
  const char* what;
  Status (*run)(const Subject&, Figures&);
  std::filesystem::path Subject::*needs = nullptr;
};

const Bench kBenches[] = {
    {"layout", "laying out 100,000 regions, finding an eye's, exact signs", benchLayout},
    {"hard-cases", "what care with hard cases costs, beside naive variants", benchHardCases},
    {"warp", "projecting samples and drawing frames on the CPU", benchWarp},
    {"gl-frames", "frames of the OpenGL renderer, beside the CPU's", benchGlFrames},
    {"plan", "drawing a plan of many regions with OpenGL", benchPlan},
    {"budgets", "counting triangles per region (--model)", benchBudgets, &Subject::model},
    {"simplify", "simplifying what a model has around a place (--model)", benchSimplify, &Subject::model},
    {"coverage", "coverage of a project in the editor's plan (--project)", benchCoverage, &Subject::project},
};

int failed(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times functions of Acentric"};
  std::string list = "Benches:\n";
  for (const Bench& bench : kBenches) list += fmt::format("  {:<11} {}\n", bench.name, bench.what);
  app.footer(list);
  std::vector<std::string> names;
  Subject subject;
  std::vector<double> at;
  std::filesystem::path json;
  app.add_option("names", names, "Which (default: all that have what they need)");
  app.add_option("--model", subject.model, "Model file");
  app.add_option("--project", subject.project, "Project file");
  app.add_option("--at", at, "Place of the model to simplify around: x,y in metres")
      ->expected(2)
      ->delimiter(',');
  app.add_option("--triangles", subject.triangles, "To simplify to; 0: by the error alone");
  app.add_option("--error", subject.error, "That simplifying may make, metres");
  app.add_option("--regions", subject.regions, "To count triangles of")->check(CLI::Range(1, 1'000'000));
  app.add_option("--threads", subject.threads, "To use")->check(CLI::Range(1, 1024));
  app.add_option("--json", json, "File to write")->required();
  CLI11_PARSE(app, argc, argv);
  if (!at.empty()) subject.at = glm::dvec2(at[0], at[1]);

  for (const std::string& name : names)
    if (std::ranges::none_of(kBenches, [&](const Bench& bench) { return bench.name == name; }))
      return failed(fmt::format("there is no bench '{}'\n{}", name, list));
  nlohmann::ordered_json report = cli::measuredOn(subject.threads);
  report["benches"] = nlohmann::ordered_json::array();
  for (const Bench& bench : kBenches) {
    const bool ready = bench.needs == nullptr || !(subject.*bench.needs).empty();
    if (names.empty() ? !ready : std::ranges::count(names, bench.name) == 0) continue;
    if (!ready) return failed(fmt::format("{} needs one to work on: {}", bench.name, bench.what));
    Figures figures(bench.name);
    if (const Status ran = bench.run(subject, figures); !ran)
      return failed(fmt::format("{}: {}", bench.name, ran.error().describe()));
    report["benches"].push_back(figures.json());
  }
  const Status written = writeTextAtomically(json, jsonText(report, 2) + "\n");
  return written ? 0 : failed(written.error().describe());
}
