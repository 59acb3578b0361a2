#include "engine/export/walk_read.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/base/json_text.h"
#include "engine/export/walk_index.h"

namespace acentric {
namespace {

using Json = BundleJson;
using namespace walk_format;

constexpr std::uint64_t kMostIndexBytes = std::uint64_t(1) << 30;  // unpacked, of all pages
constexpr std::int64_t kMostListed = std::int64_t(1) << 24;        // regions, cameras

class FileRanges final : public ByteRanges {
 public:
  FileRanges(int descriptor, std::uint64_t size, std::string name)
      : descriptor_(descriptor), size_(size), name_(std::move(name)) {}
  ~FileRanges() override { ::close(descriptor_); }
  FileRanges(const FileRanges&) = delete;
  FileRanges& operator=(const FileRanges&) = delete;

  Result<std::uint64_t> size() const override { return size_; }
  Status read(std::uint64_t at, std::span<std::byte> into) const override {
    while (!into.empty()) {
      const ssize_t got = ::pread(descriptor_, into.data(), into.size(), off_t(at));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return fail(ErrorKind::unreadable, std::strerror(errno), name_);
      if (got == 0) return fail(ErrorKind::malformed, "is shorter than it says", name_);
      at += std::uint64_t(got), into = into.subspan(std::size_t(got));
    }
    return {};
  }

 private:
  int descriptor_;
  std::uint64_t size_;
  std::string name_;
};

/// The bundle's index, put together again.
class IndexReader {
 public:
  IndexReader(const WalkIndex& index, FilePlaces& places) : index_(index), places_(places) {}

  /// Throws what JSON throws where something is of another type than it should be.
  Result<Json> read() {
    auto root = index_.root();
    if (!root) return root;
    for (Json& texture : (*root)["textures"]) index_.take(texture, places_);
    for (Json& storey : (*root)["storeys"])
      if (Status read = readStorey(storey); !read) return tl::unexpected(read.error());
    return root;
  }

 private:
  static std::uint64_t number(const Json& json) { return WalkIndex::number(json); }

  Status readStorey(Json& storey) {
    const std::uint64_t cameras = number(storey["cameraCount"]), regions = number(storey["regionCount"]);
    if (cameras > kMostListed || regions > kMostListed) return index_.malformed("a storey counts too much");
    cameras_.assign(cameras, Json()), regions_.assign(regions, Json());
    if (!storey["page"].is_null())
      if (Status read = readPage(WalkIndex::entryOf(storey["page"]), 0); !read) return read;
    const auto isMissing = [](const Json& json) { return json.is_null(); };
    if (std::ranges::any_of(cameras_, isMissing) || std::ranges::any_of(regions_, isMissing))
      return index_.malformed("its pages lack cameras or regions that it counts");
    WalkIndex::putLists(storey, std::move(cameras_), std::move(regions_));
    return {};
  }

  Status readPage(const WalkPageEntry& entry, int level) {
    if (level >= kMostWalkLevels) return index_.malformed("its pages nest too deep");
    if (entry.raw <= kMostIndexBytes) unpacked_ += entry.raw;
    if (unpacked_ > kMostIndexBytes) return index_.malformed("its index is too large to be read as a whole");
    auto json = index_.page(entry);
    if (!json) return tl::unexpected(json.error());
    if (entry.leaf) return readLeaf(*json);
    for (const Json& child : json->at("pages"))
      if (Status read = readPage(WalkIndex::entryOf(child), level + 1); !read) return read;
    return {};
  }

  Status readLeaf(Json& leaf) {
    std::vector<std::uint64_t> cameras, regions;
    for (Json& camera : leaf.at("cameras")) {
      cameras.push_back(number(camera.at("number")));
      if (cameras.back() >= cameras_.size()) return index_.malformed("a page has a camera beyond its count");
      index_.take(camera["full"], places_), index_.take(camera["coarse"], places_);
      camera.erase("number");
      cameras_[cameras.back()] = std::move(camera);
    }
    for (const Json& region : leaf.at("regions")) {
      regions.push_back(number(region.at("number")));
      if (regions.back() >= regions_.size()) return index_.malformed("a page has a region beyond its count");
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
      Json& region = leaf["regions"][r];
      if (!region.at("own").get<bool>()) continue;
      index_.take(region["local"], places_);
      region.erase("number"), region.erase("own");
      bool known = true;
      const auto global = [&](Json& json, const std::vector<std::uint64_t>& numbers) {
        const std::uint64_t local = number(json);
        known = known && local < numbers.size();
        if (known) json = numbers[local];
      };
      for (Json& neighbour : region["neighbours"]) global(neighbour, regions);
      for (const char* covers : {"covers", "panoramas"})
        for (Json& cover : region[covers])
          for (Json& piece : cover["pieces"]) global(piece["camera"], cameras);
      if (!known) return index_.malformed("a page names a region or a camera that it has not");
      regions_[regions[r]] = std::move(region);
    }
    return {};
  }

  const WalkIndex& index_;
  FilePlaces& places_;
  std::uint64_t unpacked_ = 0;
  std::vector<Json> cameras_, regions_;  ///< of the storey
};

class WalkFiles final : public BundleFiles {
 public:
  WalkFiles(std::string index, RangeFiles files) : index_(std::move(index)), files_(std::move(files)) {}

  static Result<std::unique_ptr<BundleFiles>> open(std::shared_ptr<const ByteRanges> ranges,
                                                   const std::string& name) {
    return withinSense(name, [&]() -> Result<std::unique_ptr<BundleFiles>> {
      const auto pages = WalkIndex::open(*ranges, name);
      if (!pages) return tl::unexpected(pages.error());
      FilePlaces places;
      const auto index = IndexReader(*pages, places).read();
      if (!index) return tl::unexpected(index.error());
      return std::make_unique<WalkFiles>(jsonText(*index), RangeFiles(std::move(ranges), std::move(places)));
    });
  }

  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override {
    if (path != kBundleIndex) return files_.read(path, mostBytes);
    if (index_.size() > mostBytes) return fail(ErrorKind::tooLarge, "has more bytes than it may have", path);
    const auto* first = reinterpret_cast<const std::byte*>(index_.data());
    return std::vector<std::byte>(first, first + index_.size());
  }

 private:
  std::string index_;
  RangeFiles files_;
};

}  // namespace

Result<std::unique_ptr<ByteRanges>> fileRanges(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    return fail(reason == ENOENT ? ErrorKind::notFound : ErrorKind::unreadable, std::strerror(reason),
                file.string());
  }
  return std::make_unique<FileRanges>(descriptor, std::uint64_t(status.st_size), file.string());
}

Result<std::unique_ptr<BundleFiles>> walkFiles(std::unique_ptr<ByteRanges> ranges, const std::string& name) {
  return WalkFiles::open(std::move(ranges), name);
}

bool isBundle(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::filesystem::exists(path / kBundleIndex, error);
  std::array<char, kMagic.size()> start{};
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), start.size()) && start == kMagic;
}

Result<std::unique_ptr<BundleFiles>> bundleAt(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return bundleFolder(path);
  auto ranges = fileRanges(path);
  if (!ranges) return tl::unexpected(ranges.error());
  return walkFiles(std::move(*ranges), path.string());
}

}  // namespace acentric
