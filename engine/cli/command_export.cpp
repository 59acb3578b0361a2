#include <fmt/format.h>

#include <optional>

#include "engine/base/file.h"
#include "engine/cli/bundle_picture.h"
#include "engine/cli/commands.h"
#include "engine/export/walk_write.h"
#include "engine/export/web_page.h"
#include "engine/pipeline/export_bundle.h"

namespace acentric::cli {
namespace {

namespace fs = std::filesystem;

Result<BundleReport> writeBundleOf(const ExportOptions& options, const fs::path& folder,
                                   const Common& common) {
  // Before a model is imported for nothing.
  if (Status free = checkBundleTarget(folder); !free) return tl::unexpected(free.error());
  const auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());
  const auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  const auto runner = common.runner();
  ExportBundleOptions bundle;
  bundle.allowMissing = options.allowMissing;
  bundle.colourQuality = options.colourQuality;
  bundle.generator = "Acentric " ACENTRIC_VERSION;
  auto done = exportBundle(*storeys, folder, bundle, *runner, common.progress, common.stop);
  if (!done) return done;
  if (Status there = mustExist(folder / kBundleIndex); !there) return tl::unexpected(there.error());
  return done;
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

/// As large as those want it who show addresses.
constexpr int kPosterWidth = 1200, kPosterHeight = 630;

/// Of a page for the bundle in a folder; its poster, of a page that is not alone, is put there: what the walk
/// begins with.
Result<PageTitle> titleOf(const fs::path& folder, bool alone, const Common& common) {
  const auto player = playerFor(folder, common.runner()->threads());
  if (!player) return tl::unexpected(player.error());
  const Bundle& bundle = (*player)->bundle();
  PageTitle title{bundle.name, {}};
  if (alone) return title;
  PerspectiveView view = startOf(bundle);
  view.width = kPosterWidth, view.height = kPosterHeight;
  ViewSettings settings = bundle.view;
  settings.renderer = withoutOpenGl(settings.renderer);
  const auto frame = bundleFrame(**player, view, settings);
  if (!frame) return title;  // nothing is baked there yet: a page without a poster
  title.poster = "poster.jpg";
  if (Status written = writeColourImage(frame->colour, folder / title.poster); !written)
    return tl::unexpected(written.error());
  return title;
}

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
    std::error_code error;
    auto found = findWebPage(fs::read_symlink("/proc/self/exe", error));
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
  const auto done = writeBundleOf(options, folder, common);
  if (!done) return tl::unexpected(done.error());
  std::uint64_t pageBytes = 0;
  PageTitle title;
  if (web) {
    auto made = titleOf(folder, options.singleFile, common);
    if (!made) return tl::unexpected(made.error());
    title = std::move(*made);
  }
  std::uint64_t walkBytes = 0;
  if (walk) {
    const auto written = writeWalk(folder, options.output, {options.regionsPerPage}, common.stop);
    if (!written) return tl::unexpected(written.error());
    walkBytes = *written;
  } else if (temporary) {
    const auto written = writeSingleFile(page, folder, options.output, title);
    if (!written) return tl::unexpected(written.error());
    pageBytes = *written;
  } else if (web) {
    if (Status added = addWebPage(page, folder, title); !added) return tl::unexpected(added.error());
  }

  Report report;
  report.json = {{"folder", options.output.string()},
                 {"cameras", done->cameras},
                 {"missing", done->missing},
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
    report.text += "  any web server can serve it, such as `node web/serve.mjs` (docs/web.md)\n";
  if (done->missing > 0)
    report.text += fmt::format("warning: {} of {} captures are missing; `acentric bake {}` makes them\n",
                               done->missing, done->cameras, options.project.string());
  return report;
}

}  // namespace acentric::cli
