#pragma once
/// How C calls become C++ ones: arguments are checked, errors become codes and a message, and nothing is
/// thrown across.

#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/capi/acentric_runtime.h"
#include "engine/export/background_loader.h"
#include "engine/export/bundle_player.h"

struct acentric_bundle {
  acentric::BundlePlayer runtime;
  bool open = false;
  std::string message;
  std::vector<std::vector<acentric_pose>> poses;  ///< by path
  std::set<acentric::LoadJob> failed;             ///< in the background
  std::set<acentric::LoadJob> handedOut;          ///< models
  /// Storey and region of the last request: what is beside them was asked for.
  std::optional<std::pair<std::size_t, std::uint64_t>> ahead;
  std::unique_ptr<acentric::BackgroundLoader> loader;
};

namespace acentric::capi {

acentric_status codeOf(ErrorKind kind);

/// Keeps the error's message.
inline acentric_status failed(acentric_bundle& bundle, acentric_status code, std::string message) {
  bundle.message = std::move(message);
  return code;
}
inline acentric_status failed(acentric_bundle& bundle, const Error& error) {
  return failed(bundle, codeOf(error.kind), error.describe());
}

/// body(runtime, bundle) of an open handle.
template <class Body>
acentric_status guarded(acentric_bundle* bundle, const Body& body) noexcept {
  if (bundle == nullptr) return ACENTRIC_ERROR_ARGUMENT;
  try {
    if (!bundle->open) return failed(*bundle, ACENTRIC_ERROR_ARGUMENT, "the bundle could not be opened");
    bundle->message.clear();
    return body(bundle->runtime);
  } catch (const std::bad_alloc&) {
    bundle->message.clear();
    return ACENTRIC_ERROR_MEMORY;
  } catch (...) {
    bundle->message.clear();
    return ACENTRIC_ERROR_INTERNAL;
  }
}

/// Of an argument that is NULL, or a number out of range.
inline acentric_status refused(acentric_bundle* bundle, const char* what) {
  return failed(*bundle, ACENTRIC_ERROR_ARGUMENT, what);
}

inline bool within(int32_t number, std::size_t count) {
  return number >= 0 && static_cast<std::size_t>(number) < count;
}
inline bool hasStorey(const BundlePlayer& runtime, int32_t storey) {
  return within(storey, runtime.bundle().storeys.size());
}
inline bool hasCamera(const BundlePlayer& runtime, int32_t storey, int32_t camera) {
  return hasStorey(runtime, storey) && within(camera, runtime.places().counts(std::size_t(storey)).cameras);
}
inline bool hasRegion(const BundlePlayer& runtime, int32_t storey, int32_t region) {
  return hasStorey(runtime, storey) && within(region, runtime.places().counts(std::size_t(storey)).regions);
}

/// With `settings` NULL the project's.
Result<ViewSettings> settingsOf(const Bundle& bundle, const acentric_settings* settings);
PerspectiveView viewOf(const acentric_view& view);

/// What a view is drawn from.
struct Wanted {
  PerspectiveView view;
  ViewSettings settings;
  BundlePlayer::Needs needs;
};
Result<Wanted> wantedOf(const BundlePlayer& runtime, const acentric_view& view,
                        const acentric_settings* settings);
/// An eye outside every region has a code of its own.
acentric_status failedView(acentric_bundle& bundle, const Error& error);
/// body(runtime, wanted) of a view. `wrong`: what is wrong with another argument, or null.
template <class Body>
acentric_status forView(acentric_bundle* bundle, const acentric_view* view, const acentric_settings* settings,
                        const char* wrong, const Body& body) noexcept {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (view == nullptr) return refused(bundle, "view is NULL");
    if (wrong != nullptr) return refused(bundle, wrong);
    const auto wanted = wantedOf(runtime, *view, settings);
    if (!wanted) return failedView(*bundle, wanted.error());
    return body(runtime, *wanted);
  });
}
/// Null where it is ACENTRIC_COARSE or ACENTRIC_FULL.
inline const char* wrongDetail(int32_t detail) {
  return detail == ACENTRIC_COARSE || detail == ACENTRIC_FULL ? nullptr
                                                              : "detail: ACENTRIC_COARSE or ACENTRIC_FULL";
}
/// Asks for what a view needs in the background, in place of what was requested before: all that `wants` does
/// and that did not fail; `like` says whether as models.
acentric_status request(acentric_bundle& bundle, const Wanted& wanted, Loaded detail,
                        const std::function<bool(const LoadJob&)>& wants, const LoadJob& like);

}  // namespace acentric::capi
