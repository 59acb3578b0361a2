/// What the page has of the engine, as a module of WebAssembly: packs to what is drawn. The pictures in a
/// pack are decoded by the browser: findPictures tells them, the page gives each back as RGBA8, and readPack
/// takes them in their order. web/src/bundle/page_module.ts is the other side of these functions.
///
/// One pack at a time. What is wrong with it is told by message(). A module that traps, because memory is
/// out, is not used again.

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/shown_colour.h"
#include "engine/store/block_file.h"
#include "engine/store/colour_picture.h"
#include "engine/store/keyed.h"
#include "engine/store/still_picture.h"
#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

struct Picture {
  std::vector<std::byte> file;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct State {
  std::vector<std::byte> pack;
  std::vector<Picture> pictures;
  std::size_t taken = 0;  ///< of the pictures
  std::optional<Capture> capture;
  /// Of samples as the page sends them to the graphics card, three each: inverse distance and roles; row,
  /// column << 16; RGBA8.
  std::vector<std::uint32_t> samples, reflections;
  std::string message;
} state;

bool startsWith(std::span<const std::byte> bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}
/// An AVIF file: a box that says so, of a length of four bytes.
bool isAvif(std::span<const std::byte> bytes) { return startsWith(bytes, 4, "ftypavif"); }

/// Before a browser decodes it: do all sizes that the file names (ISO/IEC 23008-12, "ispe") fit a picture of
/// a pack?
bool hasSensibleSize(std::span<const std::byte> file) {
  constexpr std::size_t kSize = 16;  // "ispe", flags, width, height
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint64_t(file[at + i]);
    return value;
  };
  bool any = false;
  for (std::size_t at = 0; at + kSize <= file.size(); ++at) {
    if (!startsWith(file, at, "ispe")) continue;
    const std::uint64_t width = number(at + 8), height = number(at + 12);
    if (width > std::uint64_t(kMostPictureSide) || height > std::uint64_t(kMostPictureSide) ||
        width * height > std::uint64_t(kMostPiecePixels))
      return false;
    any = true;
  }
  return any;
}

Status find() {
  auto file = BlockFileReader::of(state.pack, "", BlockFileKind::capture);
  if (!file) return tl::unexpected(file.error());
  if (file->version() == kPlainCapture) return {};
  while (!file->atEnd()) {
    Picture picture;
    picture.file.resize(file->nextSize());
    if (Status read = file->nextBlock(picture.file); !read) return read;
    if (!isAvif(picture.file)) continue;
    if (!hasSensibleSize(picture.file))
      return file->malformed("a picture of its colours has no sensible size");
    state.pictures.push_back(std::move(picture));
  }
  return {};
}

std::vector<std::uint32_t> wordsOf(const CaptureSamples& samples, bool isShown, float exposure) {
  std::vector<std::uint32_t> out;
  out.reserve(3 * samples.sampleCount());
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column)
    for (std::size_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i) {
      const PackedSample packed = packSample(samples.inverseDistance[i], samples.roles[i], samples.row[i]);
      const Rgba8 shown = shownColour(samples.colour[i], isShown, exposure);
      out.insert(out.end(), {packed.inverseDistanceAndRoles, packed.row | std::uint32_t(column) << 16,
                             std::bit_cast<std::uint32_t>(shown)});
    }
  return out;
}

}  // namespace

/// In place of libavif: the pictures that the browser decoded, in their order.
Result<StillPicture> decodeStill(std::span<const std::byte>, int width, int height, int bits) {
  if (state.taken >= state.pictures.size() || state.pictures[state.taken].width != width ||
      state.pictures[state.taken].height != height)
    return fail(ErrorKind::malformed, "a picture of its colours has another size than it needs");
  const std::vector<std::uint8_t>& rgba = state.pictures[state.taken++].rgba;
  StillPicture picture{width, height, bits, {}};
  for (auto& plane : picture.planes) plane.resize(rgba.size() / 4);
  const float scale = float((1 << bits) - 1) / 255;
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
    const ColourCodes codes =
        lumaAndChroma(scale * glm::vec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]), bits);
    for (std::size_t p = 0; p < 3; ++p) picture.planes[p][i] = codes[p];
  }
  return picture;
}

}  // namespace acentric

using namespace acentric;

// Addresses and sizes are those of the module's memory.
#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

