#pragma once
/// What planning needs of a capture, on its way from the module that read the pack to the one that plans
/// frames: all but samples and texels, which go to the graphics card. Both are this program, so the bytes are
/// those of its memory.

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/view/walk_scene.h"

namespace acentric {

/// Appends values.
class PartWriter {
 public:
  std::vector<std::byte> bytes;

  template <class Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    (*this)(std::uint32_t(values.size()));
    const auto* from = reinterpret_cast<const std::byte*>(values.data());
    bytes.insert(bytes.end(), from, from + values.size() * sizeof(Value));
  }
};

/// Takes them in the same order.
class PartReader {
 public:
  explicit PartReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class Value>
  void operator()(Value& value) {
    take(&value, sizeof value);
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::uint32_t size = 0;
    (*this)(size);
    values.resize(size);
    take(values.data(), size * sizeof(Value));
  }

 private:
  void take(void* into, std::size_t size) {
    if (size > 0) std::memcpy(into, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
};

template <class Archive, class Patches>
void eachPart(Archive& archive, Patches& patches) {
  archive(patches.stripColumns), archive(patches.stripStart), archive(patches.patches);
  archive(patches.columnBorder), archive(patches.rowBorder);
}
template <class Archive, class Background>
void eachPartOfBackground(Archive& archive, Background& background) {
  archive(background.runs.sky), archive(background.runs.columnStart), archive(background.runs.firstRow);
  archive(background.runs.endRow), archive(background.runs.roles);
  archive(background.columnBorder), archive(background.rowBorder);
}
template <class Archive, class Display>
void eachPartOfCapture(Archive& archive, Display& capture) {
  archive(capture.camera), archive(capture.columnDirection), archive(capture.columnRange);
  archive(capture.layered), archive(capture.blended);
  eachPartOfBackground(archive, capture.background);
}

inline void writePart(PartWriter& writer, const DisplayCapture& capture) {
  eachPartOfCapture(writer, capture);
  writer(capture.patches != nullptr);
  if (capture.patches) eachPart(writer, *capture.patches);
  writer(capture.reflections != nullptr);
  if (capture.reflections) writePart(writer, *capture.reflections);
}
inline std::shared_ptr<const DisplayCapture> readPart(PartReader& reader) {
  auto capture = std::make_shared<DisplayCapture>();
  eachPartOfCapture(reader, *capture);
  bool shows = false, reflects = false;
  reader(shows);
  if (shows) {
    auto patches = std::make_shared<DisplayPatches>();
    eachPart(reader, *patches);
    capture->patches = std::move(patches);
  }
  reader(reflects);
  if (reflects) capture->reflections = readPart(reader);
  return capture;
}

}  // namespace acentric
