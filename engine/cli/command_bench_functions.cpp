/// acentric bench functions: what acentric-bench-functions times, alone or beside another build's.

#include <fmt/format.h>

#include <map>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/base/program_file.h"
#include "engine/cli/commands.h"
#include "engine/cli/machine/figure.h"
#include "engine/cli/run_command.h"
#include "engine/pipeline/trial_folder.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kProgram = "acentric-bench-functions";

Result<Json> runProgram(const fs::path& folder, const BenchFunctionsOptions& options, const Common& common,
                        const fs::path& file) {
  std::error_code error;
  const fs::path program = folder / kProgram;
  if (!fs::exists(program, error))
    return fail(ErrorKind::notFound,
                "is not built there: `cmake --build FOLDER --target acentric-bench-functions`",
                program.string());
  std::vector<std::string> arguments = {program.string(), "--json", file.string(), "--threads",
                                        std::to_string(common.threadCount())};
  const auto give = [&](const char* option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  give("--model", options.model.string());
  give("--project", options.project.string());
  give("--at", options.at);
  give("--triangles", std::to_string(options.triangles));
  give("--regions", std::to_string(options.regions));
  arguments.insert(arguments.end(), options.names.begin(), options.names.end());
  const auto output = runCommand(arguments);
  if (!output) return tl::unexpected(output.error());
  if (output->exitCode != 0)
    return fail(ErrorKind::invalidArgument,
                output->text.empty() ? fmt::format("ended with {}", output->exitCode) : output->text,
                kProgram);
  const auto text = readText(file);
  if (!text) return tl::unexpected(text.error());
  auto json = parseJson<Json>(*text);
  if (!json || !json->is_object() || !json->contains("benches"))
    return fail(ErrorKind::malformed, "wrote no figures", program.string());
  return json;
}

/// Medians of one figure, a value of each round.
using Medians = std::map<std::pair<std::string, std::string>, std::vector<double>>;

void addMedians(const Json& report, Medians& medians) {
  for (const Json& bench : report.at("benches"))
    for (const Json& figure : bench.at("figures"))
      medians[{bench.at("bench"), figure.at("what")}].push_back(figure.at("median"));
}

/// The figures of `report`, with those of the rounds in their place.
void compare(Json& report, const Medians& own, const Medians& other, const std::string& name) {
  for (Json& bench : report.at("benches"))
    for (Json& figure : bench.at("figures")) {
      const std::pair<std::string, std::string> key(bench.at("bench"), figure.at("what"));
      figure.erase("beside"), figure.erase("ratio");
      putSpread(figure, own.at(key));
      // The other build may have no such figure.
      if (const auto found = other.find(key); found != other.end())
        putBeside(figure, own.at(key), name, found->second);
    }
}

std::string toText(const Json& report) {
  std::string text = fmt::format("{}, {} threads, commit {}\n", report.at("processor").get<std::string>(),
                                 report.at("threads").get<int>(), report.at("commit").get<std::string>());
  for (const Json& bench : report.at("benches")) {
    text += fmt::format("{}\n", bench.at("bench").get<std::string>());
    for (const auto& [what, value] : bench.at("facts").items())
      text += fmt::format("  {}: {}\n", what, jsonText(value));
    for (const Json& figure : bench.at("figures")) {
      text += fmt::format("  {:<62} {:>9.4g} {:<3} ({:.4g} to {:.4g})", figure.at("what").get<std::string>(),
                          figure.at("median").get<double>(), figure.at("unit").get<std::string>(),
                          figure.at("min").get<double>(), figure.at("max").get<double>());
      if (figure.contains("beside"))
        text += fmt::format("; {} {:.4g}, ratio {:.3g}", figure["beside"].at("name").get<std::string>(),
                            figure["beside"].at("median").get<double>(), figure.at("ratio").get<double>());
      text += "\n";
    }
  }
  return text;
}

}  // namespace

Result<Report> runBenchFunctions(const BenchFunctionsOptions& options, const Common& common) {
  std::error_code error;
  const fs::path own = ownProgram().parent_path();
  const auto folder = TrialFolder::make(fs::temp_directory_path(error));
  if (!folder) return tl::unexpected(folder.error());
  const fs::path file = folder->path() / "figures.json";

  Report report;
  Medians ours, theirs;
  const int rounds = options.beside.empty() ? 1 : options.rounds;
  for (int round = 0; round < rounds; ++round) {
    if (common.stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped");
    if (common.progress) common.progress({double(round), double(rounds), "timing functions"});
    auto one = runProgram(own, options, common, file);
    if (!one) return tl::unexpected(one.error());
    report.json = std::move(*one);
    if (options.beside.empty()) break;
    const auto other = runProgram(options.beside, options, common, file);
    if (!other) return tl::unexpected(other.error());
    addMedians(report.json, ours), addMedians(*other, theirs);
    if (round + 1 < rounds) continue;
    report.json["rounds"] = rounds;
    report.json["beside"] = {{"folder", options.beside.string()},
                             {"commit", other->value("commit", "unknown")}};
    compare(report.json, ours, theirs, other->value("commit", "unknown"));
  }
  report.text = toText(report.json);
  return report;
}

}  // namespace acentric::cli
