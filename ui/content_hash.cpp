#include "ui/content_hash.h"

#include <functional>
#include <string_view>

namespace acentric::ui {

void ContentHash::add(const void* data, std::size_t bytes) {
  const auto part = std::hash<std::string_view>()({static_cast<const char*>(data), bytes});
  value_ = (value_ ^ part) * 0x9e3779b97f4a7c15ULL;
  value_ ^= value_ >> 29;  // what comes later depends on all bits of what came before
}

}  // namespace acentric::ui
