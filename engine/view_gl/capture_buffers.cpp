#include "engine/view_gl/capture_buffers.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric {
namespace {

std::size_t bytesOfTexels(const DisplayPatches& patches) {
  return patches.colour.size() * sizeof(patches.colour[0]) + patches.cover.size() * sizeof(patches.cover[0]);
}

std::vector<glm::uvec2> runsOf(const CaptureBackground& background) {
  std::vector<glm::uvec2> runs;
  runs.reserve(background.runCount());
  for (std::size_t i = 0; i < background.runCount(); ++i)
    runs.emplace_back(background.firstRow[i] | std::uint32_t(background.endRow[i]) << 16,
                      background.roles[i]);
  return runs;
}

Status check(const DisplayCapture& capture, const std::string& name, std::size_t largestBuffer) {
  if (Status camera = capture.camera.check(); !camera) return camera;
  const CaptureBackground& background = capture.background.runs;
  const std::size_t columns = std::size_t(capture.camera.columns);
  if (background.runCount() > 0 &&
      (background.columnStart.size() != columns + 1 || background.columnStart.front() != 0 ||
       background.columnStart.back() != background.runCount() ||
       !std::ranges::is_sorted(background.columnStart) || background.endRow.size() != background.runCount() ||
       background.roles.size() != background.runCount()))
    return fail(ErrorKind::malformed, "the capture's columns do not partition its background", name);
  if (!capture.patches) return {};
  const DisplayPatches& patches = *capture.patches;
  const std::size_t texels = patches.colour.size();
  bool sound = patches.cover.size() == texels;
  for (const DisplayPatch& patch : patches.patches)
    sound = sound &&
            patch.firstTexel + (patch.columns + std::size_t(2)) * (patch.rows + std::size_t(2)) <= texels;
  if (!sound)
    return fail(ErrorKind::malformed, "the capture's patches have other texels than they say", name);
  if (texels * sizeof(std::uint32_t) > largestBuffer)
    return fail(
        ErrorKind::tooLarge,
        fmt::format("its patches have {} texels, more than this driver's storage buffers hold ({}): bake "
                    "with fewer samples per degree or use a CPU renderer",
                    texels, largestBuffer / sizeof(std::uint32_t)),
        name);
  return {};
}

}  // namespace

std::string captureName(int camera, bool reflections) {
  return fmt::format("{} of camera {}", reflections ? "reflections" : "capture", camera);
}

std::size_t bufferBytes(const DisplayCapture& capture) {
  return capture.background.runs.runCount() * sizeof(glm::uvec2) +
         (capture.patches ? bytesOfTexels(*capture.patches) : 0);
}

Result<CaptureUpload> CaptureUpload::begin(const std::shared_ptr<const DisplayCapture>& capture,
                                           const std::string& name, std::size_t largestBuffer) {
  if (Status sound = check(*capture, name, largestBuffer); !sound) return tl::unexpected(sound.error());
  CaptureUpload upload;
  upload.buffers_.background = upload.sending_.add(runsOf(capture->background.runs));
  if (capture->patches) {
    upload.buffers_.patchColours = upload.sending_.add(std::span(capture->patches->colour), capture->patches);
    upload.buffers_.patchCovers = upload.sending_.add(std::span(capture->patches->cover), capture->patches);
  }
  upload.buffers_.bytes = upload.sending_.bytes();
  return upload;
}

}  // namespace acentric
