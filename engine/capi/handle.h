#pragma once
/// How C calls become C++ ones: arguments are checked, errors become codes and a message, and nothing is
/// thrown across.

#include <new>
#include <string>
#include <vector>

#include "engine/capi/acentric_runtime.h"
#include "engine/export/bundle_player.h"

struct acentric_bundle {
  acentric::BundlePlayer runtime;
  bool open = false;
  std::string message;
  std::vector<std::vector<acentric_pose>> poses;  ///< by path
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

/// With `settings` NULL the project's.
Result<ViewSettings> settingsOf(const Bundle& bundle, const acentric_settings* settings);
PerspectiveView viewOf(const acentric_view& view);

}  // namespace acentric::capi
