#include "engine/bake/turned_samples.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

std::uint32_t pixelOf(std::size_t column, int row, int rows) {
  return std::uint32_t(column) * std::uint32_t(rows) + std::uint32_t(row);
}

/// Takes away what rays met of the same facets in the same parts; their roles go to what replaces it.
void replaceMet(std::vector<TurnedSample>& added, int rows, CaptureSamples& list) {
  for (std::size_t column = 0; column + 1 < list.columnStart.size(); ++column)
    for (std::uint32_t i = list.columnStart[column]; i < list.columnStart[column + 1]; ++i) {
      const std::uint32_t pixel = pixelOf(column, list.row[i], rows);
      const SurfacePlane plane = list.planes[list.plane[i]];
      for (auto a = std::ranges::lower_bound(added, pixel, {}, &TurnedSample::pixel);
           a != added.end() && a->pixel == pixel; ++a) {
        if (a->met != plane || (!list.mirror.empty() && a->mirror != list.mirror[i])) continue;
        a->roles |= list.roles[i];
        list.coverage[i] &= std::uint16_t(~a->coverage);
      }
    }
}

/// The samples that still cover something and those that are added; `added` is sorted as captures are.
CaptureSamples merged(const CaptureSamples& list, const std::vector<TurnedSample>& added, int rows) {
  CaptureSamples out;
  out.planes = list.planes;
  out.columnStart.push_back(0);
  auto next = added.begin();
  const auto addBefore = [&](std::uint32_t pixel, float inverseDistance) {
    for (; next != added.end() &&
           (next->pixel < pixel || (next->pixel == pixel && next->inverseDistance > inverseDistance));
         ++next) {
      out.row.push_back(std::uint16_t(next->pixel % std::uint32_t(rows)));
      out.inverseDistance.push_back(next->inverseDistance);
      out.colour.push_back(next->colour), out.roles.push_back(next->roles);
      if (!list.mirror.empty()) out.mirror.push_back(next->mirror);
      out.coverage.push_back(next->coverage);
      out.plane.push_back(std::uint32_t(out.planes.size()));
      out.planes.push_back(next->plane);
    }
  };
  for (std::size_t column = 0; column + 1 < list.columnStart.size(); ++column) {
    for (std::uint32_t i = list.columnStart[column]; i < list.columnStart[column + 1]; ++i) {
      if (list.coverage[i] == 0) continue;
      addBefore(pixelOf(column, list.row[i], rows), list.inverseDistance[i]);
      out.row.push_back(list.row[i]), out.inverseDistance.push_back(list.inverseDistance[i]);
      out.colour.push_back(list.colour[i]), out.roles.push_back(list.roles[i]);
      if (!list.mirror.empty()) out.mirror.push_back(list.mirror[i]);
      out.coverage.push_back(list.coverage[i]), out.plane.push_back(list.plane[i]);
    }
    addBefore(pixelOf(column + 1, 0, rows), HUGE_VALF);
    out.columnStart.push_back(std::uint32_t(out.row.size()));
  }
  return out;
}

}  // namespace

void mergeTurned(std::vector<TurnedSample> added, int rows, CaptureSamples& list) {
  if (added.empty()) return;
  std::ranges::stable_sort(added, [](const TurnedSample& a, const TurnedSample& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.inverseDistance > b.inverseDistance;
  });
  replaceMet(added, rows, list);
  list = merged(list, added, rows);
}

SampleCounts countsOf(const CaptureSamples& list) {
  SampleCounts counts;
  for (std::size_t column = 0; column + 1 < list.columnStart.size(); ++column) {
    std::size_t layer = 0;
    for (std::uint32_t i = list.columnStart[column]; i < list.columnStart[column + 1]; ++i) {
      layer = i > list.columnStart[column] && list.row[i] == list.row[i - 1] ? layer + 1 : 0;
      ++counts.kept[std::min(layer, SampleCounts::kLayers - 1)];
    }
  }
  return counts;
}

}  // namespace acentric
