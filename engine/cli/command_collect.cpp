#include <fmt/format.h>

#include "engine/cli/commands.h"

namespace acentric::cli {

Report collectReport(const CollectedModel& collected) {
  Report report;
  Json left = Json::array();
  for (const std::filesystem::path& file : collected.left) left.push_back(file.string());
  report.json = {{"scene", collected.scene.generic_string()},
                 {"files", collected.files},
                 {"bytes", collected.bytes},
                 {"left", std::move(left)}};
  if (collected.files > 0)
    report.text += fmt::format("  the model was brought to {}: {} file{}, {}\n", collected.scene.string(),
                               collected.files, collected.files == 1 ? "" : "s", bytesText(collected.bytes));
  else if (!collected.folder.empty())
    report.text += fmt::format("  {} links to the model\n", collected.scene.string());
  for (const std::filesystem::path& file : collected.left)
    report.text += fmt::format(
        "  left where it is, since it is hidden or lies far from the model: {}; lay a copy beside the "
        "model\n",
        file.string());
  return report;
}

Result<Report> runCollect(const CollectOptions& options, const Common& common) {
  const auto collected = collectProject(options.project, options.link ? Collect::link : Collect::files,
                                        common.host, common.progress, common.stop);
  if (!collected) return tl::unexpected(collected.error());
  Report report = collectReport(*collected);
  report.json["project"] = options.project.string();
  report.text = fmt::format("{}: {}\n{}", options.project.string(),
                            collected->folder.empty() ? "the model lies in the project's folder" : "changed",
                            report.text);
  return report;
}

}  // namespace acentric::cli
