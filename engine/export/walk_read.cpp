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
#include <map>

#include "engine/base/json_text.h"
#include "engine/export/bundle_json.h"
#include "engine/export/walk_format.h"

namespace acentric {
namespace {

using Json = BundleJson;
using namespace walk_format;

constexpr int kMostLevels = 8;                                     // of pages
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
  IndexReader(const ByteRanges& ranges, const std::string& name) : ranges_(ranges), name_(name) {}

  /// Throws what JSON throws where something is of another type than it should be.
  Result<Json> read() {
    const auto size = ranges_.size();
    if (!size) return tl::unexpected(size.error());
    std::vector<std::byte> bytes(std::min<std::uint64_t>(*size, kHeaderBytes));
    if (Status got = ranges_.read(0, bytes); !got) return tl::unexpected(got.error());
    auto header = headerOf(bytes, name_);
    if (!header) return tl::unexpected(header.error());
    header_ = *header;
    if (header_.fileBytes != *size)
      return fail(ErrorKind::malformed,
                  fmt::format("has {} bytes and says {}: it is cut off, or not copied whole", *size,
                              header_.fileBytes),
                  name_);
    const ContentKey hash{header_.rootHash[0], header_.rootHash[1]};
    auto root = page(kHeaderBytes, header_.rootBytes, header_.rootRaw, hash.toHex(), "the root of its index",
                     kMostRootBytes);
    if (!root) return root;
    if (!root->is_object()) return malformed("its index is no object");
    for (Json& texture : (*root)["textures"]) take(texture);
    for (Json& storey : (*root)["storeys"])
      if (Status read = readStorey(storey); !read) return tl::unexpected(read.error());
    return root;
  }

  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>>
      places;  ///< from the file's beginning; bytes

 private:
  tl::unexpected<Error> malformed(std::string message) const {
    return fail(ErrorKind::malformed, std::move(message), name_);
  }

  Result<Json> page(std::uint64_t at, std::uint64_t bytes, std::uint64_t raw, const std::string& hash,
                    const std::string& what, std::uint64_t mostRaw) {
    unpacked_ += raw;
    if (raw > mostRaw || unpacked_ > kMostIndexBytes || bytes > raw + 1024)
      return malformed(what + " is too large");
    if (at > header_.dataStart || bytes > header_.dataStart - at)
      return malformed(what + " lies outside the index");
    std::vector<std::byte> packed(bytes);
    if (Status got = ranges_.read(at, packed); !got) return tl::unexpected(got.error());
    const auto text = checkedText(packed, raw, hash, name_ + ", " + what);
    if (!text) return tl::unexpected(text.error());
    return parseJson<Json>(*text, name_ + ", " + what);
  }

  static std::uint64_t number(const Json& json) {
    return json.is_number_unsigned() ? json.get<std::uint64_t>() : ~std::uint64_t(0);
  }

  /// Where a file lies; the index of a bundle does not say.
  void take(Json& file) {
    if (!file.is_object()) return;
    const std::uint64_t at = number(file["at"]), bytes = number(file["bytes"]);
    file.erase("at");
    const std::uint64_t room = header_.fileBytes - header_.dataStart;
    if (at <= room && bytes <= room - at)  // what lies elsewhere is missing when it is asked for
      places[file["file"].get<std::string>()] = {header_.dataStart + at, bytes};
  }

  Status readStorey(Json& storey) {
    const std::uint64_t cameras = number(storey["cameraCount"]), regions = number(storey["regionCount"]);
    if (cameras > kMostListed || regions > kMostListed) return malformed("a storey counts too much");
    cameras_.assign(cameras, Json()), regions_.assign(regions, Json());
    if (!storey["page"].is_null())
      if (Status read = readPage(storey["page"], 0); !read) return read;
    const auto isMissing = [](const Json& json) { return json.is_null(); };
    if (std::ranges::any_of(cameras_, isMissing) || std::ranges::any_of(regions_, isMissing))
      return malformed("its pages lack cameras or regions that it counts");
    for (const char* key : {"page", "cameraCount", "regionCount", "topElevation", "bottomElevation"})
      storey.erase(key);
    storey["cameras"] = std::move(cameras_), storey["regions"] = std::move(regions_);
    return {};
  }

  Status readPage(const Json& entry, int level) {
    if (level >= kMostLevels) return malformed("its pages nest too deep");
    const std::uint64_t at = number(entry.at("at"));
    if (at > header_.dataStart) return malformed("a page lies outside the index");
    auto json = page(header_.pageStart + at, number(entry.at("bytes")), number(entry.at("raw")),
                     entry.at("hash").get<std::string>(), fmt::format("the page at {}", at), kMostPageBytes);
    if (!json) return tl::unexpected(json.error());
    if (entry.at("leaf").get<bool>()) return readLeaf(*json);
    for (const Json& child : json->at("pages"))
      if (Status read = readPage(child, level + 1); !read) return read;
    return {};
  }

  Status readLeaf(Json& leaf) {
    std::vector<std::uint64_t> cameras, regions;
    for (Json& camera : leaf.at("cameras")) {
      cameras.push_back(number(camera.at("number")));
      if (cameras.back() >= cameras_.size()) return malformed("a page has a camera beyond its count");
      take(camera["full"]), take(camera["coarse"]);
      camera.erase("number");
      cameras_[cameras.back()] = std::move(camera);
    }
    for (const Json& region : leaf.at("regions")) {
      regions.push_back(number(region.at("number")));
      if (regions.back() >= regions_.size()) return malformed("a page has a region beyond its count");
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
      Json& region = leaf["regions"][r];
      if (!region.at("own").get<bool>()) continue;
      take(region["local"]);
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
      if (!known) return malformed("a page names a region or a camera that it has not");
      regions_[regions[r]] = std::move(region);
    }
    return {};
  }

  const ByteRanges& ranges_;
  const std::string& name_;
  Header header_;
  std::uint64_t unpacked_ = 0;
  std::vector<Json> cameras_, regions_;  ///< of the storey
};

class WalkFiles final : public BundleFiles {
 public:
  static Result<std::unique_ptr<BundleFiles>> open(std::unique_ptr<ByteRanges> ranges,
                                                   const std::string& name) {
    IndexReader reader(*ranges, name);
    try {
      const auto index = reader.read();
      if (!index) return tl::unexpected(index.error());
      auto files = std::make_unique<WalkFiles>();
      files->index_ = jsonText(*index);
      files->places_ = std::move(reader.places);
      files->ranges_ = std::move(ranges);
      return files;
    } catch (const Json::exception& problem) {
      return fail(ErrorKind::malformed, std::string("its index makes no sense: ") + problem.what(), name);
    } catch (const std::bad_alloc&) {
      return fail(ErrorKind::outOfSpace, "not enough memory for its index", name);
    }
  }

  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override {
    const auto tooLarge = [&] { return fail(ErrorKind::tooLarge, "has more bytes than it may have", path); };
    if (path == kBundleIndex) {
      if (index_.size() > mostBytes) return tooLarge();
      const auto* first = reinterpret_cast<const std::byte*>(index_.data());
      return std::vector<std::byte>(first, first + index_.size());
    }
    const auto found = places_.find(path);
    if (found == places_.end()) return fail(ErrorKind::notFound, "is not in the walk", path);
    const auto [at, size] = found->second;
    if (size > mostBytes) return tooLarge();
    std::vector<std::byte> bytes(size);
    if (Status got = ranges_->read(at, bytes); !got) return tl::unexpected(got.error());
    return bytes;
  }

 private:
  std::string index_;
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> places_;
  std::unique_ptr<ByteRanges> ranges_;
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
