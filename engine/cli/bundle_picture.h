#pragma once
/// Frames of bundles and walks, which need no project.

#include "engine/cli/commands.h"
#include "engine/export/bundle_frame.h"

namespace acentric::cli {

/// `acentric render` of a bundle or a walk.
Result<Report> renderBundle(const RenderOptions& options, const Common& common);

}  // namespace acentric::cli
