#include "engine/pipeline/publish_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/base/folder.h"
#include "engine/export/bundle_frame.h"
#include "engine/export/walk_write.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// As large as those want it who show addresses.
constexpr int kPosterWidth = 1200, kPosterHeight = 630;
constexpr const char* kPoster = "poster.jpg";
constexpr const char* kWalkEnding = ".acentric";
constexpr std::array kBundleParts = {kBundleIndex, "captures", "coarse", "regions", "textures", kPoster};

bool isOurs(const fs::path& entry) {
  const std::string name = entry.filename().string();
  return std::ranges::find(kBundleParts, name) != kBundleParts.end() ||
         std::ranges::find(kPageFiles, name) != kPageFiles.end() || entry.extension() == kWalkEnding;
}

Status sumUp(const fs::path& folder, PublishReport& report) {
  std::error_code error;
  fs::recursive_directory_iterator entries(folder, error);
  for (const fs::recursive_directory_iterator end; !error && entries != end; entries.increment(error)) {
    if (!entries->is_regular_file(error)) continue;
    report.bytes += entries->file_size(error);
    ++report.files;
  }
  if (error) return fail(ErrorKind::unreadable, error.message(), folder.string());
  return {};
}

}  // namespace

Status checkPublishTarget(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (!fs::is_directory(folder, error))
    return fail(ErrorKind::invalidArgument, "is no folder: name a new one for the published walk",
                folder.string());
  fs::directory_iterator entries(folder, error);
  if (error) return fail(ErrorKind::unreadable, error.message(), folder.string());
  for (const fs::directory_iterator end; !error && entries != end; entries.increment(error))
    if (!isOurs(entries->path()))
      return fail(
          ErrorKind::invalidArgument,
          fmt::format("holds {}, which is no part of a published walk and would be lost: name a new folder",
                      entries->path().filename().string()),
          folder.string());
  return {};
}

Result<PageTitle> pageTitle(const fs::path& bundle, const fs::path& poster, int threads) {
  const auto player = playerFor(bundle, threads);
  if (!player) return tl::unexpected(player.error());
  const Bundle& opened = (*player)->bundle();
  PageTitle title{opened.name, {}};
  if (poster.empty()) return title;
  PerspectiveView view = startOf(opened);
  view.width = kPosterWidth, view.height = kPosterHeight;
  ViewSettings settings = opened.view;
  settings.renderer = withoutOpenGl(settings.renderer);
  const auto frame = bundleFrame(**player, view, settings);
  if (!frame) return title;
  title.poster = kPoster;
  if (Status written = writeColourImage(frame->colour, poster / title.poster); !written)
    return tl::unexpected(written.error());
  return title;
}

Result<PublishReport> publishWalk(std::span<const OpenProject> storeys, const fs::path& folder,
                                  const PublishOptions& options, TaskRunner& runner, const Progress& progress,
                                  std::stop_token stop) {
  if (Status free = checkPublishTarget(folder); !free) return tl::unexpected(free.error());
  ExportBundleOptions exporting = options.bundle;
  if (exporting.former.empty()) exporting.former = folder;
  return writeFolderAtomically(folder, [&](const fs::path& site) -> Result<PublishReport> {
    PublishReport report;
    // Of one file the bundle is gone with it.
    const fs::path bundle = options.oneFile ? site / "bundle" : site;
    auto written = exportBundle(storeys, bundle, exporting, runner, progress, stop);
    if (!written) return tl::unexpected(written.error());
    report.bundle = *written;
    if (progress) progress({0, 0, "writing the page"});
    auto title = pageTitle(bundle, site, runner.threads());
    if (!title) return tl::unexpected(title.error());
    if (options.oneFile) {
      title->walk = title->name + kWalkEnding;
      report.walk = folder / title->walk;
      if (auto walk = writeWalk(bundle, site / title->walk, {options.regionsPerPage}, stop); !walk)
        return tl::unexpected(walk.error());
      std::error_code error;
      fs::remove_all(bundle, error);
      if (error) return fail(ErrorKind::unreadable, error.message(), bundle.string());
    }
    if (Status added = addWebPage(options.page, site, *title); !added) return tl::unexpected(added.error());
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "publishing was stopped", folder.string());
    if (Status summed = sumUp(site, report); !summed) return tl::unexpected(summed.error());
    return report;
  });
}

}  // namespace acentric
