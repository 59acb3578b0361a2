#include "engine/image/coarse_capture.h"

#include "engine/base/contract.h"

namespace acentric {
namespace {

/// Which of `all` columns or rows stands for each of `few`.
std::vector<std::size_t> middles(int all, int few) {
  std::vector<std::size_t> chosen;
  for (int k = 0; k < few; ++k) chosen.push_back(std::size_t((2LL * k + 1) * all / (2LL * few)));
  return chosen;
}

struct Raster {
  std::vector<std::size_t> columns, rows;  ///< of the capture, by those of the coarse one
};

CaptureSamples chosenSamples(const CaptureSamples& all, const Raster& raster) {
  CaptureSamples few;
  few.columnStart.push_back(0);
  for (const std::size_t column : raster.columns) {
    std::size_t i = all.columnStart[column];
    const std::size_t end = all.columnStart[column + 1];
    for (std::size_t row = 0; row < raster.rows.size(); ++row) {
      while (i < end && all.row[i] < raster.rows[row]) ++i;
      for (; i < end && all.row[i] == raster.rows[row]; ++i) {
        few.row.push_back(std::uint16_t(row));
        few.inverseDistance.push_back(all.inverseDistance[i]);
        few.colour.push_back(all.colour[i]);
        few.roles.push_back(all.roles[i]);
        if (!all.mirror.empty()) few.mirror.push_back(all.mirror[i]);
      }
    }
    few.columnStart.push_back(std::uint32_t(few.sampleCount()));
  }
  return few;
}

CaptureBackground chosenBackground(const CaptureBackground& all, const Raster& raster) {
  if (all.runCount() == 0) return {};
  BackgroundBuilder few;
  for (const std::size_t column : raster.columns) {
    std::size_t run = all.columnStart[column];
    const std::size_t end = all.columnStart[column + 1];
    for (std::size_t row = 0; row < raster.rows.size(); ++row) {
      while (run < end && all.endRow[run] <= raster.rows[row]) ++run;
      if (run < end && all.firstRow[run] <= raster.rows[row]) few.add(int(row), all.roles[run]);
    }
    few.closeColumn();
  }
  return std::move(few).finish(all.sky);
}

}  // namespace

Capture coarsened(const Capture& capture, int factor) {
  require(factor >= 1, "a capture is made coarser, not finer");
  Capture coarse;
  coarse.camera = capture.camera;
  coarse.camera.columns = (capture.camera.columns + factor - 1) / factor;
  coarse.camera.rows = (capture.camera.rows + factor - 1) / factor;
  coarse.distanceStep = capture.distanceStep;
  const Raster raster{middles(capture.camera.columns, coarse.camera.columns),
                      middles(capture.camera.rows, coarse.camera.rows)};
  static_cast<CaptureSamples&>(coarse) = chosenSamples(capture, raster);
  coarse.background = chosenBackground(capture.background, raster);
  if (!capture.hasReflections()) return coarse;
  coarse.reflections = chosenSamples(capture.reflections, raster);
  if (!coarse.hasReflections()) {
    coarse.reflections = {};
    coarse.mirror.clear();
  }
  return coarse;
}

}  // namespace acentric
