#include <algorithm>

#include "engine/capi/handle.h"
#include "engine/geometry/conventions.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

constexpr acentric_status kOk = ACENTRIC_OK;

template <class Vector, class Number, std::size_t Count>
void copy(const Vector& from, Number (&to)[Count]) {
  for (std::size_t i = 0; i < Count; ++i) to[i] = from[int(i)];
}

static_assert(sizeof(glm::dvec2) == 2 * sizeof(double));
const double* numbersOf(std::span<const glm::dvec2> corners) { return &corners.front().x; }

acentric_rendition renditionOf(const CameraFacts::Rendition& capture) {
  return {capture.columns, capture.rows, capture.samples, capture.reflections, capture.bytes};
}

}  // namespace

acentric_status acentric_get_info(acentric_bundle* bundle, acentric_info* info) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (info == nullptr) return refused(bundle, "info is NULL");
    const Bundle& from = runtime.bundle();
    *info = {};
    info->name = from.name.c_str(), info->generator = from.generator.c_str();
    copy(from.origin, info->origin);
    if (!from.bounds.empty())
      copy(from.bounds.min, info->bounds_min), copy(from.bounds.max, info->bounds_max);
    copy(from.sky.zenith, info->sky_zenith), copy(from.sky.horizon, info->sky_horizon);
    copy(from.sky.ground, info->sky_ground);
    info->exposure = from.exposure, info->fov = from.fov;
    const BundleFeatures& f = from.features;
    info->features =
        (f.layered ? unsigned(ACENTRIC_LAYERED) : 0u) | (f.blended ? unsigned(ACENTRIC_BLENDED) : 0u) |
        (f.mirrors ? unsigned(ACENTRIC_MIRRORS) : 0u) | (f.background ? unsigned(ACENTRIC_BACKGROUND) : 0u) |
        (f.light ? unsigned(ACENTRIC_LIGHT) : 0u);
    info->storeys = int32_t(from.storeys.size()), info->start_storey = from.storey;
    info->bookmarks = int32_t(from.bookmarks.size()), info->paths = int32_t(from.paths.size());
    info->textures = int32_t(from.textures.size()), info->materials = int32_t(from.materials.size());
    info->mirrors = int32_t(from.mirrors.size());
    return kOk;
  });
}

acentric_status acentric_get_storey(acentric_bundle* bundle, int32_t storey, acentric_storey* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !hasStorey(runtime, storey)) return refused(bundle, "no such storey");
    const BundlePlaces::Counts counts = runtime.places().counts(std::size_t(storey));
    const BundleStorey& from = runtime.bundle().storeys[std::size_t(storey)];
    const LayoutSpec& spec = from.layout.spec;
    *out = {from.name.c_str(),  spec.floorHeight,        spec.eyeHeight,
            from.layout.eyeZ(), spec.nearBand,           {from.start.x, from.start.y},
            from.startYaw,      int32_t(counts.cameras), int32_t(counts.regions)};
    return kOk;
  });
}

acentric_status acentric_get_camera(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                    acentric_camera* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !hasCamera(runtime, storey, camera)) return refused(bundle, "no such camera");
    const auto from = runtime.places().camera(std::size_t(storey), std::size_t(camera));
    if (!from) return failed(*bundle, from.error());
    *out = {{from->position.x, from->position.y},
            from->lowAzimuth,
            from->fovRadians,
            from->topElevation,
            from->bottomElevation,
            renditionOf(from->full),
            renditionOf(from->coarse)};
    return kOk;
  });
}

acentric_status acentric_get_region(acentric_bundle* bundle, int32_t storey, int32_t region,
                                    acentric_region* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !hasRegion(runtime, storey, region)) return refused(bundle, "no such region");
    const auto from = runtime.places().region(std::size_t(storey), std::size_t(region));
    if (!from) return failed(*bundle, from.error());
    static_assert(sizeof(int) == sizeof(int32_t));
    *out = {int32_t(from->kind),
            int32_t(from->polygon.size()),
            int32_t(from->grown.size()),
            int32_t(from->neighbours.size()),
            numbersOf(from->polygon),
            numbersOf(from->grown),
            from->neighbours.data(),
            from->triangles,
            from->bytes};
    return kOk;
  });
}

acentric_status acentric_get_bookmark(acentric_bundle* bundle, int32_t bookmark, acentric_bookmark* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !within(bookmark, runtime.bundle().bookmarks.size()))
      return refused(bundle, "no such bookmark");
    const BundleBookmark& from = runtime.bundle().bookmarks[std::size_t(bookmark)];
    const BundlePose& pose = from.pose;
    *out = {from.name.c_str(),
            from.storey,
            {{pose.eye.x, pose.eye.y, pose.eye.z}, pose.yaw, pose.pitch, 0},
            from.fov};
    return kOk;
  });
}

acentric_status acentric_get_path(acentric_bundle* bundle, int32_t path, acentric_path* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !within(path, runtime.bundle().paths.size()))
      return refused(bundle, "no such path");
    const BundlePath& from = runtime.bundle().paths[std::size_t(path)];
    const auto& poses = bundle->poses[std::size_t(path)];
    *out = {from.name.c_str(), from.storey, int32_t(poses.size()), poses.data()};
    return kOk;
  });
}

acentric_status acentric_storey_at(acentric_bundle* bundle, const double eye[3], int32_t* storey) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (eye == nullptr || storey == nullptr) return refused(bundle, "eye or storey is NULL");
    const auto at = runtime.storeyAt({eye[0], eye[1], eye[2]});
    if (!at) return failed(*bundle, at.error());
    *storey = int32_t(*at);
    return kOk;
  });
}

acentric_status acentric_region_at(acentric_bundle* bundle, int32_t storey, const double place[2],
                                   int32_t* region) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (place == nullptr || region == nullptr || !hasStorey(runtime, storey))
      return refused(bundle, "no such storey, or NULL");
    *region = -1;
    const glm::dvec2 point(place[0], place[1]);
    const auto around = runtime.placeAt(std::size_t(storey), point);
    if (!around) return failed(*bundle, around.error());
    const auto at = *around ? (*around)->here().layout.regionAt(point) : std::nullopt;
    if (!at) return failed(*bundle, ACENTRIC_ERROR_OUTSIDE, "no region holds the place");
    *region = int32_t((*around)->regions[std::size_t(*at)]);
    return kOk;
  });
}

acentric_status acentric_clamp(acentric_bundle* bundle, int32_t storey, double place[2]) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (place == nullptr || !hasStorey(runtime, storey)) return refused(bundle, "no such storey, or NULL");
    const glm::dvec2 point(place[0], place[1]);
    const auto around = runtime.placeAt(std::size_t(storey), point);
    if (!around) return failed(*bundle, around.error());
    const Layout::Nearest nearest =
        *around ? (*around)->here().layout.nearestRegion(point) : Layout::Nearest();
    if (nearest.region < 0) return failed(*bundle, ACENTRIC_ERROR_OUTSIDE, "there is no region near it");
    place[0] = nearest.point.x, place[1] = nearest.point.y;
    return kOk;
  });
}
