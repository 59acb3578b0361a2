#include "engine/image/image.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/program_file.h"
#include "engine/image/files/image_files.h"
#include "engine/image/png.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

/// The module, loaded with the first call. It stays.
Result<const ImageFiles*> imageFiles() {
  static const Result<const ImageFiles*> files = []() -> Result<const ImageFiles*> {
    const fs::path module = programFile("acentric-image-files.so");
    if (void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (const void* const symbol = dlsym(library, kImageFilesSymbol))
        return static_cast<const ImageFiles*>(symbol);
    return fail(
        ErrorKind::internal,
        fmt::format("images cannot be read or written without this part of the program: {}; install it again",
                    dlerror()));
  }();
  return files;
}

Status checkSides(int width, int height, const fs::path& path) {
  if (width < 1 || height < 1)
    return fail(ErrorKind::invalidArgument, "an empty picture cannot be written", path.string());
  return {};
}

/// May a floating-point picture of that size be written there?
Status checkExr(int width, int height, const fs::path& path) {
  if (path.extension() != ".exr")
    return fail(ErrorKind::invalidArgument, "floating-point pictures are written as .exr", path.string());
  return checkSides(width, height, path);
}

}  // namespace

Result<ColourImage> decodeColourImage(std::span<const std::byte> bytes, const std::string& name,
                                      std::size_t maxPixels) {
  if (bytes.empty()) return fail(ErrorKind::malformed, "is empty", name);
  return imageFiles().and_then(
      [&](const ImageFiles* files) { return files->decodeColourImage(bytes, name, maxPixels); });
}

Result<ColourImage> readColourImage(const fs::path& path, std::size_t maxPixels) {
  return readFile(path).and_then(
      [&](const auto& bytes) { return decodeColourImage(bytes, path.string(), maxPixels); });
}

Status writeColourImage(const ColourImage& image, const fs::path& path) {
  if (Status sound = checkSides(image.width, image.height, path); !sound) return sound;
  if (path.extension() == ".png")
    return encodePng(image).and_then([&](const auto& bytes) { return writeFileAtomically(path, bytes); });
  return imageFiles().and_then([&](const ImageFiles* files) { return files->writeColourImage(image, path); });
}

Status writeFloatImage(const FloatImage& image, const fs::path& path, const char* channel) {
  if (Status sound = checkExr(image.width, image.height, path); !sound) return sound;
  return imageFiles().and_then(
      [&](const ImageFiles* files) { return files->writeFloatImage(image, path, channel); });
}

Status writePanorama(const LinearImage& radiance, const FloatImage& distance, const fs::path& path) {
  require(radiance.width == distance.width && radiance.height == distance.height, "both are of one size");
  if (Status sound = checkExr(radiance.width, radiance.height, path); !sound) return sound;
  return imageFiles().and_then(
      [&](const ImageFiles* files) { return files->writePanorama(radiance, distance, path); });
}

}  // namespace acentric
