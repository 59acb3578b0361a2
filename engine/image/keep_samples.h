#pragma once
/// Takes samples out of captures.

#include <cstdint>

#include "engine/image/capture.h"

namespace acentric {

/// Keeps the samples for which `keep(column, sample)` is true, asked in capture order. Planes stay as they
/// are, unless no sample is left.
template <class Keep>
void keepSamples(CaptureSamples& samples, const Keep& keep) {
  const bool mirrors = !samples.mirror.empty(), silhouettes = samples.hasSilhouettes();
  std::size_t kept = 0;
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column) {
    // The start of the next column is read before it is written over.
    const std::size_t first = samples.columnStart[column], end = samples.columnStart[column + 1];
    samples.columnStart[column] = std::uint32_t(kept);
    for (std::size_t n = first; n < end; ++n) {
      if (!keep(column, n)) continue;
      samples.row[kept] = samples.row[n];
      samples.inverseDistance[kept] = samples.inverseDistance[n];
      samples.colour[kept] = samples.colour[n];
      samples.roles[kept] = samples.roles[n];
      if (mirrors) samples.mirror[kept] = samples.mirror[n];
      if (silhouettes) samples.coverage[kept] = samples.coverage[n], samples.plane[kept] = samples.plane[n];
      ++kept;
    }
  }
  if (!samples.columnStart.empty()) samples.columnStart.back() = std::uint32_t(kept);
  samples.row.resize(kept), samples.inverseDistance.resize(kept), samples.colour.resize(kept),
      samples.roles.resize(kept);
  if (mirrors) samples.mirror.resize(kept);
  if (silhouettes) samples.coverage.resize(kept), samples.plane.resize(kept);
  if (kept == 0) samples.planes.clear();
}

/// What these roles need of a capture; bits of others are cleared.
void keepRoles(Capture& capture, std::uint8_t roles);

}  // namespace acentric
