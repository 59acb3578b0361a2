#pragma once
/// What the store notes beside each capture and each surface light (FORMAT.md, "Records"): what it is of,
/// what its key was made of, and what its files were when they were written. So a later bake can tell why it
/// would be baked again, and that its files are still as they were, without reading them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/image/sample_counts.h"

namespace acentric {

struct FileRecord {
  std::string extension;  ///< of the file under the record's key: ".pack"
  std::uint64_t bytes = 0;
  ContentKey content;
  bool operator==(const FileRecord&) const = default;
};

struct CaptureRecord {
  std::string subject;  ///< the camera (or the surfaces' light), the same before and after a change
  KeyParts parts;       ///< of the key
  std::vector<FileRecord> files;
  std::optional<SampleCounts> samples;  ///< of a capture, as it was baked
  bool operator==(const CaptureRecord&) const = default;
};

std::string formatRecord(const CaptureRecord& record);
/// Refused unless it is just what formatRecord gives.
Result<CaptureRecord> parseRecord(const std::string& text, const std::string& where);

/// The names of the parts that differ, in the order of `now`; also of those that only one of them has.
std::vector<std::string> changedParts(const KeyParts& before, const KeyParts& now);

}  // namespace acentric
