#pragma once
/// The frame that packed captures and surface light share (FORMAT.md, "Block files"): a preamble with kind,
/// version and content key, a description, a table of blocks, zstd-compressed blocks, and an XXH3 checksum
/// over all of it.
///
/// Reading verifies the checksum before anything is believed, and every size against the size of the file
/// before anything is allocated: a file of n bytes never makes a reader allocate more than 256 n for its
/// contents, nor for what readers make of blocks that are coded once more (writers claim it, readers ask
/// mayHold).

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/store/lanes.h"

namespace acentric {

enum class BlockFileKind : std::uint32_t {
  capture = 1,
  surfaceLight = 2,
  simplifiedLocal = 3,
  localGeometry = 4,  ///< of bundles (engine/export/FORMAT.md)
  surfaceLightPart = 5,
};

/// Of captures: colours as they are and arrays of records; all of it coded; the same with colours as they are
/// shown (FORMAT.md).
inline constexpr std::uint32_t kCodedCapture = 6, kDisplayCapture = 7;

/// Records per block of a lane array: with up to 16 bytes a record a block stays within a processor's cache.
inline constexpr std::size_t kRecordsPerBlock = 65536;
inline constexpr std::size_t kStreamBlock = std::size_t(1) << 23;  ///< bytes of a stream in one block

class BlockFileWriter {
 public:
  /// Told to stop, it adds and writes nothing more, but gives `cancelled`. Version 0: the kind's usual one.
  BlockFileWriter(BlockFileKind kind, const ContentKey& key, std::stop_token stop = {},
                  std::uint32_t version = 0)
      : kind_(kind), version_(version), key_(key), stop_(std::move(stop)) {}

  template <class T>
  void describe(T value) {
    static_assert(std::is_arithmetic_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    description_.insert(description_.end(), bytes, bytes + sizeof value);
  }
  Status addBlock(std::span<const std::byte> raw);
  /// `count` records in blocks of kRecordsPerBlock.
  Status addRecords(std::span<const ConstLane> lanes, std::size_t count);
  /// Bytes that are coded already, in blocks of kStreamBlock.
  Status addStream(std::span<const std::byte> bytes);
  /// What a reader will need besides the blocks as they are unpacked: the file is made long enough for it.
  void claim(std::uint64_t bytes) { claimedBytes_ += bytes; }
  Status write(const std::filesystem::path& path) const;
  /// What `write` writes.
  std::vector<std::byte> bytes() const;

 private:
  /// All but the blocks: what is before them and behind.
  struct Frame {
    std::vector<std::byte> before, behind;
  };
  Frame frame() const;
  struct BlockSize {
    std::uint32_t raw = 0;
    std::uint32_t stored = 0;
  };
  BlockFileKind kind_;
  std::uint32_t version_;
  ContentKey key_;
  std::stop_token stop_;
  std::vector<std::byte> description_;
  std::vector<BlockSize> sizes_;
  std::vector<std::vector<std::byte>> stored_;  ///< by block
  std::uint64_t storedBytes_ = 0;
  std::uint64_t rawBytes_ = 0;
  std::uint64_t claimedBytes_ = 0;
};

/// Puts other values into the description of a file that is sound, from its byte `at` on, and makes its
/// checksum anew.
void describeAnew(std::span<std::byte> file, std::size_t at, std::span<const std::byte> values);

class BlockFileReader {
 public:
  /// Reads and verifies everything but the blocks' contents.
  static Result<BlockFileReader> open(const std::filesystem::path& path, BlockFileKind kind);
  /// The same of a file's bytes; `name` is for messages.
  static Result<BlockFileReader> of(std::vector<std::byte> bytes, std::string name, BlockFileKind kind);

  const ContentKey& key() const { return key_; }
  std::uint32_t version() const { return version_; }
  const std::string& name() const { return name_; }
  std::uint64_t rawBytes() const { return rawBytes_; }
  /// May what is read of the file take so many bytes, besides the blocks as they are unpacked?
  bool mayHold(std::uint64_t bytes) const;

  /// Takes the next value of the description. A description that is too short gives zeros and fails
  /// `describedAll`.
  template <class T>
  T described() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    takeDescription(&value, sizeof value);
    return value;
  }
  /// Is there more of the description?
  bool describesMore() const { return descriptionSound_ && descriptionAt_ < descriptionEnd_; }
  bool describedAll() const { return descriptionSound_ && descriptionAt_ == descriptionEnd_; }

  /// Bytes of the next block, unpacked; 0 if there is none.
  std::size_t nextSize() const;
  /// Unpacks the next block into `raw`, whose size must be the block's.
  Status nextBlock(std::span<std::byte> raw);
  Status nextRecords(std::span<const Lane> lanes, std::size_t count);
  /// `size` is rawBytes at most.
  Result<std::vector<std::byte>> nextStream(std::size_t size);
  bool atEnd() const { return block_ == blockCount_; }

  tl::unexpected<Error> malformed(std::string message) const {
    return fail(ErrorKind::malformed, std::move(message), name_);
  }

 private:
  void takeDescription(void* out, std::size_t size);
  Status parse(BlockFileKind kind);

  std::vector<std::byte> bytes_;
  std::string name_;
  ContentKey key_;
  std::uint32_t version_ = 0;
  std::uint64_t rawBytes_ = 0;
  std::size_t descriptionAt_ = 0;
  std::size_t descriptionEnd_ = 0;
  bool descriptionSound_ = true;
  std::size_t table_ = 0;
  std::size_t blockCount_ = 0;
  std::size_t block_ = 0;
  std::size_t blockAt_ = 0;  ///< file offset of the next block's contents
};

}  // namespace acentric
