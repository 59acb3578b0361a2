/// Indices of walks: the text of a root and, behind a 0, that of a page, which the root names PAGE. Hashes
/// and sizes are put right.

#include <algorithm>
#include <string>

#include "engine/export/walk_format.h"
#include "engine/export/walk_pages.h"
#include "engine/store/packed_text.h"
#include "tests/fuzz/fuzz.h"

using namespace acentric;

namespace {

class Memory final : public ByteRanges {
 public:
  explicit Memory(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  Result<std::uint64_t> size() const override { return bytes_.size(); }
  Status read(std::uint64_t at, std::span<std::byte> into) const override {
    if (at > bytes_.size() || into.size() > bytes_.size() - at)
      return fail(ErrorKind::unreadable, "beyond the end");
    std::copy_n(bytes_.begin() + std::ptrdiff_t(at), into.size(), into.begin());
    return {};
  }

 private:
  std::vector<std::byte> bytes_;
};

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

bool accepts(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  std::string root = text.substr(0, end), leaf = text.substr(std::min(end + 1, text.size()));
  const std::vector<std::byte> page = packedText(leaf);
  const std::string entry = "{\"at\":0,\"bytes\":" + std::to_string(page.size()) +
                            ",\"raw\":" + std::to_string(leaf.size()) + ",\"hash\":\"" +
                            walk_format::hashText(page) + "\",\"box\":[0,0,1,1],\"leaf\":true}";
  for (std::size_t at = root.find("PAGE"); at != std::string::npos; at = root.find("PAGE", at + entry.size()))
    root.replace(at, 4, entry);
  const std::vector<std::byte> packed = packedText(root);
  constexpr std::size_t kData = 64;
  walk_format::Header header;
  header.rootBytes = packed.size(), header.rootRaw = root.size();
  header.pageStart = walk_format::kHeaderBytes + packed.size();
  header.dataStart = header.pageStart + page.size();
  header.fileBytes = header.dataStart + kData;
  const ContentKey hash = Hasher().bytes(packed.data(), packed.size()).finish();
  header.rootHash = {hash.high, hash.low};
  std::vector<std::byte> bytes;
  append(bytes, walk_format::headerBytes(header)), append(bytes, packed), append(bytes, page);
  bytes.resize(header.fileBytes);
  if (auto pages = WalkPages::open(std::make_shared<Memory>(bytes), "walk")) {
    const std::size_t storeys = (*pages)->root().storeys.size();
    static_cast<void>((*pages)->storeyAt({0.5, 0.5, 1}));
    for (std::size_t s = 0; s < storeys; ++s) {
      for (const std::size_t number : {0U, 1U, 1000U}) {
        if (number < (*pages)->counts(s).cameras) static_cast<void>((*pages)->camera(s, number));
        if (number < (*pages)->counts(s).regions) static_cast<void>((*pages)->region(s, number));
      }
      if ((*pages)->counts(s).regions == 0) continue;
      for (const glm::dvec2 point : {glm::dvec2(0), glm::dvec2(0.5), glm::dvec2(1e6, -3)}) {
        const auto place = (*pages)->placeAt(s, point);
        if (!place) continue;
        for (const BundleCamera& camera : (*place)->here().cameras)
          if (camera.full) static_cast<void>((*place)->files->read(camera.full->file.path, 1 << 20));
      }
    }
  }
  const auto files = walkFiles(std::make_unique<Memory>(std::move(bytes)), "walk");
  if (!files) return false;
  const auto bundle = readBundle(**files);
  if (!bundle) return false;
  for (const BundleStorey& storey : bundle->storeys)
    for (const BundleCamera& camera : storey.cameras)
      if (camera.full) static_cast<void>((*files)->read(camera.full->file.path, 1 << 20));
  return true;
}
