#pragma once
/// What the two halves of the page's module share.

#include <cstddef>
#include <string>

/// Names a function for the page. Addresses and sizes are those of the module's memory.
#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

namespace acentric {

/// Of the textures that hold texels.
inline constexpr std::size_t kTexelsAcross = 2048;

/// What is wrong with what was taken last; UTF-8.
extern std::string moduleMessage;

}  // namespace acentric
