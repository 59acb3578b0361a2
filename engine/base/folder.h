#pragma once
/// Folders as wholes: one is written beside its place and put there at once.

#include <filesystem>
#include <functional>

#include "engine/base/result.h"

namespace acentric {

/// `write(temporary)` fills a new folder beside `path`; then it is flushed to disk and takes the place of
/// `path`, which may exist. On failure the temporary is removed, and `path` stays as it was. What killed
/// processes left beside it is removed.
Status replaceFolderAtomically(const std::filesystem::path& path,
                               const std::function<Status(const std::filesystem::path& temporary)>& write);

/// The same of a `write` that reports on what it wrote: a Result<Report>.
template <class Write>
auto writeFolderAtomically(const std::filesystem::path& path, const Write& write) -> decltype(write(path)) {
  decltype(write(path)) report;
  const Status written = replaceFolderAtomically(path, [&](const std::filesystem::path& temporary) -> Status {
    report = write(temporary);
    if (!report) return tl::unexpected(report.error());
    return {};
  });
  if (!written) return tl::unexpected(written.error());
  return report;
}

}  // namespace acentric
