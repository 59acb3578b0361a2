#pragma once
/// Files as wholes. Writing goes to a temporary file beside the target, is flushed to disk, and renamed:
/// a reader sees the old file or the new one, never a part.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

Result<std::vector<std::byte>> readFile(const std::filesystem::path& path,
                                        std::size_t maxBytes = std::size_t(8) << 30);
Result<std::string> readText(const std::filesystem::path& path, std::size_t maxBytes = std::size_t(256)
                                                                                       << 20);

/// `parts` one behind the other. A stop gives `cancelled` within a few megabytes, and leaves what was there.
Status writeFileAtomically(const std::filesystem::path& path,
                           std::span<const std::span<const std::byte>> parts,
                           const std::stop_token& stop = {});
Status writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes,
                           const std::stop_token& stop = {});
Status writeTextAtomically(const std::filesystem::path& path, std::string_view text);

/// For libraries that write files themselves: `write(temporary)` makes the file; then it is flushed to disk
/// and renamed to `path`. On failure the temporary is removed. The temporary keeps `path`'s extension and
/// its name begins with `kTemporaryPrefix`.
Status replaceFileAtomically(const std::filesystem::path& path,
                             const std::function<Status(const std::filesystem::path& temporary)>& write);

inline constexpr std::string_view kTemporaryPrefix = ".acentric-tmp-";

/// How the names of this process' temporaries begin: kTemporaryPrefix, the machine, the process. Folders may
/// be shared between machines, whose process numbers mean nothing to each other.
std::string temporaryNameStart();

/// Removes temporaries, files and folders, that a killed process left in `folder`: those of this machine
/// whose writing process is gone, and all that nobody has written to for a day. Returns how many were
/// removed.
int removeStaleTemporaries(const std::filesystem::path& folder);

/// Can files be made in a folder that is there? Tries, and leaves nothing.
Status checkWritable(const std::filesystem::path& folder);

/// Bytes that may be written where `path` is or would be made.
Result<std::uint64_t> freeSpace(const std::filesystem::path& path);

/// $XDG_CACHE_HOME/acentric, else ~/.cache/acentric, else a folder under the system's temporary one.
std::filesystem::path userCacheFolder();

}  // namespace acentric
