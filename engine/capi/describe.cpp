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
const double* numbersOf(const ConvexPolygon& polygon) { return &polygon.corners.front().x; }

acentric_rendition renditionOf(const std::optional<BundleCapture>& capture) {
  if (!capture) return {};
  return {capture->columns, capture->rows, capture->samples, capture->reflections, capture->file.bytes};
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
    if (out == nullptr || !within(storey, runtime.bundle().storeys.size()))
      return refused(bundle, "no such storey");
    const BundleStorey& from = runtime.bundle().storeys[std::size_t(storey)];
    const LayoutSpec& spec = from.layout.spec;
    *out = {from.name.c_str(),
            spec.floorHeight,
            spec.eyeHeight,
            from.layout.eyeZ(),
            spec.nearBand,
            {from.start.x, from.start.y},
            from.startYaw,
            int32_t(from.cameras.size()),
            int32_t(from.local.size())};
    return kOk;
  });
}

acentric_status acentric_get_camera(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                    acentric_camera* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    const auto& storeys = runtime.bundle().storeys;
    if (out == nullptr || !within(storey, storeys.size()) ||
        !within(camera, storeys[std::size_t(storey)].cameras.size()))
      return refused(bundle, "no such camera");
    const LayoutCamera& place = storeys[std::size_t(storey)].layout.cameras[std::size_t(camera)];
    const BundleCamera& from = storeys[std::size_t(storey)].cameras[std::size_t(camera)];
    *out = {{place.position.x, place.position.y},
            place.lowAzimuth,
            place.fovRadians,
            from.topElevation,
            from.bottomElevation,
            renditionOf(from.full),
            renditionOf(from.coarse)};
    return kOk;
  });
}

acentric_status acentric_get_region(acentric_bundle* bundle, int32_t storey, int32_t region,
                                    acentric_region* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    const auto& storeys = runtime.bundle().storeys;
    if (out == nullptr || !within(storey, storeys.size()) ||
        !within(region, storeys[std::size_t(storey)].local.size()))
      return refused(bundle, "no such region");
    const BundleStorey& of = storeys[std::size_t(storey)];
    const Region& from = of.layout.regions[std::size_t(region)];
    const auto& near = of.neighbours[std::size_t(region)];
    const auto& local = of.local[std::size_t(region)];
    static_assert(sizeof(int) == sizeof(int32_t));
    *out = {int32_t(from.kind),   int32_t(from.polygon.size()), int32_t(from.grown.size()),
            int32_t(near.size()), numbersOf(from.polygon),      numbersOf(from.grown),
            near.data(),          local ? local->triangles : 0, local ? local->file.bytes : 0};
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
    *storey = int32_t(runtime.storeyAt({eye[0], eye[1], eye[2]}));
    return kOk;
  });
}

acentric_status acentric_region_at(acentric_bundle* bundle, int32_t storey, const double place[2],
                                   int32_t* region) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    const auto& storeys = runtime.bundle().storeys;
    if (place == nullptr || region == nullptr || !within(storey, storeys.size()))
      return refused(bundle, "no such storey, or NULL");
    const auto at = storeys[std::size_t(storey)].layout.regionAt({place[0], place[1]});
    *region = at.value_or(-1);
    return at ? kOk : failed(*bundle, ACENTRIC_ERROR_OUTSIDE, "no region holds the place");
  });
}

acentric_status acentric_clamp(acentric_bundle* bundle, int32_t storey, double place[2]) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    const auto& storeys = runtime.bundle().storeys;
    if (place == nullptr || !within(storey, storeys.size()))
      return refused(bundle, "no such storey, or NULL");
    const auto nearest = storeys[std::size_t(storey)].layout.nearestRegion({place[0], place[1]});
    if (nearest.region < 0) return failed(*bundle, ACENTRIC_ERROR_OUTSIDE, "there is no region near it");
    place[0] = nearest.point.x, place[1] = nearest.point.y;
    return kOk;
  });
}
