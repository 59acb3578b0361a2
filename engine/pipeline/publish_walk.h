#pragma once
/// A project as a folder that any web server can serve: what is baked, as a bundle or as one walk's file,
/// with the page that walks through it.

#include "engine/export/web_page.h"
#include "engine/pipeline/export_bundle.h"

namespace acentric {

struct PublishOptions {
  std::filesystem::path page;  ///< folder of the built page (findWebPage)
  bool oneFile = false;        ///< a walk's file, read by ranges, in place of a bundle's many
  int regionsPerPage = 64;     ///< of that file's index
  /// With `former` empty what is published there, if anything, is taken where it is the same.
  ExportBundleOptions bundle;
};

struct PublishReport {
  BundleReport bundle;
  std::filesystem::path walk;  ///< the walk's file; empty unless `oneFile`
  std::uint64_t bytes = 0;     ///< of all files in the folder
  std::size_t files = 0;
};

/// `folder` is made, or replaced as a whole once all is written, if it is empty or holds nothing but what was
/// published before. On failure, or when stopped, it stays as it was and nothing is left beside it.
Result<PublishReport> publishWalk(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const PublishOptions& options, TaskRunner& runner,
                                  const Progress& progress = {}, std::stop_token stop = {});

/// May publishWalk put a walk there? Names what would be lost else.
Status checkPublishTarget(const std::filesystem::path& folder);

/// Of a page for a bundle's folder or a walk; with `poster` its picture, of where the walk begins, is put
/// there, a folder. Where nothing is baked at the start there is none.
Result<PageTitle> pageTitle(const std::filesystem::path& bundle, const std::filesystem::path& poster,
                            int threads);

}  // namespace acentric
