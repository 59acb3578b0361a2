#include "engine/view/patch_tables.h"

#include "engine/view/frame.h"

namespace acentric {
namespace {

glm::vec4 placeOf(const float* direction, float inverseDepth) {
  return {direction[0], direction[1], direction[2], inverseDepth};
}

PatchRecord recordOf(const PatchDraw& draw, std::uint32_t captureTexel, std::size_t piece) {
  const PatchColumn& c = draw.column;
  return {placeOf(c.start, c.depthStart),
          placeOf(c.step, c.depthStep),
          placeOf(c.across, c.depthAcross),
          c.columnOffset,
          c.rowOffset,
          c.middleTangent,
          captureTexel + draw.firstTexel,
          std::uint32_t(c.columns) | std::uint32_t(c.rows) << 16,
          c.mirror | (c.blended ? 1u << 8 : 0u) | (c.settled ? 1u << 9 : 0u),
          std::uint32_t(piece)};
}

PieceRecord recordOf(const StripDraw& strip, const PatchColumn& c) {
  PieceRecord record{{c.columnsPerRadian, c.rowsPerRadian},
                     c.wantedRoles,
                     sourceOfCamera(strip.piece->camera),
                     glm::vec3(0),
                     0,
                     glm::vec3(0)};
  if (!strip.limited) return record;
  record.low = {strip.lowStart, strip.lowAcross, c.lowStep};
  record.high = {strip.highStart, strip.highAcross, c.highStep};
  record.part = c.eitherSide ? 2 : 1;
  return record;
}

}  // namespace

void PatchTables::set(std::span<const StripDraw> strips, int width, int height,
                      const std::function<std::uint32_t(const DisplayCapture&)>& firstTexel, bool allTiles) {
  patches.clear(), pieces.clear();
  const StripDraw* last = nullptr;
  std::uint32_t texel = 0;
  for (const StripDraw& strip : strips) {
    if (strip.patches.empty()) continue;
    if (last == nullptr || strip.piece != last->piece || strip.capture != last->capture) {
      pieces.push_back(recordOf(strip, strip.patches.front().column));
      texel = firstTexel(*strip.capture);
    }
    last = &strip;
    for (const PatchDraw& draw : strip.patches) patches.push_back(recordOf(draw, texel, pieces.size() - 1));
  }
  tiles.find(strips, width, height, allTiles);
}

}  // namespace acentric
