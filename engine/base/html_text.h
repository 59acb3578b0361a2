#pragma once
/// Text within HTML and SVG, in attributes too.

#include <string>
#include <string_view>

namespace acentric {

std::string htmlText(std::string_view text);

}  // namespace acentric
