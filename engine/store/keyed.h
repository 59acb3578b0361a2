#pragma once
/// What a file holds together with the content key that it says it was made for.

#include <functional>
#include <span>
#include <stop_token>

#include "engine/base/hash.h"
#include "engine/image/capture.h"
#include "engine/scene/simplify.h"
#include "engine/scene/surface_light.h"
#include "engine/scene/surface_light_part.h"

namespace acentric {

template <class Value>
struct Keyed {
  ContentKey key;
  Value value;
};

Result<Keyed<Capture>> readKeyedCaptureExr(const std::filesystem::path& path);
Result<Keyed<Capture>> readKeyedCapturePack(const std::filesystem::path& path);
/// What a pack says of itself before its samples.
struct PackHead {
  ColumnCamera camera;
  std::uint64_t samples = 0, reflections = 0;
};
using AcceptPack = std::function<Status(const PackHead&)>;
/// Of a pack's bytes; `name` is for messages. What `accept` refuses is not unpacked.
Result<Keyed<Capture>> keyedCaptureOf(std::vector<std::byte> bytes, const std::string& name,
                                      const AcceptPack& accept = {});
/// Makes a sound pack that of a camera which stands elsewhere on the plan and sees the same.
void movePack(std::span<std::byte> pack, const glm::dvec2& place);
Result<Keyed<SurfaceLight>> readKeyedSurfaceLight(const std::filesystem::path& path);
Status writeSurfaceLightPart(const SurfaceLightPart& part, const ContentKey& key,
                             const std::filesystem::path& path);
Result<Keyed<SurfaceLightPart>> readKeyedSurfaceLightPart(const std::filesystem::path& path);
Result<Keyed<SimplifiedLocal>> readKeyedSimplified(const std::filesystem::path& path);

/// The value alone.
template <class Value>
Result<Value> withoutKey(Result<Keyed<Value>>&& keyed) {
  if (!keyed) return tl::unexpected(std::move(keyed.error()));
  return std::move(keyed->value);
}

/// Runs `body`; memory that runs out becomes an error of the file.
template <class Body>
auto withinMemory(const std::filesystem::path& path, const Body& body) -> decltype(body()) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory", path.string());
  } catch (const std::length_error&) {
    return fail(ErrorKind::outOfSpace, "not enough memory", path.string());
  }
}

}  // namespace acentric
