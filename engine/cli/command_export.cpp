#include <fmt/format.h>

#include <optional>

#include "engine/base/file.h"
#include "engine/base/program_file.h"
#include "engine/cli/commands.h"
#include "engine/export/walk_write.h"
#include "engine/pipeline/publish_walk.h"

namespace acentric::cli {
namespace {

namespace fs = std::filesystem;

/// All storeys of a project, and the one where its walk begins.
struct ToExport {
  std::vector<OpenProject> storeys;
  ExportBundleOptions bundle;
};

Result<ToExport> openToExport(const ExportOptions& options, const Common& common) {
  const auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());
  auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  ExportBundleOptions bundle{options.allowMissing, "Acentric " ACENTRIC_VERSION, options.colourQuality};
  bundle.storey = current->project.storey;
  return ToExport{std::move(*storeys), std::move(bundle)};
}

Result<BundleReport> writeBundleOf(const ExportOptions& options, const fs::path& folder,
                                   const Common& common) {
  // Before a model is imported for nothing.
  if (Status free = checkBundleTarget(folder); !free) return tl::unexpected(free.error());
  const auto open = openToExport(options, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  auto done = exportBundle(open->storeys, folder, open->bundle, *runner, common.progress, common.stop);
  if (!done) return done;
  if (Status there = mustExist(folder / kBundleIndex); !there) return tl::unexpected(there.error());
  return done;
}

Result<BundleReport> publishTo(const ExportOptions& options, const fs::path& page, const Common& common) {
  if (Status free = checkPublishTarget(options.output); !free) return tl::unexpected(free.error());
  const auto open = openToExport(options, common);
  if (!open) return tl::unexpected(open.error());
  PublishOptions publishing;
  publishing.page = page;
  publishing.bundle = open->bundle;
  const auto runner = common.runner();
  const auto done =
      publishWalk(open->storeys, options.output, publishing, *runner, common.progress, common.stop);
  if (!done) return tl::unexpected(done.error());
  if (Status there = mustExist(options.output / "index.html"); !there) return tl::unexpected(there.error());
  return done->bundle;
}

/// A bundle for a single file, beside it while that is made.
class TemporaryBundle {
 public:
  explicit TemporaryBundle(const fs::path& file)
      : folder(file.parent_path() / (temporaryNameStart() + file.filename().string() + ".bundle")) {}
  ~TemporaryBundle() {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  TemporaryBundle(const TemporaryBundle&) = delete;
  TemporaryBundle& operator=(const TemporaryBundle&) = delete;
  const fs::path folder;
};

/// What the page is, and whether it is handy.
void addSingleFile(const fs::path& file, std::uint64_t size, Report& report) {
  report.json["page"] = {{"file", file.string()}, {"bytes", size}};
  report.text += fmt::format("  as one file: {}, {}\n", file.string(), bytesText(size));
  if (size <= kHandySingleFile) return;
  const std::string warning = fmt::format(
      "the page is larger than {} MB: it opens slowly, and on phones perhaps not at all; leave --single-file "
      "away for a "
      "folder that a web server sends piece by piece",
      kHandySingleFile >> 20);
  report.json["warnings"].push_back(warning);
  report.text += "warning: " + warning + "\n";
}

}  // namespace

Result<Report> runExport(const ExportOptions& options, const Common& common) {
  if (options.to == "gltf" || options.to == "3dtiles") return runExportGltf(options, common);
  if (options.to == "exr") return runExportExr(options, common);
  const bool web = options.to == "web", walk = options.to == "walk";
  if (options.to != "bundle" && !web && !walk) return runExportImages(options, common);
  if (options.singleFile && !web)
    return fail(ErrorKind::invalidArgument, "--single-file is a page: say --to web");
  fs::path page;
  if (web) {
    auto found = findWebPage(ownProgram());
    if (!found) return tl::unexpected(found.error());
    page = std::move(*found);
  }
  std::error_code error;
  if ((options.singleFile || walk) && fs::is_directory(options.output, error))
    return fail(ErrorKind::invalidArgument,
                walk ? "is a folder: name a file, such as walk.acentric" : "is a folder: name an HTML file",
                options.output.string());
  std::optional<TemporaryBundle> temporary;
  if (options.singleFile || walk) temporary.emplace(fs::absolute(options.output));
  const fs::path folder = temporary ? temporary->folder : options.output;
  const auto done =
      web && !temporary ? publishTo(options, page, common) : writeBundleOf(options, folder, common);
  if (!done) return tl::unexpected(done.error());
  std::uint64_t pageBytes = 0, walkBytes = 0;
  if (walk) {
    const auto written = writeWalk(folder, options.output, {options.regionsPerPage}, common.stop);
    if (!written) return tl::unexpected(written.error());
    walkBytes = *written;
  } else if (temporary) {
    const auto title = pageTitle(folder, {}, common.runner()->threads());
    if (!title) return tl::unexpected(title.error());
    const auto written = writeSingleFile(page, folder, options.output, *title);
    if (!written) return tl::unexpected(written.error());
    pageBytes = *written;
  }

  Report report;
  report.json = {{"folder", options.output.string()},
                 {"cameras", done->cameras},
                 {"missing", done->missing},
                 {"reused", done->reused},
                 {"regions", done->regions},
                 {"textures", done->textures},
                 {"samples", done->samples},
                 {"triangles", done->triangles},
                 {"bytes",
                  {{"all", done->bytes()},
                   {"captures", done->fullBytes},
                   {"coarse", done->coarseBytes},
                   {"local", done->localBytes},
                   {"textures", done->textureBytes},
                   {"index", done->indexBytes}}},
                 {"warnings", Json::array()}};
  report.text = fmt::format(
      "{}: {}\n  {} captures, {} samples, {}; coarse {}\n  {} regions, {} local triangles, {}; {} textures, "
      "{}\n",
      options.output.string(), bytesText(done->bytes()), countText(done->cameras - done->missing),
      countText(done->samples), bytesText(done->fullBytes), bytesText(done->coarseBytes),
      countText(done->regions), countText(done->triangles), bytesText(done->localBytes),
      countText(done->textures), bytesText(done->textureBytes));
  if (walk) {
    report.json["walk"] = {{"file", options.output.string()}, {"bytes", walkBytes}};
    report.text += fmt::format("  as one file: {}\n", bytesText(walkBytes));
  } else if (temporary) {
    addSingleFile(options.output, pageBytes, report);
  }
  if (web && !temporary)
    report.text += fmt::format(
        "  any web server can serve it; `acentric serve {}` does so on this machine (docs/web.md)\n",
        options.output.string());
  if (done->missing > 0)
    report.text += fmt::format("warning: {} of {} captures are missing; `acentric bake {}` makes them\n",
                               done->missing, done->cameras, options.project.string());
  return report;
}

}  // namespace acentric::cli
