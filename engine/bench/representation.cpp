#include "engine/bench/representation.h"

#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/bench/bake_to_size.h"
#include "engine/bench/make_representation.h"

namespace acentric {
namespace {

std::filesystem::path noteOf(const Workplace& at, const std::string& name) {
  return at.folder / (name + ".baked.json");
}

}  // namespace

Result<std::uint64_t> packedBytes(const CaptureStore& store, std::span<const ContentKey> keys) {
  std::uint64_t bytes = 0;
  for (const ContentKey& key : keys) {
    const auto record = store.record(key);
    if (!record) return tl::unexpected(record.error());
    for (const FileRecord& file : record->files)
      if (file.extension == ".pack") bytes += file.bytes;
  }
  return bytes;
}

BakeShare RepresentationBake::share() const {
  TrialBake trial;
  trial.packedBytes = packedBytes;
  if (packedBytes) trial.times += 1.0 / kSizingPart;
  return {&open, cameras, light, 0, trial};
}

std::optional<BakeNote> readNote(const Workplace& at, const std::string& name, const ContentKey& key) {
  const auto text = readText(noteOf(at, name));
  if (!text) return std::nullopt;
  const auto json = parseJson(*text).value_or(nlohmann::json());
  if (!json.is_object() || !json.contains("key") || !json["key"].is_string() ||
      json["key"].get<std::string>() != key.toHex())
    return std::nullopt;
  const auto number = [&](const char* field) {
    return json.contains(field) && json[field].is_number() ? json[field].get<double>() : -1;
  };
  const BakeNote note{key, number("samplesPerDegree"), number("seconds")};
  if (note.samplesPerDegree < 0 || note.seconds < 0) return std::nullopt;
  return note;
}

Status writeNote(const Workplace& at, const std::string& name, const BakeNote& note) {
  const nlohmann::ordered_json json = {
      {"key", note.key.toHex()}, {"samplesPerDegree", note.samplesPerDegree}, {"seconds", note.seconds}};
  return writeTextAtomically(noteOf(at, name), jsonText(json, 2) + "\n");
}

}  // namespace acentric
