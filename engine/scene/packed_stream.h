#pragma once
/// Bytes into a file, as they are or by zstd, and packed ones out of memory, in pieces. Private to this
/// folder.

#include <zstd.h>

#include <cstdio>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "engine/base/hash.h"

namespace acentric {

/// Writes to a file what it is given, hashed and counted.
class HashedOutput {
 public:
  explicit HashedOutput(std::FILE* file) : file_(file) {}
  void write(std::span<const std::byte> bytes) {
    if (bytes.empty()) return;  // fwrite takes no null pointer
    sound_ = sound_ && std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
    hasher_.bytes(bytes.data(), bytes.size());
    written_ += bytes.size();
  }
  bool sound() const { return sound_; }
  std::uint64_t written() const { return written_; }
  Hasher& hasher() { return hasher_; }

 private:
  std::FILE* file_;
  Hasher hasher_;
  std::uint64_t written_ = 0;
  bool sound_ = true;
};

/// One zstd frame of a known size, in pieces.
class Packer {
 public:
  Packer(HashedOutput& out, std::uint64_t unpackedBytes)
      : out_(out), context_(ZSTD_createCCtx(), &ZSTD_freeCCtx), buffer_(ZSTD_CStreamOutSize()) {
    if (!context_) throw std::bad_alloc();
    check(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, 1));
    check(ZSTD_CCtx_setPledgedSrcSize(context_.get(), unpackedBytes));
  }
  void add(std::span<const std::byte> bytes) { pass(bytes, ZSTD_e_continue); }
  /// What went wrong; null: nothing.
  const char* close() {
    pass({}, ZSTD_e_end);
    return trouble_;
  }

 private:
  void check(std::size_t result) {
    if (ZSTD_isError(result) && trouble_ == nullptr) trouble_ = ZSTD_getErrorName(result);
  }
  void pass(std::span<const std::byte> bytes, ZSTD_EndDirective until) {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (std::size_t left = 1; trouble_ == nullptr && (until == ZSTD_e_end ? left > 0 : in.pos < in.size);) {
      ZSTD_outBuffer packed{buffer_.data(), buffer_.size(), 0};
      left = ZSTD_compressStream2(context_.get(), &packed, &in, until);
      check(left);
      out_.write(std::span(buffer_).first(packed.pos));
    }
  }
  HashedOutput& out_;
  std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context_;
  std::vector<std::byte> buffer_;
  const char* trouble_ = nullptr;
};

/// A frame that is in memory, in pieces.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> packed)
      : context_(ZSTD_createDCtx(), &ZSTD_freeDCtx), in_{packed.data(), packed.size(), 0} {
    if (!context_) throw std::bad_alloc();
  }
  bool read(std::span<std::byte> bytes) {
    ZSTD_outBuffer out{bytes.data(), bytes.size(), 0};
    while (out.pos < out.size) {
      const std::size_t had = in_.pos, before = out.pos;
      unpack(out);
      if (ZSTD_isError(ended_) || (in_.pos == had && out.pos == before)) return false;
    }
    return true;
  }
  /// Nothing follows what was read.
  bool atEnd() {
    std::byte more;
    ZSTD_outBuffer out{&more, 1, 0};
    if (ended_ != 0) unpack(out);
    return ended_ == 0 && out.pos == 0 && in_.pos == in_.size;
  }

 private:
  /// As much as there is room for.
  void unpack(ZSTD_outBuffer& out) { ended_ = ZSTD_decompressStream(context_.get(), &out, &in_); }

  std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context_;
  ZSTD_inBuffer in_;
  std::size_t ended_ = 1;  ///< 0: the frame has
};

}  // namespace acentric
