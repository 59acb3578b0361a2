#include "engine/store/capture_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace acentric {
namespace {

constexpr const char* kFirstLine = "acentric record 2";

/// One line, whatever a storey is called.
std::string oneLine(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

std::string checksumOf(const std::string& text) { return Hasher().text(text).finish().toHex(); }

}  // namespace

std::string formatRecord(const CaptureRecord& record) {
  std::string text = fmt::format("{}\nof {}\n", kFirstLine, oneLine(record.subject));
  for (const FileRecord& file : record.files)
    text += fmt::format("file {} {} {}\n", file.extension, file.bytes, file.content.toHex());
  if (record.samples)
    text += fmt::format("samples {} background {} hidden {} over {}\n", fmt::join(record.samples->kept, " "),
                        record.samples->background, record.samples->hidden, record.samples->overLimit);
  for (const KeyPart& part : record.parts) text += fmt::format("key {} {}\n", part.name, part.key.toHex());
  return text + fmt::format("end {}\n", checksumOf(text));
}

Result<CaptureRecord> parseRecord(const std::string& text, const std::string& where) {
  CaptureRecord record;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, name, hex;
    words >> kind;
    if (kind == "of" && line.size() > 3) record.subject = line.substr(3);
    if (kind == "file") {
      FileRecord file;
      words >> file.extension >> file.bytes >> hex;
      if (const auto key = ContentKey::fromHex(hex)) file.content = *key;
      record.files.push_back(std::move(file));
    }
    if (kind == "samples") {
      SampleCounts& samples = record.samples.emplace();
      for (std::uint64_t& kept : samples.kept) words >> kept;
      words >> name >> samples.background >> name >> samples.hidden >> name >> samples.overLimit;
    }
    if (kind == "key") {
      words >> name >> hex;
      const auto key = ContentKey::fromHex(hex);
      record.parts.push_back({name, key ? *key : ContentKey{}});
    }
  }
  if (formatRecord(record) != text)
    return fail(ErrorKind::malformed, "is damaged, or no record of a capture", where);
  return record;
}

std::vector<std::string> changedParts(const KeyParts& before, const KeyParts& now) {
  std::vector<std::string> names;
  const auto compare = [&](const KeyParts& these, const KeyParts& those) {
    for (const KeyPart& part : these)
      if (std::ranges::find(those, part) == those.end() && std::ranges::find(names, part.name) == names.end())
        names.push_back(part.name);
  };
  compare(now, before);
  compare(before, now);
  return names;
}

}  // namespace acentric
