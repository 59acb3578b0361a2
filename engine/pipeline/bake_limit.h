#pragma once
/// How many cameras a new project may have so that its bake takes no longer than asked. A part of the ground
/// is laid out on trial, what that takes is predicted, and as much is laid out as its rate lets. Laying out
/// and predicting are injected: the pipeline wires them, tests have rates of their own.

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/base/result.h"

namespace acentric {

/// `unknown`: the minutes, but what baking takes was not known in time.
enum class LimitedBy : std::uint8_t { nothing, cameras, minutes, unknown };
const char* nameOf(LimitedBy limit);  ///< "nothing", "cameras", "minutes", "unknown"

/// What was laid out.
struct LaidOut {
  std::size_t cameras = 0;
  bool whole = false;  ///< all of the ground
};

struct BakeLimit {
  double seconds = 0;           ///< 0 = no limit
  std::size_t mostCameras = 0;  ///< 0 = no limit
  /// Lays out as much as so many cameras serve (0: all). What is laid out last stays.
  std::function<Result<LaidOut>(std::size_t mostCameras)> layOut;
  /// Seconds that baking it takes; nothing where that is not known in time.
  std::function<std::optional<double>()> predict;
};

/// The trial has no more cameras. Where nothing can be predicted of it, it stays.
inline constexpr std::size_t kTrialCameras = 500;
/// All of the ground in no more cameras than a room has is laid out whatever it takes, and nothing is
/// predicted.
inline constexpr std::size_t kRoomCameras = 300;
/// However little time there is, so many cameras may be: a region or two.
inline constexpr std::size_t kFewestCameras = 64;
/// All of the ground is laid out where that takes so many times as long as asked: a forecast at a glance may
/// be wrong by as much, and who has all of a room need not fetch the rest of it.
inline constexpr double kWholeAllowance = 2;
/// A part takes no longer than so many times what was asked, and no less than that share of it unless the
/// cameras are used up.
inline constexpr double kPartAllowance = 1.15, kPartShare = 0.75;

Result<LimitedBy> layOutWithin(const BakeLimit& limit);

}  // namespace acentric
