#include "engine/scene/importer_protocol.h"

#include <array>
#include <nlohmann/json.hpp>

#include "engine/base/json_text.h"

namespace acentric {
namespace {

using nlohmann::json;

constexpr std::array kKinds{ErrorKind::notFound,    ErrorKind::unreadable, ErrorKind::malformed,
                            ErrorKind::unsupported, ErrorKind::tooLarge,   ErrorKind::timeout,
                            ErrorKind::outOfSpace,  ErrorKind::cancelled,  ErrorKind::invalidArgument,
                            ErrorKind::internal};

ErrorKind kindNamed(const std::string& name) {
  for (const ErrorKind kind : kKinds)
    if (name == nameOf(kind)) return kind;
  return ErrorKind::internal;
}

}  // namespace

std::string optionsToJson(const ImportOptions& options) {
  return jsonText<json>({{"metresPerUnit", options.metresPerUnit},
                         {"up", int(options.up)},
                         {"defaultLight", options.defaultLight},
                         {"lighting", int(options.lighting)},
                         {"flatTriangles", options.flatTriangles},
                         {"outsideFiles", options.outsideFiles}});
}

Result<ImportOptions> optionsFromJson(const std::string& text) {
  try {
    const auto parsed = parseJson(text, "import options");
    if (!parsed) return fail(ErrorKind::invalidArgument, parsed.error().message, "import options");
    const json& value = *parsed;
    ImportOptions options;
    options.metresPerUnit = value.at("metresPerUnit").get<double>();
    options.up = static_cast<UpAxis>(value.at("up").get<std::uint8_t>());
    options.defaultLight = value.at("defaultLight").get<bool>();
    options.lighting = static_cast<Lighting>(value.at("lighting").get<std::uint8_t>());
    options.flatTriangles = value.at("flatTriangles").get<std::uint64_t>();
    options.outsideFiles = value.at("outsideFiles").get<bool>();
    if (auto status = options.check(); !status) return tl::unexpected(status.error());
    return options;
  } catch (const json::exception& error) {
    return fail(ErrorKind::invalidArgument, std::string("import options: ") + error.what());
  }
}

std::string progressLine(const ProgressState& state) {
  return jsonText<json>({{"done", state.done}, {"total", state.total}, {"stage", state.stage}});
}

std::string errorLine(const Error& error) {
  return jsonText<json>(
      {{"error", {{"kind", nameOf(error.kind)}, {"message", error.message}, {"where", error.where}}}});
}

std::string writtenLine() { return jsonText<json>({{"written", true}}); }

ImporterLine parseImporterLine(const std::string& line) {
  ImporterLine out;
  const json value = parseJson(line).value_or(json());
  if (!value.is_object()) return out;
  try {
    if (value.contains("error")) {
      const json& error = value["error"];
      out.error = {kindNamed(error.at("kind").get<std::string>()), error.at("message").get<std::string>(),
                   error.at("where").get<std::string>()};
      out.kind = ImporterLine::Kind::error;
    } else if (value.contains("written")) {
      out.kind = ImporterLine::Kind::written;
    } else if (value.contains("stage")) {
      out.progress = {value.at("done").get<double>(), value.at("total").get<double>(),
                      value.at("stage").get<std::string>()};
      out.kind = ImporterLine::Kind::progress;
    }
  } catch (const json::exception&) {
    out.kind = ImporterLine::Kind::none;
  }
  return out;
}

}  // namespace acentric
