#pragma once
/// What the importer process is told (its arguments) and what it says (lines of JSON on standard output):
/// progress
/// {"done","total","stage"}, at last either {"error":{"kind","message","where"}} or {"written":true}.
/// Private.

#include <string>

#include "engine/base/progress.h"
#include "engine/scene/import.h"

namespace acentric {

std::string optionsToJson(const ImportOptions& options);
Result<ImportOptions> optionsFromJson(const std::string& text);

struct ImporterLine {
  enum class Kind { none, progress, error, written } kind = Kind::none;
  ProgressState progress;
  Error error;
};
std::string progressLine(const ProgressState& state);
std::string errorLine(const Error& error);
std::string writtenLine();
ImporterLine parseImporterLine(const std::string& line);

}  // namespace acentric
