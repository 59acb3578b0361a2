#include <fmt/format.h>

#include "engine/cli/commands.h"

namespace acentric::cli {

Result<Report> runValidate(const ValidateOptions& options, const Common& common) {
  const auto open = openProject(options.project, common.host, common.progress, common.stop);
  if (!open) return tl::unexpected(open.error());
  std::vector<std::string> problems;
  std::size_t checked = 0, missing = 0;
  std::error_code error;
  const auto folder = captureFolderFor(open->file);
  if (std::filesystem::is_directory(folder, error)) {
    const auto store = CaptureStore::open(folder);
    if (!store) return tl::unexpected(store.error());
    for (std::size_t i = 0; i < open->keys.size(); ++i) {
      if (common.progress) common.progress({double(i), double(open->keys.size()), "checking captures"});
      if (!store->has(open->keys[i])) {
        ++missing;
        continue;
      }
      ++checked;
      // Both files of the pair: a reader may take either.
      for (const auto& result : {readCapturePack(folder / (open->keys[i].toHex() + ".pack")),
                                 readCaptureExr(folder / (open->keys[i].toHex() + ".exr"))})
        if (!result) problems.push_back(result.error().describe());
    }
    if (store->hasSurfaceLight(open->surfaceLightKey))
      if (const auto light = store->getSurfaceLight(open->surfaceLightKey); !light)
        problems.push_back(light.error().describe());
  } else {
    missing = open->keys.size();
  }
  Report report;
  report.success = problems.empty();
  report.json = {{"project", options.project.string()},
                 {"valid", problems.empty()},
                 {"problems", problems},
                 {"capturesSound", checked},
                 {"capturesMissing", missing}};
  report.text = fmt::format("{}: project, scene and layout are sound; {} captures checked, {} not baked\n",
                            options.project.string(), checked, missing);
  for (const std::string& problem : problems) report.text += "  problem: " + problem + "\n";
  return report;
}

}  // namespace acentric::cli
