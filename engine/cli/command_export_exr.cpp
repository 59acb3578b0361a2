#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/export_exr.h"

namespace acentric::cli {

Result<Report> runExportExr(const ExportOptions& options, const Common& common) {
  // Before a model is imported for nothing.
  if (Status free = checkExrTarget(options.output); !free) return tl::unexpected(free.error());
  const auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());
  const auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  ExportExrOptions exr;
  exr.allowMissing = options.allowMissing;
  exr.generator = "Acentric " ACENTRIC_VERSION;
  const auto runner = common.runner();
  const auto done = exportExr(*storeys, options.output, exr, *runner, common.progress, common.stop);
  if (!done) return tl::unexpected(done.error());
  Report report;
  report.json = {{"folder", options.output.string()},
                 {"files", done->files},
                 {"missing", done->missing},
                 {"samples", done->samples},
                 {"bytes", done->bytes}};
  report.text = fmt::format("{}: {} OpenEXR files, {} samples, {}\n", options.output.string(),
                            countText(done->files), countText(done->samples), bytesText(done->bytes));
  if (done->missing > 0)
    report.text += fmt::format("warning: {} of {} captures are missing; `acentric bake {}` makes them\n",
                               done->missing, done->missing + done->files, options.project.string());
  return report;
}

}  // namespace acentric::cli
