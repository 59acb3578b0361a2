#pragma once
/// What the parts of the page's module share.

#include <cstddef>
#include <string>
#include <vector>

#include "engine/export/bundle.h"

/// Names a function for the page. Addresses and sizes are those of the module's memory.
#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

namespace acentric {

/// Of the textures that hold texels.
inline constexpr std::size_t kTexelsAcross = 2048;

/// What is wrong with what was taken last; UTF-8.
extern std::string moduleMessage;
/// What the page gave last: an index, a part of a capture, a file.
extern std::vector<std::byte> moduleBytes;
/// The index that is open.
extern Bundle moduleBundle;

}  // namespace acentric
