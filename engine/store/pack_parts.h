#pragma once
/// Of packed captures (FORMAT.md, "Kind 1"): how their description begins, and the records of the background.
/// Private to this folder.

#include "engine/image/capture.h"
#include "engine/store/block_file.h"
#include "engine/store/keyed.h"

namespace acentric {

/// Camera, step, numbers of samples and runs, sky.
void describeHead(BlockFileWriter& file, const Capture& capture);

struct PackCounts {
  std::uint64_t samples = 0, runs = 0;
  bool sized = false;  ///< columns and rows are such as captures may have
};
/// Takes what describeHead wrote.
PackCounts describedHead(BlockFileReader& file, Capture& capture);

/// Samples or runs of each column: small numbers, unlike the offsets.
inline constexpr std::uint64_t kColumnBytes = 4;
Status addColumns(BlockFileWriter& file, const std::vector<std::uint32_t>& columnStart);
/// Of `total` samples or runs.
Status takeColumns(BlockFileReader& file, std::size_t columns, std::uint64_t total,
                   std::vector<std::uint32_t>& columnStart);

inline constexpr std::uint64_t kRunBytes = 5;
Status addBackground(BlockFileWriter& file, const CaptureBackground& background);
/// Numbers are known to agree with the file's size.
Status takeBackground(BlockFileReader& file, std::size_t columns, std::uint64_t runs, CaptureBackground& out);

}  // namespace acentric
