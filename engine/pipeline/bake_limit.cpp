#include "engine/pipeline/bake_limit.h"

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr int kMostRounds = 3;      // of laying out and predicting
constexpr double kMostAsked = 1e9;  // cameras: more than any layout has

std::size_t smaller(std::size_t cameras, std::size_t most) {
  return most == 0 ? cameras : std::min(cameras, most);
}

}  // namespace

const char* nameOf(LimitedBy limit) {
  switch (limit) {
    case LimitedBy::nothing:
      return "nothing";
    case LimitedBy::cameras:
      return "cameras";
    case LimitedBy::minutes:
      return "minutes";
    case LimitedBy::unknown:
      return "unknown";
  }
  return "unknown";
}

Result<LimitedBy> layOutWithin(const BakeLimit& limit) {
  const bool timed = limit.seconds > 0;
  std::size_t tried = 0;
  LaidOut laid;
  const auto layOut = [&](std::size_t most) -> Status {
    const auto result = limit.layOut(most);
    if (!result) return tl::unexpected(result.error());
    tried = most, laid = *result;
    return {};
  };
  bool known = false;
  const auto limitedBy = [&] {
    if (laid.whole) return LimitedBy::nothing;
    if (tried == limit.mostCameras) return LimitedBy::cameras;
    return known ? LimitedBy::minutes : LimitedBy::unknown;
  };
  if (Status done = layOut(timed ? smaller(kTrialCameras, limit.mostCameras) : limit.mostCameras); !done)
    return tl::unexpected(done.error());
  const bool room = laid.whole && laid.cameras <= kRoomCameras;
  for (int round = 0; timed && !room && round < kMostRounds; ++round) {
    const auto seconds = limit.predict();
    if (!seconds || !(*seconds > 0)) break;
    known = true;
    const double share = *seconds / limit.seconds;
    const bool enough = share >= kPartShare || tried == limit.mostCameras;
    if (laid.whole ? share <= kWholeAllowance : share <= kPartAllowance && enough) break;
    const double affordable = std::min(double(laid.cameras) / share, kMostAsked);
    const auto camerasFor = [&](double cameras) {
      return smaller(std::max(kFewestCameras, std::size_t(cameras)), limit.mostCameras);
    };
    const std::size_t next = camerasFor(affordable), all = camerasFor(kWholeAllowance * affordable);
    if (next == tried) break;
    if (round == 0 && !laid.whole && all > tried) {
      if (Status done = layOut(all); !done) return tl::unexpected(done.error());
      if (laid.whole) continue;
    }
    if (next != tried)
      if (Status done = layOut(next); !done) return tl::unexpected(done.error());
  }
  return limitedBy();
}

}  // namespace acentric
