#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/capi/handle.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

constexpr acentric_status kOk = ACENTRIC_OK;

void writePicture(const Frame& frame, const FloatImage& inverseZDepth, const acentric_picture& picture) {
  const std::size_t width = std::size_t(frame.colour.width), height = std::size_t(frame.colour.height);
  const std::size_t step = picture.row_bytes > 0 ? picture.row_bytes : 4 * width;
  for (std::size_t y = 0; y < height; ++y)
    std::memcpy(picture.rgba + y * step, frame.colour.pixels.data() + y * width, 4 * width);
  for (std::size_t i = 0; i < width * height; ++i) {
    const bool real = isReal(frame.source.pixels[i]);
    if (picture.holes != nullptr) picture.holes[i] = real ? 0 : 255;
    if (picture.z_depth == nullptr) continue;
    const float inverse = real ? inverseZDepth.pixels[i] : 0;
    picture.z_depth[i] = inverse > 0 ? 1 / inverse : std::numeric_limits<float>::infinity();
  }
}

template <class Body>
acentric_status forCapture(acentric_bundle* bundle, int32_t storey, int32_t camera, int32_t detail,
                           const Body& body) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (!hasCamera(runtime, storey, camera)) return refused(bundle, "no such camera");
    if (detail != ACENTRIC_COARSE && detail != ACENTRIC_FULL)
      return refused(bundle, "detail: ACENTRIC_COARSE or ACENTRIC_FULL");
    return body(runtime, std::size_t(storey), std::size_t(camera), Loaded(detail));
  });
}

template <class Body>
acentric_status forRegion(acentric_bundle* bundle, int32_t storey, int32_t region, const Body& body) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (!hasRegion(runtime, storey, region)) return refused(bundle, "no such region");
    return body(runtime, std::size_t(storey), std::size_t(region));
  });
}

acentric_status done(acentric_bundle* bundle, const Status& status) {
  return status ? kOk : failed(*bundle, status.error());
}

/// Roles of a camera that a region draws.
std::uint8_t rolesIn(const Layout& layout, std::size_t region, int camera) {
  std::uint8_t roles = 0;
  const auto add = [&](const std::vector<Cover>& covers) {
    for (const Cover& cover : covers)
      for (const Piece& piece : cover.pieces)
        if (piece.camera == camera) roles |= roleBit(layout.cameras[std::size_t(camera)], piece.role);
  };
  add(layout.regions[region].covers);
  add(layout.panoramas[region]);
  return roles;
}

}  // namespace

namespace acentric::capi {

/// By their numbers in the library.
constexpr Renderer kOffered[] = {Renderer::list, Renderer::scalar, Renderer::zbuffer};
static_assert(ACENTRIC_LIST == 0 && ACENTRIC_SCALAR == 1 && ACENTRIC_ZBUFFER == 2);
constexpr Reconstruction kPlain[] = {Reconstruction::point, Reconstruction::splat};
static_assert(ACENTRIC_POINT == 0 && ACENTRIC_SPLAT == 1);

std::int32_t codeOf(Reconstruction reconstruction) {
  return reconstruction == Reconstruction::patches ? ACENTRIC_PATCHES : std::int32_t(reconstruction);
}

Result<ViewSettings> settingsOf(const Bundle& bundle, const acentric_settings* settings) {
  ViewSettings out = bundle.view;
  if (settings == nullptr) return out;
  const auto refuse = [](const char* what) { return fail(ErrorKind::invalidArgument, what, "settings"); };
  if (settings->renderer < ACENTRIC_LIST || settings->renderer > ACENTRIC_ZBUFFER)
    return refuse("there is no such renderer");
  if (settings->reconstruction < ACENTRIC_POINT || settings->reconstruction > ACENTRIC_PATCHES)
    return refuse("there is no such reconstruction");
  out.renderer = kOffered[settings->renderer];
  out.reconstruction =
      settings->reconstruction > ACENTRIC_SPLAT ? Reconstruction::patches : kPlain[settings->reconstruction];
  out.maxSplatPixels = settings->max_splat_pixels;
  out.localGeometry = settings->local_geometry != 0;
  out.secondaryCover = settings->secondary_cover != 0;
  out.fillHoles = settings->fill_holes != 0;
  return out;
}
static_assert(int(Loaded::absent) == ACENTRIC_ABSENT && int(Loaded::coarse) == ACENTRIC_COARSE &&
              int(Loaded::full) == ACENTRIC_FULL);

PerspectiveView viewOf(const acentric_view& view) {
  return {{view.eye[0], view.eye[1], view.eye[2]}, view.yaw, view.pitch, view.fov, view.width, view.height};
}

Result<Wanted> wantedOf(const BundlePlayer& runtime, const acentric_view& view,
                        const acentric_settings* settings) {
  const auto chosen = settingsOf(runtime.bundle(), settings);
  if (!chosen) return tl::unexpected(chosen.error());
  Wanted wanted{viewOf(view), *chosen, {}};
  auto needs = runtime.needsOf(wanted.view, wanted.settings);
  if (!needs) return tl::unexpected(needs.error());
  wanted.needs = std::move(*needs);
  return wanted;
}

acentric_status failedView(acentric_bundle& bundle, const Error& error) {
  return failed(bundle, error.kind == ErrorKind::notFound ? ACENTRIC_ERROR_OUTSIDE : codeOf(error.kind),
                error.describe());
}

}  // namespace acentric::capi

