#include "engine/store/block_file.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "engine/base/contract.h"
#include "engine/base/file.h"

namespace acentric {
namespace {

constexpr std::array<char, 8> kMagic = {'A', 'C', 'E', 'N', 'P', 'K', '\r', '\n'};
/// Of each kind of file its own: one that changes leaves the others readable.
constexpr std::uint32_t versionOf(BlockFileKind kind) {
  if (kind == BlockFileKind::capture) return kCodedCapture;
  if (kind == BlockFileKind::surfaceLight) return 4;
  if (kind == BlockFileKind::localGeometry) return 3;
  return kind == BlockFileKind::surfaceLightPart ? 1 : 2;
}
/// What a reader of the kind takes: captures in both of their versions.
bool isRead(BlockFileKind kind, std::uint32_t version) {
  return version == versionOf(kind) || (kind == BlockFileKind::capture && version == kDisplayCapture);
}
std::string versionsOf(BlockFileKind kind) {
  return kind == BlockFileKind::capture ? fmt::format("{} and {}", kCodedCapture, kDisplayCapture)
                                        : fmt::format("{}", versionOf(kind));
}
constexpr std::size_t kPreambleBytes = 56;
constexpr std::size_t kChecksumBytes = 16;
constexpr std::size_t kTableEntryBytes = 8;
constexpr std::uint32_t kMaxBlockBytes = 16u << 20;
/// No file unpacks to more than this many times its own size; writers pad with zeros where content compresses
/// better.
constexpr std::uint64_t kMaxExpansion = 256;
/// Level 1 unpacks as fast as higher ones and packs several times faster.
constexpr int kCompressionLevel = 1;

template <class T>
void put(std::vector<std::byte>& out, T value) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof value);
}

template <class T>
T take(const std::vector<std::byte>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace

Status BlockFileWriter::addBlock(std::span<const std::byte> raw) {
  if (raw.size() > kMaxBlockBytes) return fail(ErrorKind::tooLarge, "a block exceeds 16 MiB");
  if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "writing was stopped");
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  // One for all blocks of a thread: small ones take less than the making of another.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  &ZSTD_freeCCtx);
  if (!context) return fail(ErrorKind::outOfSpace, "not enough memory to pack a block");
  const std::size_t size = ZSTD_compressCCtx(context.get(), packed.data(), packed.size(), raw.data(),
                                             raw.size(), kCompressionLevel);
  if (ZSTD_isError(size))
    return fail(ErrorKind::internal, std::string("compression failed: ") + ZSTD_getErrorName(size));
  stored_.emplace_back(packed.begin(), packed.begin() + std::ptrdiff_t(size));
  storedBytes_ += size;
  sizes_.push_back({static_cast<std::uint32_t>(raw.size()), static_cast<std::uint32_t>(size)});
  rawBytes_ += raw.size();
  return {};
}

Status BlockFileWriter::addStream(std::span<const std::byte> bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += kStreamBlock)
    if (Status added = addBlock(bytes.subspan(at, std::min(kStreamBlock, bytes.size() - at))); !added)
      return added;
  return {};
}

Status BlockFileWriter::addRecords(std::span<const ConstLane> lanes, std::size_t count) {
  const std::size_t width = recordBytes(lanes);
  std::vector<std::byte> planes(width * std::min(count, kRecordsPerBlock));
  for (std::size_t begin = 0; begin < count; begin += kRecordsPerBlock) {
    const std::size_t records = std::min(kRecordsPerBlock, count - begin);
    encodeLanes(lanes, begin, records, planes.data());
    if (Status added = addBlock({planes.data(), width * records}); !added) return added;
  }
  return {};
}

