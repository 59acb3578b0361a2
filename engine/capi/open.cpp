#include <cstring>
#include <limits>

#include "engine/capi/handle.h"
#include "engine/export/walk_pages.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

/// Files that the caller reads.
class CallerFiles final : public BundleFiles {
 public:
  explicit CallerFiles(const acentric_files& files) : files_(files) {}

  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override {
    uint64_t size = 0;
    if (const acentric_status code = files_.size(files_.user, path.c_str(), &size); code != ACENTRIC_OK)
      return failedWith(code, path);
    if (size > mostBytes) return fail(ErrorKind::tooLarge, "has more bytes than it may have", path);
    std::vector<std::byte> bytes(size);
    if (const acentric_status code = files_.read(files_.user, path.c_str(), bytes.data(), size);
        code != ACENTRIC_OK)
      return failedWith(code, path);
    return bytes;
  }

 private:
  static tl::unexpected<Error> failedWith(acentric_status code, const std::string& path) {
    if (code == ACENTRIC_ERROR_NOT_FOUND) return fail(ErrorKind::notFound, "is not there", path);
    return fail(ErrorKind::unreadable,
                std::string("the caller could not read it: ") + acentric_status_name(code), path);
  }
  acentric_files files_;
};

/// A walk that the caller reads.
class CallerRanges final : public ByteRanges {
 public:
  explicit CallerRanges(const acentric_ranges& ranges) : ranges_(ranges) {}

  Result<std::uint64_t> size() const override {
    uint64_t bytes = 0;
    if (const acentric_status code = ranges_.size(ranges_.user, &bytes); code != ACENTRIC_OK)
      return failedWith(code);
    return bytes;
  }
  Status read(std::uint64_t at, std::span<std::byte> into) const override {
    const acentric_status code = ranges_.read(ranges_.user, at, into.data(), into.size());
    return code == ACENTRIC_OK ? Status() : Status(failedWith(code));
  }

 private:
  static tl::unexpected<Error> failedWith(acentric_status code) {
    return fail(code == ACENTRIC_ERROR_NOT_FOUND ? ErrorKind::notFound : ErrorKind::unreadable,
                std::string("the caller could not read it: ") + acentric_status_name(code), "walk");
  }
  acentric_ranges ranges_;
};

using Opened = Result<std::unique_ptr<BundlePlaces>>;

/// `read` gives an index, null where an argument is.
template <class Read>
acentric_status openWith(acentric_bundle** out, const Read& read) noexcept {
  if (out == nullptr) return ACENTRIC_ERROR_ARGUMENT;
  *out = new (std::nothrow) acentric_bundle;
  if (*out == nullptr) return ACENTRIC_ERROR_MEMORY;
  acentric_bundle& bundle = **out;
  try {
    Opened places = read();
    if (!places) return failed(bundle, places.error());
    if (*places == nullptr)
      return failed(bundle, ACENTRIC_ERROR_ARGUMENT, "no path, or no functions that read files");
    bundle.runtime.open(std::move(*places));
    for (const BundlePath& path : bundle.runtime.bundle().paths) {
      bundle.poses.emplace_back();
      for (const BundlePose& p : path.poses)
        bundle.poses.back().push_back({{p.eye.x, p.eye.y, p.eye.z}, p.yaw, p.pitch, p.seconds});
    }
    bundle.open = true;
    return ACENTRIC_OK;
  } catch (const std::bad_alloc&) {
    return ACENTRIC_ERROR_MEMORY;
  } catch (...) {
    return ACENTRIC_ERROR_INTERNAL;
  }
}

}  // namespace

namespace acentric::capi {

acentric_status codeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::notFound:
      return ACENTRIC_ERROR_NOT_FOUND;
    case ErrorKind::unreadable:
    case ErrorKind::timeout:
      return ACENTRIC_ERROR_UNREADABLE;
    case ErrorKind::malformed:
    case ErrorKind::tooLarge:
      return ACENTRIC_ERROR_MALFORMED;
    case ErrorKind::unsupported:
      return ACENTRIC_ERROR_UNSUPPORTED;
    case ErrorKind::outOfSpace:
      return ACENTRIC_ERROR_MEMORY;
    case ErrorKind::invalidArgument:
      return ACENTRIC_ERROR_ARGUMENT;
    case ErrorKind::cancelled:
    case ErrorKind::internal:
      break;
  }
  return ACENTRIC_ERROR_INTERNAL;
}

}  // namespace acentric::capi

uint32_t acentric_runtime_version(void) { return ACENTRIC_RUNTIME_VERSION; }

const char* acentric_status_name(acentric_status status) {
  switch (status) {
    case ACENTRIC_OK:
      return "ok";
    case ACENTRIC_ERROR_ARGUMENT:
      return "argument out of range";
    case ACENTRIC_ERROR_NOT_FOUND:
      return "not found";
    case ACENTRIC_ERROR_UNREADABLE:
      return "unreadable";
    case ACENTRIC_ERROR_MALFORMED:
      return "malformed";
    case ACENTRIC_ERROR_UNSUPPORTED:
      return "unsupported";
    case ACENTRIC_ERROR_MEMORY:
      return "not enough memory";
    case ACENTRIC_ERROR_OUTSIDE:
      return "outside every region";
    case ACENTRIC_ERROR_NOT_LOADED:
      return "not loaded";
    case ACENTRIC_ERROR_INTERNAL:
      return "internal error";
    default:
      return "unknown";
  }
}

acentric_status acentric_open_folder(const char* folder, acentric_bundle** bundle) {
  return openWith(bundle, [&]() -> Opened {
    if (folder == nullptr) return nullptr;
    return wholeBundle(bundleFolder(folder));
  });
}

acentric_status acentric_open_files(const acentric_files* files, acentric_bundle** bundle) {
  return openWith(bundle, [&]() -> Opened {
    if (files == nullptr || files->size == nullptr || files->read == nullptr) return nullptr;
    return wholeBundle(std::make_unique<CallerFiles>(*files));
  });
}

acentric_status acentric_open_walk(const char* file, acentric_bundle** bundle) {
  return openWith(bundle, [&]() -> Opened {
    if (file == nullptr) return nullptr;
    auto ranges = fileRanges(file);
    if (!ranges) return tl::unexpected(ranges.error());
    return WalkPages::open(std::move(*ranges), file);
  });
}

acentric_status acentric_open_ranges(const acentric_ranges* ranges, acentric_bundle** bundle) {
  return openWith(bundle, [&]() -> Opened {
    if (ranges == nullptr || ranges->size == nullptr || ranges->read == nullptr) return nullptr;
    return WalkPages::open(std::make_unique<CallerRanges>(*ranges), "walk");
  });
}

void acentric_close(acentric_bundle* bundle) { delete bundle; }

const char* acentric_message(const acentric_bundle* bundle) {
  return bundle != nullptr ? bundle->message.c_str() : "";
}

acentric_status acentric_set_threads(acentric_bundle* bundle, int32_t threads) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    constexpr int32_t kMost = 1024;
    if (threads < 1 || threads > kMost) return refused(bundle, "threads: 1 to 1024");
    runtime.setThreads(threads);
    return acentric_status(ACENTRIC_OK);
  });
}
