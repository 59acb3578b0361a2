#include "engine/export/walk_index.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/json_text.h"

namespace acentric {

using namespace walk_format;

tl::unexpected<Error> WalkIndex::malformed(std::string message) const {
  return fail(ErrorKind::malformed, std::move(message), *name_);
}

std::uint64_t WalkIndex::number(const BundleJson& json) {
  return json.is_number_unsigned() ? json.get<std::uint64_t>() : ~std::uint64_t(0);
}

void WalkIndex::putLists(BundleJson& storey, BundleJson cameras, BundleJson regions) {
  for (const char* key : {"page", "cameraCount", "regionCount", "topElevation", "bottomElevation"})
    storey.erase(key);
  storey["cameras"] = std::move(cameras), storey["regions"] = std::move(regions);
}

Result<WalkIndex> WalkIndex::open(const ByteRanges& ranges, const std::string& name) {
  WalkIndex index(ranges, name);
  const auto size = ranges.size();
  if (!size) return tl::unexpected(size.error());
  std::vector<std::byte> bytes(std::min<std::uint64_t>(*size, kHeaderBytes));
  if (Status got = ranges.read(0, bytes); !got) return tl::unexpected(got.error());
  auto header = headerOf(bytes, name);
  if (!header) return tl::unexpected(header.error());
  index.header_ = *header;
  if (header->fileBytes != *size)
    return index.malformed(fmt::format("has {} bytes and says {}: it is cut off, or not copied whole", *size,
                                       header->fileBytes));
  return index;
}

Result<BundleJson> WalkIndex::read(std::uint64_t at, std::uint64_t bytes, std::uint64_t raw,
                                   const std::string& hash, const std::string& what,
                                   std::uint64_t mostRaw) const {
  if (raw > mostRaw || bytes > raw + 1024) return fail(ErrorKind::malformed, "is too large", what);
  if (at > header_.dataStart || bytes > header_.dataStart - at)
    return fail(ErrorKind::malformed, "lies outside the index", what);
  std::vector<std::byte> packed(bytes);
  if (Status got = ranges_->read(at, packed); !got) return tl::unexpected(got.error());
  const auto text = checkedText(packed, raw, hash, what);
  if (!text) return tl::unexpected(text.error());
  return parseJson<BundleJson>(*text, what);
}

Result<BundleJson> WalkIndex::root() const {
  const ContentKey hash{header_.rootHash[0], header_.rootHash[1]};
  auto root = read(kHeaderBytes, header_.rootBytes, header_.rootRaw, hash.toHex(),
                   *name_ + ", the root of its index", kMostRootBytes);
  if (root && !root->is_object()) return malformed("its index is no object");
  return root;
}

WalkPageEntry WalkIndex::entryOf(const BundleJson& json) {
  const BundleJson& box = json.at("box");
  const auto side = [&](std::size_t i) { return box.at(i).get<double>(); };
  return {number(json.at("at")),      number(json.at("bytes")),
          number(json.at("raw")),     json.at("hash").get<std::string>(),
          {side(0), side(1)},         {side(2), side(3)},
          json.at("leaf").get<bool>()};
}

std::string WalkIndex::nameOf(const WalkPageEntry& entry) const {
  return fmt::format("{}, the page at {}", *name_, entry.at);
}

Result<BundleJson> WalkIndex::page(const WalkPageEntry& entry) const {
  if (entry.at > header_.dataStart) return malformed("a page lies outside the index");
  return read(header_.pageStart + entry.at, entry.bytes, entry.raw, entry.hash, nameOf(entry),
              kMostPageBytes);
}

void WalkIndex::take(BundleJson& file, FilePlaces& places) const {
  if (!file.is_object()) return;
  const std::uint64_t at = number(file["at"]), bytes = number(file["bytes"]);
  file.erase("at");
  const std::uint64_t room = header_.fileBytes - header_.dataStart;
  if (at <= room && bytes <= room - at)  // what lies elsewhere is missing when it is asked for
    places[file["file"].get<std::string>()] = {header_.dataStart + at, bytes};
}

Result<std::vector<std::byte>> RangeFiles::read(const std::string& path, std::uint64_t mostBytes) const {
  const auto found = places_.find(path);
  if (found == places_.end()) return fail(ErrorKind::notFound, "is not in the walk", path);
  const auto [at, size] = found->second;
  if (size > mostBytes) return fail(ErrorKind::tooLarge, "has more bytes than it may have", path);
  std::vector<std::byte> bytes(size);
  if (Status got = ranges_->read(at, bytes); !got) return tl::unexpected(got.error());
  return bytes;
}

}  // namespace acentric