BlockFileWriter::Frame BlockFileWriter::frame() const {
  const std::uint64_t contentBytes =
      kPreambleBytes + description_.size() + sizes_.size() * kTableEntryBytes + storedBytes_ + kChecksumBytes;
  const std::uint64_t fileBytes =
      std::max(contentBytes, (rawBytes_ + claimedBytes_ + kMaxExpansion - 1) / kMaxExpansion);
  std::vector<std::byte> out;
  for (char letter : kMagic) put(out, letter);
  put(out, version_ == 0 ? versionOf(kind_) : version_);
  put(out, static_cast<std::uint32_t>(kind_));
  put(out, key_.high);
  put(out, key_.low);
  put(out, fileBytes);
  put(out, rawBytes_);
  put(out, static_cast<std::uint32_t>(description_.size()));
  put(out, static_cast<std::uint32_t>(sizes_.size()));
  out.insert(out.end(), description_.begin(), description_.end());
  for (const BlockSize& size : sizes_) {
    put(out, size.raw);
    put(out, size.stored);
  }
  std::vector<std::byte> end(fileBytes - contentBytes);
  Hasher hasher;
  hasher.bytes(out.data(), out.size());
  for (const auto& block : stored_) hasher.bytes(block.data(), block.size());
  const ContentKey checksum = hasher.bytes(end.data(), end.size()).finish();
  put(end, checksum.high);
  put(end, checksum.low);
  return {std::move(out), std::move(end)};
}

Status BlockFileWriter::write(const std::filesystem::path& path) const {
  const Frame around = frame();
  std::vector<std::span<const std::byte>> parts{around.before};
  parts.insert(parts.end(), stored_.begin(), stored_.end());
  parts.push_back(around.behind);
  return writeFileAtomically(path, parts, stop_);
}

std::vector<std::byte> BlockFileWriter::bytes() const {
  auto [all, behind] = frame();
  for (const auto& block : stored_) all.insert(all.end(), block.begin(), block.end());
  all.insert(all.end(), behind.begin(), behind.end());
  return std::move(all);
}

void describeAnew(std::span<std::byte> file, std::size_t at, std::span<const std::byte> values) {
  require(file.size() > kPreambleBytes + kChecksumBytes &&
              at + values.size() <= file.size() - kPreambleBytes - kChecksumBytes,
          "a description lies within its file");
  std::memcpy(file.data() + kPreambleBytes + at, values.data(), values.size());
  const std::size_t checked = file.size() - kChecksumBytes;
  const ContentKey checksum = Hasher().bytes(file.data(), checked).finish();
  std::memcpy(file.data() + checked, &checksum.high, 8);
  std::memcpy(file.data() + checked + 8, &checksum.low, 8);
}

Result<BlockFileReader> BlockFileReader::open(const std::filesystem::path& path, BlockFileKind kind) {
  auto bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return of(std::move(*bytes), path.string(), kind);
}

Result<BlockFileReader> BlockFileReader::of(std::vector<std::byte> bytes, std::string name,
                                            BlockFileKind kind) {
  BlockFileReader reader;
  reader.bytes_ = std::move(bytes);
  reader.name_ = std::move(name);
  if (Status parsed = reader.parse(kind); !parsed) return tl::unexpected(parsed.error());
  return reader;
}

