#include "engine/export/bundle_json.h"

#include "engine/base/json_text.h"

namespace acentric {
namespace {

constexpr std::size_t kLineLength = 140;

void write(const BundleJson& json, std::size_t indent, std::string& out) {
  const std::string line = jsonText(json);
  if (!json.is_structured() || json.empty() || line.size() + indent <= kLineLength) {
    out += line;
    return;
  }
  const std::string margin(indent + 2, ' ');
  out += json.is_object() ? "{\n" : "[\n";
  std::size_t left = json.size();
  for (const auto& item : json.items()) {
    out += margin;
    if (json.is_object()) out += jsonText(BundleJson(item.key())) + ": ";
    write(item.value(), indent + 2, out);
    out += --left > 0 ? ",\n" : "\n";
  }
  out += std::string(indent, ' ') + (json.is_object() ? "}" : "]");
}

}  // namespace

std::string layOut(const BundleJson& json) {
  std::string out;
  write(json, 0, out);
  return out + "\n";
}

}  // namespace acentric
