#pragma once
/// Frames of bundles and walks on the processor, which need no project.

#include <filesystem>
#include <memory>

#include "engine/export/bundle_player.h"

namespace acentric {

/// Of a bundle's folder, or of a walk, whose index is read page by page.
Result<std::unique_ptr<BundlePlayer>> playerFor(const std::filesystem::path& bundle, int threads);
/// The view that the walk begins with.
PerspectiveView startOf(const Bundle& bundle);
/// Full captures, or coarse ones where there are no others; loads what is missing.
Result<Frame> bundleFrame(BundlePlayer& player, const PerspectiveView& view, const ViewSettings& settings);

}  // namespace acentric
