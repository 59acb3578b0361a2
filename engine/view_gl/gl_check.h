#pragma once
/// OpenGL's error flags as Results. In a debug context the driver's own words are added.

#include "engine/base/result.h"

namespace acentric {

/// Forgets errors that someone else left in the context, so that ours are told apart.
void forgetGlErrors();

/// Fails when an error was raised since the last check. `doing` says what we were at: "uploading camera 3".
Status checkGl(const char* doing);

}  // namespace acentric
