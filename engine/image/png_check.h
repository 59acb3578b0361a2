#pragma once
/// Is a PNG whole? Its chunks and their checksums are verified before the decoder sees them: that turns
/// damage away with a clear message, where the decoder would print to the error stream and lose memory on its
/// way out.

#include <cstddef>
#include <span>
#include <string>

#include "engine/base/result.h"

namespace acentric {

/// `bytes` begin with PNG's signature. Checksums of ancillary chunks are not looked at: decoders skip those.
Status checkPng(std::span<const std::byte> bytes, const std::string& name);

}  // namespace acentric
