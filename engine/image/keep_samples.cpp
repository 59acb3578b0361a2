#include "engine/image/keep_samples.h"

namespace acentric {
namespace {

CaptureBackground backgroundFor(const CaptureBackground& all, std::uint8_t roles) {
  BackgroundBuilder few;
  for (std::size_t column = 0; column + 1 < all.columnStart.size(); ++column) {
    for (std::uint32_t run = all.columnStart[column]; run < all.columnStart[column + 1]; ++run)
      if (const auto needed = std::uint8_t(all.roles[run] & roles); needed != 0)
        for (int row = all.firstRow[run]; row < all.endRow[run]; ++row) few.add(row, needed);
    few.closeColumn();
  }
  return std::move(few).finish(all.sky);
}

}  // namespace

void keepRoles(Capture& capture, std::uint8_t roles) {
  for (CaptureSamples* list : {static_cast<CaptureSamples*>(&capture), &capture.reflections}) {
    for (std::uint8_t& needed : list->roles) needed &= roles;
    keepSamples(*list, [&](std::size_t, std::size_t n) { return list->roles[n] != 0; });
  }
  if (capture.reflections.row.empty()) capture.reflections = {}, capture.mirror.clear();
  capture.background = backgroundFor(capture.background, roles);
  if (!capture.hasSilhouettes() && !capture.reflections.hasSilhouettes()) capture.planeTolerance = 0;
}

}  // namespace acentric
