// Apart from what parses models: a program that reads project files need not link parsers.
#include <fmt/format.h>

#include "engine/base/hash.h"
#include "engine/scene/import.h"

namespace acentric {

Status ImportOptions::check() const {
  if (!(metresPerUnit >= 0) || metresPerUnit > 1e6 || (metresPerUnit > 0 && metresPerUnit < 1e-9))
    return fail(ErrorKind::invalidArgument,
                fmt::format("metres per unit is {}; it must be between 1e-9 and 1e6, or 0 to guess it",
                            metresPerUnit));
  if (up != UpAxis::guess && up != UpAxis::y && up != UpAxis::z)
    return fail(ErrorKind::invalidArgument, "the up axis must be guess, y or z");
  if (lighting != Lighting::guess && lighting != Lighting::inTextures && lighting != Lighting::computed)
    return fail(ErrorKind::invalidArgument, "lighting must be guess, inTextures or computed");
  return {};
}

void ImportOptions::addTo(Hasher& hasher) const {
  hasher.value(metresPerUnit)
      .value(up)
      .value(std::uint8_t(defaultLight))
      .value(lighting)
      .value(flatTriangles)
      .value(std::uint8_t(outsideFiles));
}

}  // namespace acentric
