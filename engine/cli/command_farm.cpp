#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "engine/base/file.h"
#include "engine/base/program_file.h"
#include "engine/base/stopwatch.h"
#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/cli/run_command.h"
#include "engine/pipeline/slurm_farm.h"

namespace acentric::cli {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFarmScenes = "scenes";

/// A task opens the project first; that should be a small part of it.
constexpr double kLeastOpenings = 10;

Status writeScripts(const FarmScripts& scripts, const fs::path& folder) {
  for (const auto& [name, text] :
       {std::pair{kFarmBakeScript, &scripts.bake}, std::pair{kFarmMergeScript, &scripts.merge},
        std::pair{kFarmSubmitScript, &scripts.submit}}) {
    if (Status written = writeTextAtomically(folder / name, *text); !written) return written;
    std::error_code error;
    fs::permissions(folder / name, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add,
                    error);
    if (error)
      return fail(ErrorKind::unreadable, "cannot be made executable: " + error.message(),
                  (folder / name).string());
  }
  return {};
}

struct Jobs {
  std::string array, merge;
};

Result<Jobs> submit(const fs::path& script) {
  const auto ran = runCommand({"bash", script.string()});
  if (!ran) return tl::unexpected(ran.error());
  Jobs jobs;
  std::istringstream words(ran->text);
  words >> jobs.array >> jobs.merge;
  const auto isNumber = [](const std::string& word) {
    return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (ran->exitCode == 0 && isNumber(jobs.array) && isNumber(jobs.merge)) return jobs;
  return fail(ErrorKind::internal, "Slurm did not take the jobs: " + ran->text, script.string());
}

}  // namespace

Result<Report> runFarmSlurm(const FarmSlurmOptions& options, const Common& common) {
  if (options.submit && !onPath("sbatch"))
    return fail(ErrorKind::notFound,
                "is not on PATH: install Slurm's programs (Debian: slurm-client), or leave --submit away and "
                "run the script that is written on a machine that has them",
                "sbatch");
  const Stopwatch opening;
  const auto storeys = openStoreys(options.project, common);
  if (!storeys) return tl::unexpected(storeys.error());
  const double taskSeconds = std::max(options.taskSeconds, kLeastOpenings * opening.seconds());
  std::vector<BakeShare> shares;
  for (const OpenProject& open : *storeys) shares.push_back(missingOf(open, {}));
  BakeForecastOptions exact;
  exact.brief = false;
  const auto work = forecastBake(shares, exact, *common.runner(), common.progress, common.stop);
  if (!work) return tl::unexpected(work.error());

  std::error_code error;
  FarmOptions farm;
  farm.program = ownProgram();
  if (!options.program.empty()) farm.program = options.program;
  farm.project = fs::absolute(options.project, error).lexically_normal();
  farm.storey = common.storey;
  farm.partition = options.partition;
  farm.nodes = options.nodes;
  farm.threads = common.threads;
  farm.cameraTasks = farmTasks(work->captureSeconds, work->cameras, taskSeconds);
  farm.light = work->lights > 0;

  Report report;
  report.json = {{"missingCameras", work->cameras},
                 {"cameraTasks", farm.cameraTasks},
                 {"lightTask", farm.light},
                 {"taskSeconds", farm.cameraTasks > 0 ? work->captureSeconds / farm.cameraTasks : 0},
                 {"lightSeconds", work->lightSeconds},
                 {"bytes", work->bytes()},
                 {"submitted", nullptr}};
  report.json["forecast"] = toJson(*work);
  if (work->nothing()) {
    report.text = "everything is baked: there is nothing to submit\n";
    return report;
  }
  fs::path folder = options.output;
  if (folder.empty()) folder = captureFolderFor(farm.project).replace_extension(".farm");
  folder = fs::absolute(folder, error).lexically_normal();
  farm.scenes = folder / kFarmScenes;
  if (Status sound = farm.check(); !sound) return tl::unexpected(sound.error());
  tell(*work, common);
  const Project& project = storeys->front().project;
  if (Status shared =
          shareImported(sceneFileOf(farm.project, project), project.import, common.host, farm.scenes);
      !shared)
    return tl::unexpected(shared.error());
  const FarmScripts scripts = slurmScripts(farm);
  if (Status written = writeScripts(scripts, folder); !written) return tl::unexpected(written.error());
  report.json["folder"] = folder.string();
  report.text = fmt::format(
      "{} cameras in {} tasks of about {:.0f} s{}, {} at once, then one that verifies; by this machine's "
      "pace with {} threads\n",
      work->cameras, farm.cameraTasks, report.json["taskSeconds"].get<double>(),
      farm.light ? fmt::format(" and the light on local geometry in one of {:.0f} s", work->lightSeconds)
                 : "",
      options.nodes, common.threadCount());
  if (options.print) {
    report.json["scripts"] = {{kFarmBakeScript, scripts.bake},
                              {kFarmMergeScript, scripts.merge},
                              {kFarmSubmitScript, scripts.submit}};
    report.text += fmt::format("\n--- {}\n{}\n--- {}\n{}\n--- {}\n{}\n", kFarmBakeScript, scripts.bake,
                               kFarmMergeScript, scripts.merge, kFarmSubmitScript, scripts.submit);
  }
  if (!options.submit) {
    report.text += fmt::format("submit with: {}\n", shellQuoted((folder / kFarmSubmitScript).string()));
    return report;
  }
  const auto jobs = submit(folder / kFarmSubmitScript);
  if (!jobs) return tl::unexpected(jobs.error());
  report.json["submitted"] = {{"array", jobs->array}, {"merge", jobs->merge}};
  report.text +=
      fmt::format("submitted as jobs {} and {}; they log to {}\n", jobs->array, jobs->merge, folder.string());
  return report;
}

}  // namespace acentric::cli
