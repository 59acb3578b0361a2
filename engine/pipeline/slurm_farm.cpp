#include "engine/pipeline/slurm_farm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

/// What the array's job and the job after it say alike.
std::string head(const FarmOptions& options, const char* purpose, const char* name) {
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# {}\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --nodes=1\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n",
      purpose, name);
  text += options.threads > 0 ? fmt::format("#SBATCH --cpus-per-task={}\n", options.threads)
                              : std::string("#SBATCH --exclusive\n");
  if (!options.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", options.partition);
  return text;
}

std::string command(const FarmOptions& options) {
  std::string text = fmt::format("{} bake {} --import-cache {} --threads \"${{SLURM_CPUS_ON_NODE:-1}}\"",
                                 shellQuoted(options.program.string()), shellQuoted(options.project.string()),
                                 shellQuoted(options.scenes.string()));
  // A task that is started again may be locked out by itself, on a node that is lost.
  text += " --take-over";
  if (!options.storey.empty()) text += " --storey " + shellQuoted(options.storey);
  return text;
}

/// Runs `arguments` of the shell until they end well or fail for a reason of their own. Ended by a signal
/// (out of memory, an administrator) they are worth another attempt: what is finished is kept.
std::string attempts(const std::string& arguments) {
  return fmt::format(
      "status=1\n"
      "for attempt in 1 2 3; do\n"
      "  {} && exit 0\n"
      "  status=$?\n"
      "  ((status > 128)) || exit \"$status\"\n"
      "  echo \"attempt $attempt was ended by signal $((status - 128))\" >&2\n"
      "done\n"
      "exit \"$status\"\n",
      arguments);
}

}  // namespace

Status FarmOptions::check() const {
  const auto bad = [](std::string message, std::string where) {
    return fail(ErrorKind::invalidArgument, std::move(message), std::move(where));
  };
  if (nodes < 1) return bad("at least one node is needed", "--nodes");
  if (threads < 0) return bad("must not be negative", "--threads");
  if (cameraTasks < 0 || cameraTasks > kMostFarmTasks || (cameraTasks == 0 && !light))
    return bad(fmt::format("an array has 1 to {} tasks", kMostFarmTasks), "tasks");
  const bool plain = std::ranges::all_of(partition, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == ',';
  });
  if (!plain) return bad("names of partitions have letters, digits and _ - . only", "--partition");
  if (!program.is_absolute() || !project.is_absolute() || !scenes.is_absolute())
    return bad("the nodes need the absolute paths of the program, the project and its scene",
               project.string());
  return {};
}

int farmTasks(double seconds, int cameras, double leastSeconds) {
  const double tasks = std::floor(seconds / leastSeconds);
  return std::clamp(tasks < kMostFarmTasks ? int(tasks) : kMostFarmTasks, std::min(1, cameras), cameras);
}

FarmScripts slurmScripts(const FarmOptions& options) {
  FarmScripts scripts;
  const int first = options.light ? 0 : 1;
  scripts.bake =
      head(options, "One task of a bake: a share of the cameras, or (task 0) the light on local geometry.",
           "acentric-bake") +
      fmt::format("#SBATCH --array={}-{}%{}\n\n", first, options.cameraTasks, options.nodes) +
      "if ((SLURM_ARRAY_TASK_ID == 0)); then\n"
      "  share=(--light only)\n"
      "else\n" +
      fmt::format("  share=(--light without --shard \"$SLURM_ARRAY_TASK_ID/{}\")\n", options.cameraTasks) +
      "fi\n" + attempts(command(options) + " \"${share[@]}\"");
  scripts.merge =
      head(options, "When all tasks are done: reads every capture, bakes again what is missing or damaged.",
           "acentric-merge") +
      "\n" + attempts(command(options) + " --verify");
  scripts.submit = fmt::format(
      "#!/bin/bash\n"
      "# Submits the bake and the step after it; prints their numbers.\n"
      "set -euo pipefail\n"
      "cd -- \"$(dirname -- \"${{BASH_SOURCE[0]}}\")\"\n"
      "array=$(sbatch --parsable --output=bake-%a.log ./{})\n"
      "merge=$(sbatch --parsable --output=merge.log --dependency=\"afterok:${{array%%;*}}\""
      " --kill-on-invalid-dep=yes ./{})\n"
      "echo \"${{array%%;*}} ${{merge%%;*}}\"\n",
      kFarmBakeScript, kFarmMergeScript);
  return scripts;
}

std::string shellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace acentric