/// Room for `bytes` of a pack, which findPictures and readPack then read. What was read before is let go.
EXPORTED(takePack) std::byte* takePack(std::size_t bytes) {
  state = {};
  state.pack.resize(bytes);
  return state.pack.data();
}
/// How many there are; -1 where the pack is damaged.
EXPORTED(findPictures) int findPictures() {
  const Status found = find();
  if (!found) state.message = found.error().message;
  return found ? int(state.pictures.size()) : -1;
}
EXPORTED(pictureFile) const std::byte* pictureFile(std::size_t picture) {
  return state.pictures[picture].file.data();
}
EXPORTED(pictureBytes) std::size_t pictureBytes(std::size_t picture) {
  return state.pictures[picture].file.size();
}
/// Room for the picture as the browser decoded it: rows of RGBA8.
EXPORTED(takePicture) std::uint8_t* takePicture(std::size_t picture, int width, int height) {
  Picture& taken = state.pictures[picture];
  taken = {{}, width, height, {}};
  taken.rgba.resize(4 * std::size_t(width) * std::size_t(height));
  return taken.rgba.data();
}

/// A list of samples; addresses of arrays.
struct PageList {
  std::uint32_t samples;
  const std::uint32_t* columnStart;  ///< columns + 1
  const std::uint32_t* words;        ///< three a sample
  const std::uint8_t* mirrors;       ///< null: none
};
struct PageCapture {
  double centre[3];
  double lowAzimuth, fov, topElevation, bottomElevation;
  std::uint32_t columns, rows;
  PageList surfaces, reflections;  ///< without reflections all 0
  std::uint32_t runs;
  const std::uint32_t* runStart;  ///< columns + 1
  const std::uint16_t *runFirst, *runEnd;
  const std::uint8_t* runRoles;
  float zenith[3], horizon[3], ground[3];
};

/// Once all its pictures are there. Null where the pack is damaged.
EXPORTED(readPack) const PageCapture* readPack(float exposure) {
  static PageCapture page;
  auto read = keyedCaptureOf(std::move(state.pack), "");
  if (!read) {
    state.message = read.error().message;
    return nullptr;
  }
  state.pictures.clear();
  state.capture = std::move(read->value);
  const Capture& capture = *state.capture;
  const auto listOf = [&](const CaptureSamples& samples, std::vector<std::uint32_t>& words) {
    words = wordsOf(samples, capture.shown, exposure);
    return PageList{std::uint32_t(samples.sampleCount()), samples.columnStart.data(), words.data(),
                    samples.mirror.empty() ? nullptr : samples.mirror.data()};
  };
  const ColumnCamera& camera = capture.camera;
  const glm::dvec3& p = camera.centreOfProjection;
  const CaptureBackground& b = capture.background;
  page = {{p.x, p.y, p.z},
          camera.lowAzimuth,
          camera.fovRadians,
          camera.topElevation,
          camera.bottomElevation,
          std::uint32_t(camera.columns),
          std::uint32_t(camera.rows),
          listOf(capture, state.samples),
          {},
          std::uint32_t(b.runCount()),
          b.columnStart.data(),
          b.firstRow.data(),
          b.endRow.data(),
          b.roles.data(),
          {},
          {},
          {}};
  if (capture.hasReflections()) page.reflections = listOf(capture.reflections, state.reflections);
  const auto copy = [](const glm::vec3& from, float(&to)[3]) { std::memcpy(to, &from, sizeof to); };
  copy(b.sky.zenith, page.zenith), copy(b.sky.horizon, page.horizon), copy(b.sky.ground, page.ground);
  return &page;
}
/// UTF-8, ending with 0.
EXPORTED(message) const char* message() { return state.message.c_str(); }

// What is not in the module's standard library, or stays outside.

/// zstd, on the page's side; the number of bytes, or more than `room`.
__attribute__((import_module("page"), import_name("unpack"))) extern "C" std::size_t unpackZstd(
    void* into, std::size_t room, const void* from, std::size_t bytes);
extern "C" std::size_t ZSTD_decompress(void* into, std::size_t room, const void* from, std::size_t bytes) {
  return unpackZstd(into, room, from, bytes);
}
extern "C" unsigned ZSTD_isError(std::size_t result) { return result > std::size_t(1) << 31; }
extern "C" const char* ZSTD_getErrorName(std::size_t) { return "it does not unpack"; }

/// Nothing of the engine is thrown but what ends a module: memory that is out.
extern "C" void* __cxa_allocate_exception(std::size_t) { __builtin_trap(); }
extern "C" [[noreturn]] void __cxa_throw(void*, void*, void*) { __builtin_trap(); }
extern "C" int madvise(void*, std::size_t, int) { return 0; }