acentric_status acentric_start_view(acentric_bundle* bundle, acentric_view* view) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (view == nullptr) return refused(bundle, "view is NULL");
    const BundleStorey& storey = runtime.bundle().storeys[std::size_t(runtime.bundle().storey)];
    const auto around = runtime.placeAt(std::size_t(runtime.bundle().storey), storey.start);
    if (!around) return failed(*bundle, around.error());
    const glm::dvec2 place =
        *around ? (*around)->here().layout.nearestRegion(storey.start).point : storey.start;
    *view = {{place.x, place.y, storey.layout.eyeZ()}, storey.startYaw, 0, runtime.bundle().fov, 960, 540};
    return kOk;
  });
}

acentric_status acentric_default_settings(acentric_bundle* bundle, acentric_settings* settings) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (settings == nullptr) return refused(bundle, "settings is NULL");
    const ViewSettings& from = runtime.bundle().view;
    *settings = {ACENTRIC_LIST,      codeOf(from.reconstruction), from.maxSplatPixels,
                 from.localGeometry, from.secondaryCover,         from.fillHoles};
    return kOk;
  });
}

acentric_status acentric_view_needs(acentric_bundle* bundle, const acentric_view* view,
                                    const acentric_settings* settings, acentric_need* list, size_t capacity,
                                    acentric_needs* needs) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (view == nullptr || needs == nullptr || (list == nullptr && capacity > 0))
      return refused(bundle, "view, list or needs is NULL");
    const auto wanted = wantedOf(runtime, *view, settings);
    if (!wanted) return failedView(*bundle, wanted.error());
    const BundlePlayer::Needs& found = wanted->needs;
    std::size_t count = 0;
    const auto add = [&](int32_t kind, int number, Loaded loaded, std::uint32_t roles) {
      if (count < capacity) list[count] = {kind, number, int32_t(loaded), roles};
      ++count;
    };
    const BundlePlace& place = *found.place;
    for (const int camera : found.cameras) {
      const std::uint64_t number = place.cameras[std::size_t(camera)];
      add(ACENTRIC_CAPTURE, int(number), runtime.loaded(place.storey, number),
          rolesIn(place.here().layout, std::size_t(found.region), camera));
    }
    const std::uint64_t region = place.regions[std::size_t(found.region)];
    if (wanted->settings.localGeometry)
      add(ACENTRIC_REGION, int(region),
          runtime.regionLoaded(place.storey, region) ? Loaded::full : Loaded::absent, 0xff);
    *needs = {int32_t(place.storey), int32_t(region), count};
    return kOk;
  });
}

uint64_t acentric_memory(const acentric_bundle* bundle) {
  return bundle != nullptr ? bundle->runtime.memory() : 0;
}

acentric_status acentric_set_memory_limit(acentric_bundle* bundle, uint64_t bytes) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    runtime.setLimit(bytes);
    return kOk;
  });
}

acentric_status acentric_load_capture(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                      int32_t detail) {
  return forCapture(bundle, storey, camera, detail,
                    [&](BundlePlayer& runtime, std::size_t s, std::size_t c, Loaded d) {
                      return done(bundle, runtime.loadCapture(s, c, d));
                    });
}

acentric_status acentric_unload_capture(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                        int32_t detail) {
  return forCapture(bundle, storey, camera, detail,
                    [](BundlePlayer& runtime, std::size_t s, std::size_t c, Loaded d) {
                      runtime.unloadCapture(s, c, d);
                      return kOk;
                    });
}

acentric_status acentric_load_region(acentric_bundle* bundle, int32_t storey, int32_t region) {
  return forRegion(bundle, storey, region, [&](BundlePlayer& runtime, std::size_t s, std::size_t r) {
    return done(bundle, runtime.loadRegion(s, r));
  });
}

acentric_status acentric_unload_region(acentric_bundle* bundle, int32_t storey, int32_t region) {
  return forRegion(bundle, storey, region, [](BundlePlayer& runtime, std::size_t s, std::size_t r) {
    runtime.unloadRegion(s, r);
    return kOk;
  });
}

acentric_status acentric_unload_textures(acentric_bundle* bundle) {
  return guarded(bundle, [](BundlePlayer& runtime) {
    runtime.unloadTextures();
    return kOk;
  });
}

acentric_status acentric_load_view(acentric_bundle* bundle, const acentric_view* view,
                                   const acentric_settings* settings, int32_t detail) {
  return forView(
      bundle, view, settings, wrongDetail(detail), [&](BundlePlayer& runtime, const Wanted& wanted) {
        return done(bundle, runtime.loadView(wanted.needs, Loaded(detail), wanted.settings.localGeometry));
      });
}

acentric_status acentric_render(acentric_bundle* bundle, const acentric_view* view,
                                const acentric_settings* settings, const acentric_picture* picture) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (view == nullptr || picture == nullptr || picture->rgba == nullptr)
      return refused(bundle, "view, picture or its rgba is NULL");
    if (picture->row_bytes > 0 && (view->width < 0 || picture->row_bytes < 4 * std::size_t(view->width)))
      return refused(bundle, "row_bytes: less than a row");
    const auto chosen = settingsOf(runtime.bundle(), settings);
    if (!chosen) return failed(*bundle, chosen.error());
    auto frame = runtime.render(viewOf(*view), *chosen);
    if (!frame) return failedView(*bundle, frame.error());
    writePicture(*frame, runtime.inverseZDepth(), *picture);
    runtime.recycle(std::move(*frame));
    return kOk;
  });
}
