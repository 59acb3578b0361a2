#pragma once
/// Captures from places near each other hold most surfaces several times. Merging keeps each once: in the
/// first capture that shows it.

#include <span>

#include "engine/image/capture.h"

namespace acentric {

struct MergeTolerance {
  /// Of its distance from the earlier camera: how far apart two samples of one surface may be measured.
  double share = 0.02;
};

/// Takes those samples from `capture` that one of `earlier` shows too: where that camera's column and row
/// hold a sample at the same distance. Their shares of a surface are not compared: a surface that an earlier
/// capture shows at a slant is not taken from a later one. Backgrounds and reflections stay. How many samples
/// went.
std::size_t dropShown(Capture& capture, std::span<const Capture* const> earlier,
                      const MergeTolerance& tolerance = {});

}  // namespace acentric