Status BlockFileReader::parse(BlockFileKind kind) {
  if (bytes_.size() < kPreambleBytes + kChecksumBytes ||
      std::memcmp(bytes_.data(), kMagic.data(), kMagic.size()) != 0)
    return malformed("is no packed file of this program, or its beginning is damaged");
  const std::size_t checked = bytes_.size() - kChecksumBytes;
  if (take<std::uint64_t>(bytes_, 32) != bytes_.size())
    return malformed(fmt::format("has {} bytes instead of {}: it was cut or appended to", bytes_.size(),
                                 take<std::uint64_t>(bytes_, 32)));
  const ContentKey stored{take<std::uint64_t>(bytes_, checked), take<std::uint64_t>(bytes_, checked + 8)};
  if (Hasher().bytes(bytes_.data(), checked).finish() != stored)
    return malformed("is damaged: its checksum differs");
  if (take<std::uint32_t>(bytes_, 12) != static_cast<std::uint32_t>(kind))
    return malformed("holds another kind of data than its name says");
  version_ = take<std::uint32_t>(bytes_, 8);
  if (!isRead(kind, version_))
    return fail(
        ErrorKind::unsupported,
        fmt::format("has format version {}, this program reads {}; bake it anew", version_, versionsOf(kind)),
        name_);
  key_ = {take<std::uint64_t>(bytes_, 16), take<std::uint64_t>(bytes_, 24)};
  rawBytes_ = take<std::uint64_t>(bytes_, 40);
  const std::uint64_t descriptionBytes = take<std::uint32_t>(bytes_, 48);
  const std::uint64_t blocks = take<std::uint32_t>(bytes_, 52);
  const std::uint64_t tableEnd = kPreambleBytes + descriptionBytes + blocks * kTableEntryBytes;
  if (tableEnd > checked) return malformed("claims more blocks than fit into it");
  if (rawBytes_ > kMaxExpansion * bytes_.size())
    return malformed("claims more content than a file of its size holds");

  descriptionAt_ = kPreambleBytes;
  descriptionEnd_ = kPreambleBytes + static_cast<std::size_t>(descriptionBytes);
  table_ = descriptionEnd_;
  blockCount_ = static_cast<std::size_t>(blocks);
  blockAt_ = static_cast<std::size_t>(tableEnd);
  std::uint64_t raw = 0, end = tableEnd;
  for (std::size_t i = 0; i < blockCount_; ++i) {
    const auto rawBytes = take<std::uint32_t>(bytes_, table_ + i * kTableEntryBytes);
    if (rawBytes > kMaxBlockBytes) return malformed(fmt::format("block {} is larger than 16 MiB", i));
    raw += rawBytes;
    end += take<std::uint32_t>(bytes_, table_ + i * kTableEntryBytes + 4);
  }
  if (raw != rawBytes_ || end > checked) return malformed("its table of blocks contradicts its size");
  return {};
}

bool BlockFileReader::mayHold(std::uint64_t bytes) const {
  const std::uint64_t most = kMaxExpansion * bytes_.size();
  return bytes <= most && rawBytes_ <= most - bytes;
}

std::size_t BlockFileReader::nextSize() const {
  return atEnd() ? 0 : take<std::uint32_t>(bytes_, table_ + block_ * kTableEntryBytes);
}

void BlockFileReader::takeDescription(void* out, std::size_t size) {
  descriptionSound_ = descriptionSound_ && size <= descriptionEnd_ - descriptionAt_;
  if (!descriptionSound_) return;
  std::memcpy(out, bytes_.data() + descriptionAt_, size);
  descriptionAt_ += size;
}

Status BlockFileReader::nextBlock(std::span<std::byte> raw) {
  if (atEnd()) return malformed("has fewer blocks than its description needs");
  const std::size_t entry = table_ + block_ * kTableEntryBytes;
  if (take<std::uint32_t>(bytes_, entry) != raw.size())
    return malformed(fmt::format("block {} unpacks to another size than its description needs", block_));
  const auto stored = take<std::uint32_t>(bytes_, entry + 4);
  const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), bytes_.data() + blockAt_, stored);
  if (ZSTD_isError(size) || size != raw.size())
    return malformed(fmt::format("block {} cannot be unpacked: {}", block_,
                                 ZSTD_isError(size) ? ZSTD_getErrorName(size) : "it is too short"));
  blockAt_ += stored;
  ++block_;
  return {};
}

Result<std::vector<std::byte>> BlockFileReader::nextStream(std::size_t size) {
  std::vector<std::byte> stream(size);
  for (std::size_t at = 0; at < size; at += kStreamBlock) {
    const Status read = nextBlock(std::span(stream).subspan(at, std::min(kStreamBlock, size - at)));
    if (!read) return tl::unexpected(read.error());
  }
  return stream;
}

Status BlockFileReader::nextRecords(std::span<const Lane> lanes, std::size_t count) {
  const std::size_t width = recordBytes(lanes);
  std::vector<std::byte> planes(width * std::min(count, kRecordsPerBlock));
  for (std::size_t begin = 0; begin < count; begin += kRecordsPerBlock) {
    const std::size_t records = std::min(kRecordsPerBlock, count - begin);
    if (Status unpacked = nextBlock({planes.data(), width * records}); !unpacked) return unpacked;
    decodeLanes(lanes, begin, records, planes.data());
  }
  return {};
}

}  // namespace acentric
